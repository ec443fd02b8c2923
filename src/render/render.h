// Renders a picture: tiles x passes over threads, by the schedule that was asked for.
#pragma once
#include <functional>
#include <optional>

#include "../film/replicates.h"
#include "../plan/plan.h"
#include "../core/stats.h"
#include "../scene/accel.h"
#include "../scene/scene.h"
#include "../plan/options.h"
#include "../report/estimate.h"

namespace phalanx {

struct Progress {
  int spp_done = 0, spp_total = 0;   // whole passes; spp_total 0: samples are not what ends it
  double fraction = 0;               // of samples or time, whichever ends first; 0 where nobody knows
  double elapsed_s = 0;
  std::int64_t rays = 0;
  bool between_passes = false;       // only then may the film be read
  double target_error = 0;           // relMSE; 0: none
  const std::vector<ErrorCheck> *checks = nullptr;  // with replicates: so far
  std::int64_t invalid = 0;          // samples that were not finite, in whole passes
};
/// Called by one thread: within passes at most a few times a second, and after every pass. Return
/// false to stop: no tile is started any more, and the samples of finished tiles stay in the film.
using ProgressCallback = std::function<bool(const Progress &, const Film &)>;

struct RenderResult {
  Film film;
  RunStats stats;
  std::optional<Replicates> replicates;  // as planned
  std::optional<ErrorEstimate> error;    // from them
};

/// What --clamp took, once `stats` has the counts of samples and `film` the picture.
void add_clamp_figures(RunStats &stats, const Film &film, float limit);

/// Renders `plan.frame` of `scene`. Deterministic: the film's bits depend on scene, frame, samples,
/// replicates and ISA alone, not on threads, tile size, wave size or (but for recursive) the mode. Adaptive
/// sampling depends on the tile size, too. How many samples a limit of time allows is of course not
/// determined.
RenderResult render(const Scene &scene, const Accel &accel, const Plan &plan,
                    const RenderOptions &options, const ProgressCallback &progress = {});

}  // namespace phalanx
