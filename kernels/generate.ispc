// Stage 1: new camera samples into free slots.
#include "gang.isph"

/// Starts samples first_index .. first_index + count - 1 of the tile in slots[0 .. count - 1].
export void KERNEL(generate)(const uniform FrameView &frame, const uniform TileView &tile,
                             const uniform WaveView &wave, const uniform int32 slots[],
                             uniform int32 first_index, uniform int32 count) {
  foreach (i = 0 ... count) {
    const Gang g = make_gang(slots, i);
    const int32 block_index = first_index + i;
    const TileSample at = tile_sample(tile, block_index);
    const PathState p = start_path(frame, at.x, at.y, at.sample);
    put_ray(wave, g, p);
    put(wave.depth, g, p.depth);
    put(wave.scramble, g, p.scramble);
    put(wave.block_index, g, block_index);
  }
}
