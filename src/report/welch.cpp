// Welch's t-test on means of pixels, with the Welch-Satterthwaite degrees of freedom.
#include "welch.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "statistics.h"

namespace phalanx {
namespace {

constexpr int kTileSide = 8;
constexpr int kNumBins = 20;
constexpr int kMinTiles = 5 * kNumBins;  // chi-square wants five expected in a bin

/// One channel of an image with the uncertainty of each pixel.
struct Estimates {
  const float *mean, *variance, *samples;
};

/// Sum of (a - b) over pixels, its variance, and what the degrees of freedom need.
struct Difference {
  double sum = 0, variance = 0, variance_of_variance = 0;
  double num_pixels = 0;

  void add(const Estimates &e, std::int64_t i, double sign) {
    const double v = e.variance[i];
    sum += sign * double{e.mean[i]};
    variance += v;
    variance_of_variance += v * v / (double{e.samples[i]} - 1);
  }
  double p() const {
    if (sum == 0) return 1;
    if (variance == 0) return 0;
    const double dof = variance * variance / variance_of_variance;
    return student_t_two_sided(sum / std::sqrt(variance), dof);
  }
};

bool usable(const Image &image) {
  const Channel *samples = find_channel(image, "samples");
  const auto variance = rgb_planes(image, "variance."), mean = rgb_planes(image);
  if (!samples || !variance[0] || !mean[0]) return false;
  for (std::int64_t i = 0; i < image.num_pixels(); i++) {
    if (!(samples->values[i] >= 2)) return false;
    for (int c = 0; c < 3; c++)
      if (!std::isfinite(mean[c][i]) || !(variance[c][i] >= 0) || std::isinf(variance[c][i]))
        return false;
  }
  return true;
}

Estimates estimates_of(const Image &image, int channel) {
  return {rgb_planes(image)[channel], rgb_planes(image, "variance.")[channel],
          find_channel(image, "samples")->values.data()};
}

std::vector<Difference> differences(const Image &size, const Estimates &a, const Estimates &b) {
  const int columns = (size.width + kTileSide - 1) / kTileSide;
  const int rows = (size.height + kTileSide - 1) / kTileSide;
  std::vector<Difference> tiles(static_cast<std::size_t>(columns) * rows);
  for (int y = 0; y < size.height; y++)
    for (int x = 0; x < size.width; x++) {
      Difference &tile = tiles[static_cast<std::size_t>(y / kTileSide) * columns + x / kTileSide];
      const std::int64_t i = std::int64_t{y} * size.width + x;
      tile.add(a, i, 1);
      tile.add(b, i, -1);
      tile.num_pixels++;
    }
  return tiles;
}

double uniformity(const std::vector<double> &p_values) {
  if (p_values.size() < kMinTiles) return std::numeric_limits<double>::quiet_NaN();
  double counts[kNumBins] = {};
  for (const double p : p_values) counts[std::min(kNumBins - 1, static_cast<int>(p * kNumBins))]++;
  const double expected = static_cast<double>(p_values.size()) / kNumBins;
  double chi_square = 0;
  for (const double count : counts)
    chi_square += (count - expected) * (count - expected) / expected;
  return chi_square_upper(chi_square, kNumBins - 1);
}

}  // namespace

std::optional<WelchTest> welch_test(const Image &a, const Image &b, std::string &reason) {
  if (a.width != b.width || a.height != b.height) {
    reason = "the images differ in size";
    return std::nullopt;
  }
  if (!usable(a) || !usable(b)) {
    reason =
        "both images need the layers samples and variance (--aov samples,variance) and at "
        "least 2 samples a pixel";
    return std::nullopt;
  }
  const std::string seed = find_metadata(a, "phalanx.seed");
  if (!seed.empty() && seed == find_metadata(b, "phalanx.seed")) {
    reason = "both images have seed " + seed + ": the test needs independent samples";
    return std::nullopt;
  }
  WelchTest test;
  for (int c = 0; c < 3; c++) {
    Difference whole;
    for (const Difference &tile : differences(a, estimates_of(a, c), estimates_of(b, c))) {
      test.tile_p[c].push_back(tile.p());
      whole.sum += tile.sum;
      whole.variance += tile.variance;
      whole.variance_of_variance += tile.variance_of_variance;
      whole.num_pixels += tile.num_pixels;
    }
    test.num_tiles = static_cast<int>(test.tile_p[c].size());
    test.uniformity_p[c] = uniformity(test.tile_p[c]);
    test.mean_difference[c] = whole.sum / whole.num_pixels;
    test.mean_p[c] = whole.p();
  }
  return test;
}

}  // namespace phalanx
