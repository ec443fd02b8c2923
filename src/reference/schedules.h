// The scalar schedules, one path at a time over the same physics headers as the kernels. Compiled
// once per instruction set, like the kernels, so that timings compare schedules and nothing else.
#pragma once
#include "../../kernels/path_view.h"
#include "../core/stats.h"

namespace phalanx {

#define PHALANX_DECLARE_SCHEDULES(isa)                                                            \
  /* depth-first: the wavefront's exact twin; same bits. */                                       \
  void render_depth_first_##isa(const SceneView &, const FrameView &, const TileView &,           \
                                RayCounts &);                                                     \
  /* recursive: L = Le + f L'; equal to rounding, for it sums from the far end of the path. */    \
  void render_recursive_##isa(const SceneView &, const FrameView &, const TileView &, RayCounts &);

PHALANX_DECLARE_SCHEDULES(sse4)
PHALANX_DECLARE_SCHEDULES(avx2)
PHALANX_DECLARE_SCHEDULES(avx512skx)

#define PHALANX_SCHEDULE2(name, isa) name##_##isa
#define PHALANX_SCHEDULE1(name, isa) PHALANX_SCHEDULE2(name, isa)
#define PHALANX_SCHEDULE(name) PHALANX_SCHEDULE1(name, PHALANX_ISA)

/// x and y of a sample's pixel, and its number there.
struct TileSample {
  int32 x, y, sample;
};
static inline TileSample tile_sample(const TileView &tile, int32 block_index) {
  const int32 xy = tile.pixels[block_index >> tile.log2_samples];
  return {xy & 0xffff, (xy >> 16) & 0xffff,
          tile.first_sample + (block_index & ((1 << tile.log2_samples) - 1))};
}

}  // namespace phalanx
