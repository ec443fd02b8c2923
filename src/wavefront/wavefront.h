// The wavefront schedule: stages over queues of paths instead of one path after the other.
#pragma once
#include "kernels.h"
#include "stages.h"
#include "wave.h"

namespace phalanx {

/// Renders all samples of `tile` (tile.radiance holds zeros) with the wave's slots, refilling them
/// as paths end. `frame` is the plan's, but for its seed. Every sample's radiance has the bits of depth-first.
void render_wavefront(const Kernels &kernels, const Plan &plan, const SceneView &scene,
                      const FrameView &frame, const TileView &tile, Wave &wave, StageClock &clock,
                      RayCounts &rays);

}  // namespace phalanx
