// Error against run time: what was measured, the figures that follow from it, and how they are told.
//
// Errors are against two independent reference halves A and B: the mean of (x - A)(x - B) has no share of
// the references' own noise in it, however noisy they are.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "../output/image.h"
#include "../plan/options.h"

namespace phalanx {

// ---- errors of one picture ---------------------------------------------------------------------

/// Pictures of one size with finite colours. A == B is possible: then the errors hold the reference's own.
struct ReferencePair {
  Image a, b;
  Image mean;               // (a + b) / 2
  std::string description;  // for people
  int spp = 0;              // of each half; 0: not known
  bool halves = true;       // a and b are independent
};

/// All over three channels, in double precision; eps = (0.01 mean r)^2, r = (a + b) / 2.
struct PictureError {
  double relmse = 0;          // mean (x - a)(x - b) / (r^2 + eps)
  double relmse_trimmed = 0;  // without the 0.1 % of pixels where it is largest
  double mse = 0;             // mean (x - a)(x - b)
  double smape = 0;           // against r, as in metrics.h
};

PictureError picture_error(const Image &x, const ReferencePair &reference);

// ---- what was measured -------------------------------------------------------------------------

/// A run at a checkpoint. Times without the measuring itself, and without setting up the scene.
struct RunPoint {
  int spp = 0;
  double samples_per_pixel = 0;  // differs from spp with adaptive sampling
  double wall_s = 0, cpu_s = 0;
  std::int64_t rays = 0;
  PictureError error;
  double flip = 0;               // NaN: not computed; it takes longer than the others
  double estimate = 0, lo95 = 0, hi95 = 0;  // what the renderer said of its error; NaN: nothing
};

/// A number with its 95 % interval.
struct Interval95 {
  double value = 0, lo = 0, hi = 0;
};

/// Sums over the last pictures of all runs, for their bias.
class BiasSums {
 public:
  void add(const Image &x, const ReferencePair &reference);
  int num_runs() const { return num_; }
  /// Squared bias relative to the picture, mean of E[x - a] E[x - b] / (r^2 + eps), from all pairs of
  /// different runs; interval by Student's t over tiles of 16 x 16 pixels. Needs two runs.
  Interval95 squared(const ReferencePair &reference) const;
  /// Mean of all pictures / mean of the reference - 1. The interval takes the references' noise per sample
  /// for that of the runs. `spp`: of a run.
  Interval95 image_mean(const ReferencePair &reference, int spp) const;

 private:
  int num_ = 0;
  std::vector<double> sum_, square_;  // [pixels * 3] of (x - a) + (x - b), and of (x - a)(x - b)
  std::vector<double> means_;         // of each picture
};

/// One contestant on one scene: as many runs as seeds, each with the same checkpoints.
struct Curve {
  Mode mode = Mode::kWavefront;
  std::string sampler;
  std::vector<std::vector<RunPoint>> runs;
  Interval95 squared_bias, mean_bias;
  std::string name() const;  // "wavefront, sobol"
};

struct SceneConvergence {
  std::string scene, isa, reference;
  int width = 0, height = 0, max_depth = 0, threads = 0, replicates = 0;
  bool adaptive = false;
  double setup_s = 0;
  std::vector<Curve> curves;
  std::vector<double> targets;  // relMSE
};

// ---- derived figures ---------------------------------------------------------------------------

struct CurvePoint {
  int spp = 0;
  double samples_per_pixel = 0;
  double wall_s = 0, cpu_s = 0, rays = 0;  // medians over runs
  Interval95 relmse;                         // mean over runs, Student's t
  double relmse_trimmed = 0, mse = 0, smape = 0, flip = 0;  // means
  double estimate = 0;                     // mean of what runs said
  double coverage = 0;                     // share of runs whose interval held relmse; NaN: none
  double efficiency = 0;                   // 1 / (relmse * wall_s)
};

struct CurveFigures {
  std::vector<CurvePoint> points;
  Interval95 slope;                     // of log relMSE over log seconds, last five points
  std::vector<Interval95> seconds_to;   // for each target; NaN where it was not reached
};

/// Intervals by bootstrap over the runs, with fixed random numbers.
CurveFigures curve_figures(const Curve &curve, const std::vector<double> &targets);

/// A curve against the first one. Runs of the same seed are pairs.
struct Versus {
  double at_error = 0, at_s = 0;  // the smallest error that both reach; the longest time that both have
  Interval95 speed_up;              // seconds of the first / seconds, to that error
  Interval95 error_ratio;           // relMSE / relMSE of the first, after that time
};
Versus versus(const Curve &first, const Curve &curve);

/// Powers of ten that any of the curves passes.
std::vector<double> default_targets(const std::vector<Curve> &curves);

// ---- how it is told ----------------------------------------------------------------------------

std::string convergence_text(const SceneConvergence &scene);
/// Over several scenes: geometric means of the speed-ups. Empty for one scene or one curve.
std::string convergence_summary_text(const std::vector<SceneConvergence> &scenes);
/// Everything, run by run. What is not known is null. Ends with a newline.
std::string convergence_json(const std::vector<SceneConvergence> &scenes);
/// A line for each scene, contestant and checkpoint.
std::string convergence_csv(const std::vector<SceneConvergence> &scenes);

}  // namespace phalanx
