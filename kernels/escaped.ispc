// The end of paths that left the scene: the environment.
#include "gang.isph"

template <int D>
static inline void escaped(const uniform SceneView &scene, const uniform FrameView &frame,
                           const uniform TileView &tile, const uniform WaveView &wave,
                           const uniform int32 *uniform slots, uniform int32 count) {
  foreach (i = 0 ... count) {
    const Gang g = make_gang(slots, i);
    if (sees_environment<D>(scene, frame)) {
      const PathState p = get_path(wave, tile, g);
      add_radiance(tile, get(wave.block_index, g), escaped_radiance<D>(scene, p));
    }
    put(wave.depth, g, -1);
  }
}

export void KERNEL(shade_escaped)(const uniform SceneView &scene, const uniform FrameView &frame,
                                  const uniform TileView &tile, const uniform WaveView &wave,
                                  const uniform int32 slots[], uniform int32 count) {
  escaped<kPlain>(scene, frame, tile, wave, slots, count);
}

export void KERNEL(shade_escaped_rich)(const uniform SceneView &scene,
                                       const uniform FrameView &frame, const uniform TileView &tile,
                                       const uniform WaveView &wave, const uniform int32 slots[],
                                       uniform int32 count) {
  escaped<kRich>(scene, frame, tile, wave, slots, count);
}
