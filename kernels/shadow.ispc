// Stage 5: visibility of light samples; those that get through are added to their path's sample.
#include "gang.isph"
#include "trace.isph"

export void KERNEL(shadow)(const uniform SceneView &scene, const uniform TileView &tile,
                           const uniform WaveView &wave, const uniform int32 slots[],
                           uniform int32 count) {
  foreach (i = 0 ... count) {
    const Gang g = make_gang(slots, i);
    const bool occluded = trace_occluded(
        scene, get3(wave.shadow_origin_x, wave.shadow_origin_y, wave.shadow_origin_z, g),
        get3(wave.shadow_direction_x, wave.shadow_direction_y, wave.shadow_direction_z, g),
        get(wave.shadow_distance, g), get_time(scene, tile, wave, g));
    if (!occluded) {
      add_radiance(tile, get(wave.block_index, g),
                   get3(wave.shadow_r, wave.shadow_g, wave.shadow_b, g));
    }
  }
}
