// Stage 4: one vertex of every path that hit a surface, one kernel per material kind.
#include "gang.isph"

template <int Kind>
static inline uniform int32 shade(const uniform SceneView &scene, const uniform FrameView &frame,
                                  const uniform TileView &tile, const uniform WaveView &wave,
                                  const uniform int32 *uniform slots, uniform int32 count,
                                  uniform int32 num_shadow) {
  // As in the plan: without light samples the wave has no shadow columns.
  const uniform bool sample_lights =
      scene.num_lights > 0 && frame.max_depth > 0 && has_density<Kind>();
  foreach (i = 0 ... count) {
    const Gang g = make_gang(slots, i);
    const PathState p = get_path(wave, tile, g);
    const Vertex v = path_vertex<Kind>(scene, frame, p, get_hit(scene, wave, g));
    put_ray(wave, g, v.next);
    put(wave.depth, g, v.next.depth);
    if (!is_black(v.emitted)) add_radiance(tile, get(wave.block_index, g), v.emitted);
    if (sample_lights) {
      // Slots without a shadow ray receive garbage that no list names: whole vectors are much
      // cheaper to write than parts of them.
      put3(wave.shadow_origin_x, wave.shadow_origin_y, wave.shadow_origin_z, g, v.shadow.origin);
      put3(wave.shadow_direction_x, wave.shadow_direction_y, wave.shadow_direction_z, g,
           v.shadow.direction);
      put(wave.shadow_distance, g, v.shadow.distance);
      put3(wave.shadow_r, wave.shadow_g, wave.shadow_b, g, v.shadow.contribution);
      if (!is_black(v.shadow.contribution))
        num_shadow += packed_store_active(&wave.shadow_list[num_shadow], g.slot);
    }
  }
  return num_shadow;
}

// Each appends its shadow rays to wave.shadow_list, which holds num_shadow, and returns how many it
// holds then.
#define SHADE_KERNEL(Kind, name, density)                                                                  \
  export uniform int32 KERNEL(shade_##name)(                                                              \
      const uniform SceneView &scene, const uniform FrameView &frame, const uniform TileView &tile, \
      const uniform WaveView &wave, const uniform int32 slots[], uniform int32 count,             \
      uniform int32 num_shadow) {                                                                 \
    return shade<Kind>(scene, frame, tile, wave, slots, count, num_shadow);                       \
  }

PHALANX_MATERIAL_KINDS(SHADE_KERNEL)

/// Paths that left the scene: the environment, and their end.
export void KERNEL(shade_escaped)(const uniform SceneView &scene, const uniform TileView &tile,
                                  const uniform WaveView &wave, const uniform int32 slots[],
                                  uniform int32 count) {
  foreach (i = 0 ... count) {
    const Gang g = make_gang(slots, i);
    if (scene.has_environment != 0) {
      const PathState p = get_path(wave, tile, g);
      add_radiance(tile, get(wave.block_index, g), escaped_radiance(scene, p));
    }
    put(wave.depth, g, -1);
  }
}
