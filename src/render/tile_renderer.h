// Renders tiles: one tile's samples of one pass at a time, by the schedule that was asked for.
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "../core/stats.h"
#include "../film/replicates.h"
#include "../plan/options.h"
#include "../plan/plan.h"
#include "../scene/accel.h"
#include "../scene/scene.h"
#include "../wavefront/kernels.h"
#include "tiles.h"

namespace phalanx {

/// The threads' workspaces and the tiles of a plan. What it adds to a film for one tile and one pass is
/// a function of those two alone; whoever calls it decides which thread renders what, and when.
class TileRenderer {
 public:
  /// `scene`, `accel` and `plan` have to outlive it. `seed`: instead of the plan's. Throws InputError for
  /// an ISA that is not here.
  TileRenderer(const Scene &scene, const Accel &accel, const Plan &plan, const RenderOptions &options,
               std::optional<int> seed = {});
  ~TileRenderer();

  int num_tiles() const { return static_cast<int>(tiles_.size()); }
  const Rect &tile(int t) const { return tiles_[static_cast<size_t>(t)]; }

  /// Adds the samples of `pass` in tile `t` to `film`, which covers the tile; a pixel's samples have
  /// to be added in their order. Different threads (0 ... plan.threads - 1) may render different
  /// tiles at the same time. Returns the number of rays.
  std::int64_t render(int t, const Pass &pass, int thread, Film &film);

  /// The same for any rectangle of at most tile_size x tile_size pixels. Invalid samples are counted in
  /// `invalid`, and not among those of collect().
  std::int64_t render(const Rect &tile, const Pass &pass, int thread, Film &film,
                      InvalidSamples &invalid);
  /// Rays of everything that a thread has rendered so far. Only while it does not render.
  RayCounts rays(int thread) const;

  /// The same for every replicate in turn: sample i of replicate r is sample i of the picture with the
  /// seed derived_seed(seed, kReplicate, r). `pass` counts samples of one replicate. In reports of invalid
  /// samples it has the number i * replicates.count() + r.
  std::int64_t render(int t, const Pass &pass, int thread, Film &film, Replicates &replicates);

  /// Samples so far that were not finite. Not while rendering.
  std::int64_t num_invalid() const;
  /// Rays, stages, invalid samples and memory of everything rendered so far. Not while rendering.
  void collect(RunStats &stats) const;

 private:
  struct Worker;
  std::int64_t render(const std::vector<std::int32_t> &pixels, const Pass &pass, int thread,
                      Film &film, InvalidSamples &invalid);
  Worker &worker_of(int thread);
  const std::vector<std::int32_t> &pixels_of(int t);
  /// Renders the samples into the worker's block.
  TileView trace(const std::vector<std::int32_t> &pixels, const Pass &pass, const FrameView &frame,
                 Worker &worker);

  const Plan &plan_;
  FrameView frame_;  // the plan's, but for the seed
  const Mode mode_;
  const Kernels &kernels_;
  SceneView view_;
  std::vector<Rect> tiles_;
  std::vector<std::vector<std::int32_t>> pixels_;  // of a tile, once it has been rendered
  std::vector<InvalidSamples> invalid_;            // of a tile
  std::vector<std::unique_ptr<Worker>> workers_;   // of a thread
};

}  // namespace phalanx
