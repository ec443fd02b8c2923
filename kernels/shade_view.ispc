// The shade kernel of integrators that look at the first surface only, whatever its material.
#include "physics/view.h"
#include "shade.isph"

static inline uniform int32 shade_view(const uniform SceneView &scene,
                                       const uniform FrameView &frame,
                                       const uniform TileView &tile, const uniform WaveView &wave,
                                       const uniform int32 *uniform slots, uniform int32 count,
                                       uniform int32 num_shadow) {
  foreach (i = 0 ... count) {
    const Gang g = make_gang(slots, i);
    const PathState p = get_path(wave, tile, g);
    const Vertex v = view_vertex(scene, frame, p, get_hit(scene, tile, wave, g));
    num_shadow =
        put_vertex(tile, wave, g, v, frame.integrator == kAmbientOcclusion, num_shadow);
  }
  return num_shadow;
}

SHADE_KERNEL(shade_view, shade_view)
