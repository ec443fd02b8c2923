// What a case of the stability suite works with: findings, scenes, renderings.
//
//   void furnace(Case &c) {
//     SceneText scene;
//     scene.lights = {kSky};
//     scene.shapes = {sphere("white", {0, 0, 0}, 1)};
//     c.radiance("white sphere under a white sky", scene, 1024, 1.0);
//   }
#pragma once
#include <map>
#include <memory>
#include <string>

#include "../render/render.h"
#include "../scene/accel.h"
#include "../scene/description.h"
#include "../scene/scene.h"
#include "check.h"
#include "scene_text.h"

namespace phalanx::check {

/// A scene, with acceleration structures for each instruction set that is asked for.
class Stage {
 public:
  /// Throws InputError if the scene has mistakes.
  explicit Stage(SceneDescription description);

  const SceneDescription &description() const { return description_; }
  const Scene &scene() const { return scene_; }
  const std::vector<Problem> &warnings() const { return warnings_; }
  const Accel &accel(const std::string &isa);
  /// For trace_closest() and the physics.
  SceneView view(const std::string &isa);

 private:
  SceneDescription description_;
  std::vector<Problem> warnings_;
  Scene scene_;
  std::map<std::string, std::unique_ptr<Accel>> accels_;
};

/// Mean of the green channel over the picture, and its standard error from the spread of the samples.
struct Measured {
  double mean = 0, standard_error = 0;
};
Measured measure(const Film &film);
/// How many pixels differ in any bit of mean or variance; -1 for pictures of different sizes.
std::int64_t pixels_that_differ(const Film &a, const Film &b);

class Case {
 public:
  Case(const Options &options, CaseResult &result) : options_(options), result_(result) {}

  bool quick() const { return options_.quick; }
  const std::vector<std::string> &isas() const { return options_.isas; }
  Mode mode() const { return options_.modes.front(); }
  /// A number of samples, or of anything: the first under --quick.
  int count(int quick, int full) const { return options_.quick ? quick : full; }

  // ---- findings ---------------------------------------------------------------------------------

  void near(const std::string &what, double measured, double expected, double distance,
            const std::string &note = "");
  void equal(const std::string &what, double measured, double expected);
  void at_most(const std::string &what, double measured, double limit);
  void at_least(const std::string &what, double measured, double limit);
  void within(const std::string &what, double measured, double lo, double hi);
  void holds(const std::string &what, bool is_true, const std::string &note = "");
  /// What the case leaves out, for the reader of its report.
  void remark(const std::string &text) { result_.remarks.push_back(text); }

  // ---- scenes -----------------------------------------------------------------------------------

  /// Throws InputError if the scene has mistakes.
  Stage stage(const SceneText &scene) const;
  /// The scene must be refused, with a message that has `fragment` in it.
  void rejects(const std::string &what, const std::string &scene_text, const std::string &fragment);
  /// The same for a description that was made in memory.
  void rejects(const std::string &what, const SceneDescription &scene, const std::string &fragment);

  /// Renders with the first mode unless `options` has another that it wants: spp, isa and so on are the caller's.
  /// Counts invalid samples.
  RenderResult render(Stage &stage, RenderOptions options);
  Film film(Stage &stage, int spp, const std::string &isa);

  /// Mean radiance of the picture, for every instruction set: within 4 standard errors of `expected`, and `slack`
  /// of it for rounding. `spp` samples a pixel, a sixteenth of them (16 at least) under --quick; without it the
  /// standard error must be at most 0.1 % of what is expected. Where several modes are run, they must agree on
  /// a few samples: bit for bit, recursive to rounding.
  void radiance(const std::string &what, const SceneText &scene, int spp, double expected, double slack = 5e-5);
  void radiance(const std::string &what, Stage &stage, int spp, double expected, double slack = 5e-5);
  /// The same without a bound on the standard error, for what would take too long.
  void rough_radiance(const std::string &what, const SceneText &scene, int spp, double expected);
  /// The same, and exactly: every pixel has this value, but for `slack` relative to it.
  void exact_radiance(const std::string &what, const SceneText &scene, double expected, double slack = 0);
  /// Finite everywhere, and the mean in [lo, hi].
  void bounded_radiance(const std::string &what, const SceneText &scene, int spp, double lo, double hi);
  /// Both scenes have the same picture bit for bit.
  void same_bits(const std::string &what, const SceneText &a, const SceneText &b, int spp = 16);
  /// Both scenes have the same mean within 4 standard errors of the difference.
  void same_mean(const std::string &what, const SceneText &a, const SceneText &b, int spp, double slack = 5e-5);

  /// Renders `spp` samples a pixel, 16 at most and 4 under --quick, in all modes that are run; finish() says in how
  /// many pixels they differ. All that measure pictures call it.
  void compare_schedules(Stage &stage, const std::string &isa, int spp);

  /// Called by the runner when the case is done: findings on all its renderings.
  void finish();

 private:
  void compare_mean(const std::string &what, Stage &stage, int spp, double expected, double slack,
                    bool bound_error);
  const Options &options_;
  CaseResult &result_;
  std::int64_t num_renderings_ = 0, pixels_that_differ_ = 0;
  double recursive_difference_ = 0;  // relative, of picture means
  bool compared_ = false, compared_recursive_ = false;
};

/// "what, avx2" if there are several instruction sets.
std::string with_isa(const Case &c, const std::string &what, const std::string &isa);

}  // namespace phalanx::check
