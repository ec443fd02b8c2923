#include <doctest/doctest.h>

#include <set>

#include "render/tiles.h"

using namespace phalanx;

TEST_CASE("tiles: cover every pixel of the crop window once") {
  for (const Rect crop : {Rect{0, 0, 100, 37}, Rect{5, 9, 1, 1}, Rect{3, 0, 1, 70}, Rect{0, 0, 64, 64}}) {
    for (int size : {1, 8, 32}) {
      std::set<std::pair<int, int>> seen;
      std::int64_t n = 0;
      for (const Rect &tile : cut_tiles(crop, size)) {
        for (std::int32_t xy : tile_pixels(tile, size)) {
          const int x = xy & 0xffff, y = (xy >> 16) & 0xffff;
          CHECK(x >= crop.x);
          CHECK(x < crop.x + crop.width);
          CHECK(y >= crop.y);
          CHECK(y < crop.y + crop.height);
          seen.insert({x, y});
          ++n;
        }
      }
      CHECK(n == std::int64_t{crop.width} * crop.height);
      CHECK(std::int64_t(seen.size()) == n);
    }
  }
}

TEST_CASE("tiles: coordinates up to 65535 survive packing") {
  const std::vector<std::int32_t> pixels = tile_pixels({65534, 65534, 1, 1}, 8);
  REQUIRE(pixels.size() == 1);
  CHECK((pixels[0] & 0xffff) == 65534);
  CHECK(((pixels[0] >> 16) & 0xffff) == 65534);
}

TEST_CASE("passes: make exactly the samples asked for, in aligned powers of two") {
  for (int spp : {1, 2, 3, 13, 16, 17, 100, 1024}) {
    int done = 0;
    for (const Pass &pass : cut_passes(spp, 16)) {
      CHECK(pass.first_sample == done);
      CHECK(pass.first_sample % (1 << pass.log2_samples) == 0);
      CHECK(pass.log2_samples <= 4);
      done += 1 << pass.log2_samples;
    }
    CHECK(done == spp);
  }
}
