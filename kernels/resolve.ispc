// Optional stage after intersect: which material a path meets where the surface has a blend.
#include "gang.isph"
#include "physics/resolve.h"

export void KERNEL(resolve)(const uniform SceneView &scene, const uniform FrameView &frame,
                            const uniform TileView &tile, const uniform WaveView &wave,
                            const uniform int32 slots[], uniform int32 count) {
  foreach (i = 0 ... count) {
    const Gang g = make_gang(slots, i);
    const PathState p = get_path(wave, tile, g);
    Hit hit = get_hit(scene, tile, wave, g);
    hit.material = 0;
    if (hit.geometry >= 0) {
      const int32 material = resolve_material(scene, frame, hit, p.origin, p.direction,
                                              p.scramble, p.sample, p.depth);
      const Material m = fetch(scene.materials, material);
      put(wave.hit_kind, g, m.kind);
      hit.material = 1 + material;
    }
    put(wave.hit_material, g, hit.material);
  }
}
