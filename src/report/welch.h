// Do two renderings of one scene differ by more than their noise? Welch's t-test, tile by tile.
//
// Jung, Hanika, Dachsbacher, "Detecting Bias in Monte Carlo Renderers using Welch's t-test", JCGT
// 9:2, 2020: if both images are unbiased, the p-values of the tiles are uniform in [0, 1].
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "../output/image.h"

namespace phalanx {

struct WelchTest {
  int num_tiles = 0;                          // of 8 x 8 pixels
  std::array<std::vector<double>, 3> tile_p;  // per channel, one value a tile
  std::array<double, 3> uniformity_p{};  // chi-square over 20 bins of tile_p; NaN: too few tiles
  std::array<double, 3> mean_difference{};
  std::array<double, 3> mean_p{};  // that the whole images have the same mean
};

/// Needs the layers "samples" and "variance" in both images, at least 2 samples a pixel, and
/// independent samples: different seeds. Otherwise returns nothing and says why in `reason`.
std::optional<WelchTest> welch_test(const Image &a, const Image &b, std::string &reason);

}  // namespace phalanx
