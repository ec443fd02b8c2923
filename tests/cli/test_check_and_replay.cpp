// check and replay on the command line, and the warnings that lead to a replay.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "program.h"

using namespace phalanx;
using Json = nlohmann::json;

namespace {

bool contains(const std::string &text, const std::string &part) { return text.find(part) != std::string::npos; }

/// Light between mirrors that sums up to more than a float holds.
const char kOverflow[] = R"({
  "version": 1, "camera": {"position": [0, 0, 0], "look_at": [1, 0, 0], "fov": 1}, "film": {"width": 4, "height": 4},
  "integrator": {"max_depth": 1000, "roulette_depth": 1000}, "sampler": {"spp": 1},
  "materials": [{"name": "m", "type": "mirror", "reflectance": 1, "emission": 1e36, "two_sided": true}],
  "shapes": [{"type": "sphere", "material": "m", "center": [0, 0, 0], "radius": 1}]
})";

}  // namespace

TEST_CASE("check: cases, groups and outputs by name") {
  const TempDir dir;
  const Outcome list = phalanx_in(dir, "check --list");
  CHECK(list.exit_code == 0);
  for (const char *id : {"S1 ", "G14 ", "M15 ", "L13 ", "V10 ", "Q10 ", "C8 "}) CHECK(contains(list.out, id));
  const Outcome media = phalanx_in(dir, "check media");
  CHECK(media.exit_code == 0);
  CHECK(contains(media.out, "10 cases: 0 passed, 0 failed, 10 not applicable"));
  CHECK(contains(media.out, "no participating media"));
  const Outcome json = phalanx_in(dir, "check M5 C2 --quick --json -");
  CHECK(json.exit_code == 0);
  const Json report = Json::parse(json.out);
  CHECK(report["passed"] == 2);
  CHECK(report["cases"][0]["id"] == "M5");
  CHECK(phalanx_in(dir, "check C2 --quick --json a.json --html a.html --mode depth-first").exit_code == 0);
  CHECK(Json::parse(read_file(dir / "a.json"))["modes"] == Json{"depth-first"});
  CHECK(contains(read_file(dir / "a.html"), "<b>C2</b>"));
}

TEST_CASE("check, replay: a bad command line is 2, what cannot be written 5") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  for (const char *arguments :
       {"check nonsense", "check --isa z80", "check --mode fast", "check --threads -1", "replay s.json",
        "replay s.json --pixel 1,1", "replay s.json --pixel 1 --sample 0", "replay s.json --pixel 1,2,3 --sample 0",
        "replay s.json --pixel 16,0 --sample 0", "replay s.json --pixel 0,-1 --sample 0", "replay s.json --pixel 0,0 --sample -1",
        "replay missing.json --pixel 0,0 --sample 0", "replay s.json --pixel 0,0 --sample 0 --mode recursive --max-depth 100000",
        "render s.json --clamp 0", "render s.json --clamp -1"}) {
    CAPTURE(arguments);
    const Outcome outcome = phalanx_in(dir, arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err.starts_with("phalanx: "));
    CHECK(outcome.out == "");
  }
  CHECK(phalanx_in(dir, "check C2 --quick --json /dev/full").exit_code == 5);
  CHECK(phalanx_in(dir, "check C2 --quick --html missing/a.html").exit_code == 5);
}

TEST_CASE("replay: the sum of the vertices is the sample, in every schedule") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  for (const char *mode : {"wavefront", "megakernel", "depth-first"}) {
    CAPTURE(mode);
    const Outcome outcome = phalanx_in(dir, std::string("replay s.json --pixel 8,9 --sample 3 --mode ") + mode);
    CHECK(outcome.exit_code == 0);
    CHECK(contains(outcome.out, "vertex 0\n"));
    CHECK(contains(outcome.out, "material 'white'"));
    CHECK(contains(outcome.out, "the same bits"));
  }
  const Outcome outcome = phalanx_in(dir, "replay s.json --pixel 8,9 --sample 3 --mode recursive");
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.out, "rounding"));
}

TEST_CASE("render: invalid samples are counted by kind, and the first can be replayed") {
  const TempDir dir;
  put(dir / "s.json", kOverflow);
  const Outcome outcome = phalanx_in(dir, "render s.json -o a.exr --report r.json --quiet --strict");
  CHECK(outcome.exit_code == 3);
  const Json invalid = Json::parse(read_file(dir / "r.json"))["invalid"];
  CHECK(invalid["count"] == 16);
  CHECK(invalid["not_finite"] == 16);
  CHECK(invalid["negative"] == 0);
  const std::string command = invalid["first"]["replay"];
  CHECK(command.starts_with("phalanx replay s.json --pixel 0,0 --sample 0"));
  CHECK(contains(outcome.err, command));
  const Outcome replayed = phalanx_in(dir, command.substr(8));
  CHECK(replayed.exit_code == 0);
  CHECK(contains(replayed.out, "vertex 400\n"));
  CHECK(contains(replayed.out, "both are invalid"));
}

TEST_CASE("render: --clamp says what it took") {
  const TempDir dir;
  put(dir / "s.json", kSmallScene);
  CHECK(phalanx_in(dir, "render s.json -o a.exr --report a-report.json --quiet").exit_code == 0);
  CHECK(Json::parse(read_file(dir / "a-report.json"))["clamp"].is_null());
  const Outcome outcome = phalanx_in(dir, "render s.json -o a.exr --report b.json --quiet --clamp 0.25");
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.err, "--clamp 0.25 cut"));
  const Json clamp = Json::parse(read_file(dir / "b.json"))["clamp"];
  CHECK(clamp["limit"] == 0.25);
  CHECK(clamp["samples"] > 0);
  CHECK(clamp["energy_share"] > 0.01);
  CHECK(clamp["energy_share"] < 1);
}

TEST_CASE("info: what is stiff is said, and nothing of a plain scene") {
  const TempDir dir;
  put(dir / "plain.json", kSmallScene);
  CHECK_FALSE(contains(phalanx_in(dir, "info plain.json").out, "stiff"));
  put(dir / "far.json", R"({"version": 1, "camera": {"position": [1000000, 0, 4], "look_at": [1000000, 0, 0]},
    "materials": [{"name": "m", "type": "dielectric", "ior": 100}],
    "shapes": [{"type": "sphere", "material": "m", "center": [1000000, 0, 0], "radius": 1}]})");
  const Outcome outcome = phalanx_in(dir, "info far.json");
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.out, "away from the origin"));
  CHECK(contains(outcome.out, "extreme index of refraction: 'm'"));
}
