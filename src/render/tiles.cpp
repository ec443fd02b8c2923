#include "tiles.h"

#include <algorithm>
#include <bit>

namespace phalanx {

std::vector<Rect> cut_tiles(Rect crop, int size) {
  std::vector<Rect> tiles;
  for (int y = 0; y < crop.height; y += size)
    for (int x = 0; x < crop.width; x += size)
      tiles.push_back({crop.x + x, crop.y + y, std::min(size, crop.width - x),
                       std::min(size, crop.height - y)});
  return tiles;
}

std::vector<std::int32_t> tile_pixels(Rect tile, int size) {
  std::vector<std::int32_t> pixels;
  pixels.reserve(static_cast<size_t>(tile.width) * static_cast<size_t>(tile.height));
  for (std::uint32_t code = 0; code < static_cast<std::uint32_t>(size) * static_cast<std::uint32_t>(size);
       ++code) {
    int x = 0, y = 0;
    for (int bit = 0; bit < 16; ++bit) {
      x |= static_cast<int>((code >> (2 * bit)) & 1u) << bit;
      y |= static_cast<int>((code >> (2 * bit + 1)) & 1u) << bit;
    }
    if (x < tile.width && y < tile.height)
      pixels.push_back(static_cast<std::int32_t>(static_cast<std::uint32_t>(tile.x + x) |
                                                 static_cast<std::uint32_t>(tile.y + y) << 16));
  }
  return pixels;
}

Pass next_pass(int done, int spp, int most) {
  const unsigned n = std::min(static_cast<unsigned>(most), std::bit_floor(static_cast<unsigned>(spp - done)));
  return {done, std::countr_zero(n)};
}

Pass next_replicated_pass(int done, int samples, int most, int count) {
  const int first = kFirstCheck / count;
  const int grown = done < first ? first : std::max(1, static_cast<int>(std::bit_floor(static_cast<unsigned>(done))) / 2);
  return next_pass(done, samples, std::min(most, grown));
}

bool is_error_check(int spp) {
  const auto n = static_cast<unsigned>(spp);
  return spp >= kFirstCheck && (std::has_single_bit(n) || (n % 3 == 0 && std::has_single_bit(n / 3)));
}

std::vector<Pass> cut_passes(int spp, int samples_per_pass) {
  std::vector<Pass> passes;
  for (int done = 0; done < spp; done += 1 << passes.back().log2_samples)
    passes.push_back(next_pass(done, spp, samples_per_pass));
  return passes;
}

}  // namespace phalanx
