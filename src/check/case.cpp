#include "case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "../plan/plan.h"
#include "../scene/build.h"
#include "../scene/scene_file.h"

namespace phalanx::check {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kStandardErrors = 4;     // p = 6e-5 a finding
constexpr double kLargestRelativeError = 1e-3;

SceneDescription parse(const std::string &text) {
  Diagnostics diagnostics;
  SceneDescription description = parse_scene_text(text, "check", ".", diagnostics);
  diagnostics.throw_if_errors();
  return description;
}

/// The message of the error that building it ends with; empty if there is none.
std::string refusal(const std::function<SceneDescription()> &make) {
  try {
    Stage stage(make());
    make_plan(stage.description(), stage.scene(), {});  // the camera's mistakes are found here
    return {};
  } catch (const InputError &error) {
    return error.what();
  }
}

}  // namespace

// ---- stage --------------------------------------------------------------------------------------

Stage::Stage(SceneDescription description) : description_(std::move(description)) {
  Diagnostics diagnostics;
  scene_ = build_scene(description_, diagnostics);
  diagnostics.throw_if_errors();
  warnings_ = diagnostics.warnings();
}

const Accel &Stage::accel(const std::string &isa) {
  std::unique_ptr<Accel> &accel = accels_[isa];
  if (!accel) accel = std::make_unique<Accel>(scene_, isa, 1);
  return *accel;
}

SceneView Stage::view(const std::string &isa) {
  SceneView view = scene_.view();
  view.accel = accel(isa).handle();
  return view;
}

// ---- pictures -----------------------------------------------------------------------------------

Measured measure(const Film &film) {
  Measured m;
  double variance = 0;
  const auto n = static_cast<double>(film.num_pixels());
  for (std::int64_t i = 0; i < film.num_pixels(); ++i) {
    m.mean += static_cast<double>(film.mean(i).y) / n;
    variance += static_cast<double>(film.variance_of_mean(i).y);
  }
  m.standard_error = std::sqrt(variance) / n;
  return m;
}

std::int64_t pixels_that_differ(const Film &a, const Film &b) {
  if (a.num_pixels() != b.num_pixels()) return -1;
  std::int64_t count = 0;
  for (std::int64_t i = 0; i < a.num_pixels(); ++i) {
    const Vec3 of_a[] = {a.mean(i), a.variance_of_mean(i)}, of_b[] = {b.mean(i), b.variance_of_mean(i)};
    count += std::memcmp(of_a, of_b, sizeof of_a) != 0;
  }
  return count;
}

// ---- findings -----------------------------------------------------------------------------------

void Case::near(const std::string &what, double measured, double expected, double distance,
                const std::string &note) {
  result_.findings.push_back({what, expected, measured, expected - distance, expected + distance, note});
}
void Case::equal(const std::string &what, double measured, double expected) {
  near(what, measured, expected, 0);
}
void Case::at_most(const std::string &what, double measured, double limit) {
  within(what, measured, -kInfinity, limit);
}
void Case::at_least(const std::string &what, double measured, double limit) {
  within(what, measured, limit, kInfinity);
}
void Case::within(const std::string &what, double measured, double lo, double hi) {
  result_.findings.push_back({what, kUnknown, measured, lo, hi, {}});
}
void Case::holds(const std::string &what, bool is_true, const std::string &note) {
  near(what, is_true ? 1 : 0, 1, 0, note);
}

// ---- scenes -------------------------------------------------------------------------------------

Stage Case::stage(const SceneText &scene) const { return Stage(parse(scene.text())); }

void Case::rejects(const std::string &what, const std::string &scene_text, const std::string &fragment) {
  const std::string message = refusal([&] { return parse(scene_text); });
  holds(what + " is refused", message.find(fragment) != std::string::npos,
        message.empty() ? "it was accepted" : message.substr(0, message.find('\n')));
}

void Case::rejects(const std::string &what, const SceneDescription &scene, const std::string &fragment) {
  const std::string message = refusal([&] { return scene; });
  holds(what + " is refused", message.find(fragment) != std::string::npos,
        message.empty() ? "it was accepted" : message.substr(0, message.find('\n')));
}

std::string with_isa(const Case &c, const std::string &what, const std::string &isa) {
  return c.isas().size() > 1 ? what + ", " + isa : what;
}

// ---- renderings ---------------------------------------------------------------------------------

RenderResult Case::render(Stage &stage, RenderOptions options) {
  if (options.threads == 0) options.threads = 1;
  const Plan plan = make_plan(stage.description(), stage.scene(), options);
  RenderResult result = phalanx::render(stage.scene(), stage.accel(options.isa), plan, options);
  result_.invalid_samples += result.stats.invalid.count;
  num_renderings_ += 1;
  return result;
}

Film Case::film(Stage &stage, int spp, const std::string &isa) {
  RenderOptions options;
  options.spp = spp;
  options.isa = isa;
  options.mode = mode();
  return render(stage, options).film;
}

