// The picture cut into tiles, and a pass into blocks of samples.
#pragma once
#include <cstdint>
#include <vector>

#include "../film/film.h"

namespace phalanx {

/// Tiles of side `size` (a power of two) that cover `crop`, row by row; those at the right and the
/// bottom are cut off. The grid starts at the crop's corner.
std::vector<Rect> cut_tiles(Rect crop, int size);

/// Pixels of a tile as x | y << 16, along a Morton curve so that neighbours in a wave are
/// neighbours in the picture.
std::vector<std::int32_t> tile_pixels(Rect tile, int size);

/// Samples of one pass over the picture: 2^log2_samples of each pixel.
struct Pass {
  int first_sample = 0;
  int log2_samples = 0;
};

/// The pass after `done` of `spp` samples of each pixel, done < spp: `most` (a power of two) samples, or
/// the largest power of two that is left.
Pass next_pass(int done, int spp, int most);

/// The same for samples of each of `count` replicates (a power of two up to kFirstCheck). Passes grow with
/// what is done, and end at every number of samples where is_error_check() says so.
Pass next_replicated_pass(int done, int samples, int most, int count);

/// The error is looked at after 2^k and 3 * 2^k samples of a pixel, from kFirstCheck on: a schedule that
/// does not depend on what is seen.
inline constexpr int kFirstCheck = 64;
bool is_error_check(int spp);

/// Passes that make `spp` samples: as many of `samples_per_pass` (a power of two) as fit, the rest
/// in powers of two.
std::vector<Pass> cut_passes(int spp, int samples_per_pass);

}  // namespace phalanx
