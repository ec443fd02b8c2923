// The scalar schedules, one path at a time over the same physics headers as the kernels. Compiled
// once per instruction set, like the kernels, so that timings compare schedules and nothing else.
// `detail`: kPlain or kRich, as for the kernels.
#pragma once
#include "../../kernels/path_view.h"
#include "../core/stats.h"
#include "path_step.h"

namespace phalanx {

#define PHALANX_DECLARE_SCHEDULES(isa)                                                            \
  /* depth-first: the wavefront's exact twin; same bits. */                                       \
  void render_depth_first_##isa(const SceneView &, const FrameView &, const TileView &,           \
                                RayCounts &, int detail);                                         \
  /* recursive: L = Le + f L'; equal to rounding, for it sums from the far end of the path. */    \
  void render_recursive_##isa(const SceneView &, const FrameView &, const TileView &, RayCounts &, \
                              int detail);                                                        \
  /* depth-first, of one sample, with all its vertices. */                                        \
  Vec3 replay_##isa(const SceneView &, const FrameView &, int32 x, int32 y, int32 sample,         \
                    int detail, PathSteps &);

PHALANX_DECLARE_SCHEDULES(sse4)
PHALANX_DECLARE_SCHEDULES(avx2)
PHALANX_DECLARE_SCHEDULES(avx512skx)

#define PHALANX_SCHEDULE2(name, isa) name##_##isa
#define PHALANX_SCHEDULE1(name, isa) PHALANX_SCHEDULE2(name, isa)
#define PHALANX_SCHEDULE(name) PHALANX_SCHEDULE1(name, PHALANX_ISA)

}  // namespace phalanx