void Case::compare_schedules(Stage &stage, const std::string &isa, int spp) {
  if (options_.modes.size() < 2) return;
  RenderOptions options;
  options.isa = isa;
  options.spp = std::min(spp, count(4, 16));
  std::unique_ptr<Film> first;
  double recursive = 0;
  bool has_recursive = false;
  for (const Mode mode : options_.modes) {
    options.mode = mode;
    if (mode == Mode::kRecursive && stage.description().integrator.max_depth > kMaxRecursiveDepth) continue;
    Film film = render(stage, options).film;
    if (mode == Mode::kRecursive) {
      recursive = measure(film).mean;
      has_recursive = true;
    } else if (!first) {
      first = std::make_unique<Film>(std::move(film));
    } else {
      compared_ = true;
      pixels_that_differ_ += pixels_that_differ(film, *first);
    }
  }
  if (!has_recursive || !first) return;
  compared_recursive_ = true;
  const double mean = measure(*first).mean, scale = std::max(std::fabs(mean), std::fabs(recursive));
  const double difference = scale > 0 ? std::fabs(mean - recursive) / scale : 0;
  recursive_difference_ = std::fmax(recursive_difference_, difference);
}

void Case::radiance(const std::string &what, const SceneText &scene, int spp, double expected, double slack) {
  Stage built = stage(scene);
  radiance(what, built, spp, expected, slack);
}

void Case::radiance(const std::string &what, Stage &stage, int spp, double expected, double slack) {
  compare_mean(what, stage, spp, expected, slack, !quick() && expected != 0);
}

void Case::rough_radiance(const std::string &what, const SceneText &scene, int spp, double expected) {
  Stage built = stage(scene);
  compare_mean(what, built, spp, expected, 5e-5, false);
}

void Case::compare_mean(const std::string &what, Stage &stage, int spp, double expected, double slack,
                        bool bound_error) {
  const int samples = quick() ? std::max(spp / 16, 16) : spp;
  for (const std::string &isa : isas()) {
    const Measured m = measure(film(stage, samples, isa));
    near(with_isa(*this, what, isa), m.mean, expected,
         kStandardErrors * m.standard_error + slack * std::fabs(expected),
         fmt::format("standard error {:.2g}", m.standard_error));
    if (bound_error)
      at_most(with_isa(*this, what, isa) + ": relative standard error",
              m.standard_error / std::fabs(expected), kLargestRelativeError);
    compare_schedules(stage, isa, samples);
  }
}

void Case::exact_radiance(const std::string &what, const SceneText &scene, double expected, double slack) {
  Stage built = stage(scene);
  for (const std::string &isa : isas()) {
    const Film picture = film(built, count(4, 64), isa);
    double worst = expected;
    bool is_finite_everywhere = picture.num_pixels() > 0;
    for (std::int64_t i = 0; i < picture.num_pixels(); ++i) {
      const auto value = static_cast<double>(picture.mean(i).y);
      is_finite_everywhere = is_finite_everywhere && std::isfinite(value) && picture.sample_count(i) > 0;
      if (!(std::fabs(value - expected) <= std::fabs(worst - expected))) worst = value;
    }
    near(with_isa(*this, what, isa), is_finite_everywhere ? worst : kUnknown, expected,
         slack * std::fabs(expected), "the pixel that is farthest off");
    compare_schedules(built, isa, 4);
  }
}

void Case::bounded_radiance(const std::string &what, const SceneText &scene, int spp, double lo, double hi) {
  Stage built = stage(scene);
  for (const std::string &isa : isas()) {
    within(with_isa(*this, what, isa), measure(film(built, quick() ? std::max(spp / 16, 4) : spp, isa)).mean, lo, hi);
    compare_schedules(built, isa, spp);
  }
}

void Case::same_bits(const std::string &what, const SceneText &a, const SceneText &b, int spp) {
  Stage first = stage(a), second = stage(b);
  for (const std::string &isa : isas()) {
    const Film of_a = film(first, spp, isa), of_b = film(second, spp, isa);
    equal(with_isa(*this, what, isa) + ": pixels that differ",
          static_cast<double>(pixels_that_differ(of_a, of_b)), 0);
    compare_schedules(first, isa, spp);
    compare_schedules(second, isa, spp);
  }
}

void Case::same_mean(const std::string &what, const SceneText &a, const SceneText &b, int spp, double slack) {
  Stage first = stage(a), second = stage(b);
  const int samples = quick() ? std::max(spp / 16, 16) : spp;
  for (const std::string &isa : isas()) {
    const Measured of_a = measure(film(first, samples, isa)), of_b = measure(film(second, samples, isa));
    near(with_isa(*this, what, isa), of_a.mean, of_b.mean,
         kStandardErrors * std::hypot(of_a.standard_error, of_b.standard_error) +
             slack * std::fabs(of_b.mean));
    compare_schedules(first, isa, spp);
    compare_schedules(second, isa, spp);
  }
}

void Case::finish() {
  if (compared_)
    equal("pixels in which schedules differ", static_cast<double>(pixels_that_differ_), 0);
  if (compared_recursive_)
    at_most("largest relative difference of recursive", recursive_difference_, 1e-3);
  if (num_renderings_ > 0)
    equal("invalid samples in all renderings", static_cast<double>(result_.invalid_samples), 0);
}

}  // namespace phalanx::check
