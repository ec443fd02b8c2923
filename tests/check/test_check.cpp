// The suite itself: it passes here, and it can fail.
#include "check/check.h"

#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "check/case.h"
#include "check/check_report.h"
#include "support/scenes.h"

using namespace phalanx;
using namespace phalanx::check;
using Json = nlohmann::json;

namespace {

Options quick_options() {
  Options options;
  options.quick = true;
  options.isas = {test::isas_here().back()};
  options.modes = {Mode::kWavefront, Mode::kMegakernel, Mode::kDepthFirst, Mode::kRecursive};
  options.threads = 2;
  return options;
}

std::vector<CaseResult> run(const std::vector<Group> &groups) {
  return run_checks(groups, quick_options(), [](const Group &, const CaseInfo &) { return true; },
                    [](const CaseResult &) {});
}

SceneText white_sky() {
  SceneText scene;
  scene.lights = {kSky};
  return scene;
}

// ---- planted ------------------------------------------------------------------------------------

void right(Case &c) { c.exact_radiance("white sky", white_sky(), 1); }
void wrong_value(Case &c) { c.exact_radiance("white sky", white_sky(), 1.001); }
void wrong_mean(Case &c) {
  SceneText scene = white_sky();
  scene.shapes = {level("grey", 1, 0)};
  c.radiance("grey floor", scene, 4096, 0.53);
}
void not_a_number(Case &c) { c.near("0 / 0", std::nan(""), 0, 1e9); }
void too_much(Case &c) { c.at_most("two", 2, 1); }
void nothing(Case &) {}
void breaks_off(Case &c) {
  c.equal("one", 1, 1);
  throw std::runtime_error("planted");
}
void accepted(Case &c) { c.rejects("a good scene", white_sky().text(), "error"); }
void other_bits(Case &c) {
  SceneText a = white_sky(), b = white_sky();
  a.shapes = {level("grey", 1, 0)};
  b.shapes = {level("white", 1, 0)};
  c.same_bits("a grey floor and a white one", a, b);
}
/// Light between mirrors that sums up to more than a float holds.
void overflows(Case &c) {
  SceneText scene;
  scene.camera = camera({0, 0, 0}, {1, 0, 0}, 1, {0, 1, 0});
  scene.integrator = R"("max_depth": 1000, "roulette_depth": 1000)";
  scene.materials = {material("wall", "mirror", R"("reflectance": 1, "emission": 1e36, "two_sided": true)")};
  scene.shapes = {sphere("wall", {0, 0, 0}, 1)};
  Stage stage = c.stage(scene);
  c.film(stage, 1, c.isas()[0]);
  c.equal("one", 1, 1);
}

}  // namespace

TEST_CASE("check: the catalogue has 78 cases, each once") {
  std::set<std::string> ids;
  for (const Group &group : catalogue())
    for (const CaseInfo &info : group.cases) {
      CHECK(ids.insert(info.id).second);
      CHECK((info.run != nullptr || std::string(info.reason) != ""));
    }
  CHECK(ids.size() == 78);
}

TEST_CASE("check: the quick suite passes") {
  const std::vector<CaseResult> results = run(catalogue());
  CHECK(results.size() == 78);
  for (const CaseResult &r : results) {
    INFO(result_text(r));
    CHECK(r.verdict != Verdict::kFailed);
    CHECK(r.invalid_samples == 0);
    CHECK(r.findings.empty() == (r.verdict == Verdict::kNotApplicable));
  }
}

TEST_CASE("check: what is wrong fails, what is right passes") {
  const std::vector<Group> planted = {{"planted",
                                       {{"right", "", right},
                                        {"value", "", wrong_value},
                                        {"mean", "", wrong_mean},
                                        {"nan", "", not_a_number},
                                        {"bound", "", too_much},
                                        {"nothing", "", nothing},
                                        {"breaks", "", breaks_off},
                                        {"accepted", "", accepted},
                                        {"bits", "", other_bits},
                                        {"overflow", "", overflows},
                                        {"alone", "", too_much, "", true},
                                        {"missing", "", nullptr, "there is none"}}}};
  const std::vector<CaseResult> results = run(planted);
  for (const CaseResult &r : results) {
    CAPTURE(r.id);
    const bool is_good = r.id == "right", is_missing = r.id == "missing";
    CHECK(r.verdict == (is_good ? Verdict::kPassed : is_missing ? Verdict::kNotApplicable : Verdict::kFailed));
  }
  CHECK(num_failed(results) == 10);
  CHECK(results[6].reason == "planted");
  CHECK(results[9].invalid_samples == 64);

  const Json json = Json::parse(results_json(results, quick_options(), 1));
  CHECK(json["failed"] == 10);
  CHECK(json["passed"] == 1);
  CHECK(json["cases"][1]["verdict"] == "failed");
  CHECK(json["cases"][1]["findings"][0]["expected"] == 1.001);
  CHECK(json["cases"][1]["findings"][0]["measured"] == 1.0);
  CHECK(json["cases"][3]["findings"][0]["measured"].is_null());
  const std::string html = results_html(results, quick_options(), 1);
  for (const CaseResult &r : results) CHECK(html.find("<b>" + r.id + "</b>") != std::string::npos);
  CHECK(summary_text(results, 1).starts_with("12 cases: 1 passed, 10 failed, 1 not applicable"));
}
