// Optional stage after the first intersect: albedo, normal and depth of camera rays.
#include "gang.isph"

template <int D>
static inline void aov(const uniform SceneView &scene, const uniform TileView &tile,
                       const uniform WaveView &wave, const uniform int32 *uniform slots,
                       uniform int32 count) {
  foreach (i = 0 ... count) {
    const Gang g = make_gang(slots, i);
    const FirstHit f =
        first_hit<D>(scene, get_hit(scene, tile, wave, g),
                     get3(wave.origin_x, wave.origin_y, wave.origin_z, g),
                     get3(wave.direction_x, wave.direction_y, wave.direction_z, g));
    put_first_hit(tile, get(wave.block_index, g), f);
  }
}

export void KERNEL(aov)(const uniform SceneView &scene, const uniform TileView &tile,
                        const uniform WaveView &wave, const uniform int32 slots[],
                        uniform int32 count) {
  aov<kPlain>(scene, tile, wave, slots, count);
}

export void KERNEL(aov_rich)(const uniform SceneView &scene, const uniform TileView &tile,
                             const uniform WaveView &wave, const uniform int32 slots[],
                             uniform int32 count) {
  aov<kRich>(scene, tile, wave, slots, count);
}
