// What replicates say about the error agrees with errors that are known.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>

#include "report/estimate.h"
#include "report/line_fit.h"
#include "support/statistics.h"

using namespace phalanx;
using phalanx::test::relative_error;

namespace {

constexpr int kCount = 16;

/// Every pixel and channel: means of `kCount` replicates drawn by `draw`.
template <typename Draw>
Replicates drawn(int side, const Draw &draw) {
  Replicates replicates({0, 0, side, side}, kCount);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (int r = 0; r < kCount; ++r) {
        const float sample[] = {draw(), draw(), draw()};
        replicates.add_samples(x, y, r, sample, 1, 0);
      }
  return replicates;
}

/// Share of 95 % intervals that hold the truth, for relMSE and for the mean of the image.
struct Coverage {
  double relmse = 0, mean = 0, average_ratio = 0;
  double width = 0;  // mean of log(hi / relMSE)
};

template <typename Draw>
Coverage coverage_of(int side, int trials, double relmse, double mean, const Draw &draw) {
  Coverage c;
  for (int t = 0; t < trials; ++t) {
    const ErrorEstimate e = estimate_error(drawn(side, draw), 1);
    c.relmse += (e.lo95 <= relmse && relmse <= e.hi95) / double(trials);
    c.mean += (std::fabs(e.image_mean - mean) <= e.image_mean_half_width) / double(trials);
    c.average_ratio += e.relmse / relmse / trials;
    c.width += std::log(e.hi95 / e.relmse) / trials;
  }
  return c;
}

}  // namespace

TEST_CASE("replicates: means of samples that come in blocks") {
  Replicates replicates({3, 4, 2, 2}, 2);
  const float first[] = {1, 2, 3, 3, 4, 5}, second[] = {8, 9, 10};
  replicates.add_samples(4, 5, 1, first, 2, 0);
  replicates.add_samples(4, 5, 1, second, 1, 2);
  const float *means = replicates.means(3);
  CHECK(means[0] == 0);
  CHECK(means[3] == 4);
  CHECK(means[5] == 6);
}

TEST_CASE("replicates: a sample that is not finite is left out") {
  Replicates replicates({0, 0, 1, 1}, 2);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float block[] = {1, 1, 1, 1, nan, 1}, none[] = {nan, 0, 0};
  replicates.add_samples(0, 0, 0, block, 2, 0);
  replicates.add_samples(0, 0, 0, none, 1, 2);
  CHECK(replicates.means(0)[1] == 1);
}

TEST_CASE("replicate error: noise of known size, intervals hold the truth as often as they say") {
  std::mt19937 random(7);
  std::normal_distribution<float> normal(2.0f, 0.5f);
  const double relmse = 0.25 / kCount / (4 + 4e-4);
  const Coverage c = coverage_of(8, 400, relmse, 2, [&] { return normal(random); });
  CHECK(c.average_ratio == doctest::Approx(1).epsilon(0.03));
  CHECK(c.relmse > 0.95);  // more than it says: nothing is rare here
  CHECK(c.width < 0.35);   // 64 pixels
  CHECK(c.mean > 0.92);
  CHECK(c.mean < 0.98);
}

TEST_CASE("replicate error: skewed noise is predicted within a quarter") {
  // A replicate is 0 but for one time in k, when it is k: relative variance k - 1. With k = 30, more than half
  // of the pixels have seen nothing and look quiet.
  std::mt19937 random(8);
  for (const int k : {3, 10, 30}) {
    const auto draw = [&] { return random() % static_cast<unsigned>(k) == 0 ? float(k) : 0.0f; };
    const Coverage c = coverage_of(32, 40, (k - 1.0) / kCount / (1 + 1e-4), 1, draw);
    CAPTURE(k);
    CHECK(c.average_ratio > 0.8);
    CHECK(c.average_ratio < 1.25);
  }
  for (const float sigma : {0.5f, 1.0f}) {
    std::lognormal_distribution<float> lognormal(-0.5f * sigma * sigma, sigma);
    const double variance = std::exp(double(sigma * sigma)) - 1;
    const Coverage c =
        coverage_of(32, 40, variance / kCount / (1 + 1e-4), 1, [&] { return lognormal(random); });
    CAPTURE(sigma);
    CHECK(c.average_ratio > 0.9);
    CHECK(c.average_ratio < 1.1);
  }
}

TEST_CASE("replicate error: dark pixels beside bright ones keep their weight") {
  Replicates replicates({0, 0, 32, 32}, kCount);
  std::mt19937 random(11);
  std::normal_distribution<float> normal(1.0f, 0.1f);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      for (int r = 0; r < kCount; ++r) {
        const float v = normal(random) * ((x + y) % 2 == 0 ? 1.0f : 0.05f);
        const float sample[] = {v, v, v};
        replicates.add_samples(x, y, r, sample, 1, 0);
      }
  const double eps = std::pow(0.01 * 0.525, 2), v = 0.01 / kCount;
  const double relmse = 0.5 * v / (1 + eps) + 0.5 * v * 0.0025 / (0.0025 + eps);
  CHECK(relative_error(estimate_error(replicates, 1).relmse, relmse) < 0.1);
}

TEST_CASE("replicate error: the same for any number of threads; nothing for black") {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> uniform(0, 1);
  const Replicates noisy = drawn(40, [&] { return uniform(random); });
  const ErrorEstimate one = estimate_error(noisy, 1), three = estimate_error(noisy, 3);
  CHECK(one.relmse == three.relmse);
  CHECK(one.hi95 == three.hi95);
  CHECK(one.method == "replicates");
  const ErrorEstimate black = estimate_error(drawn(8, [] { return 0.0f; }), 1);
  CHECK(black.relmse == 0);
  CHECK(black.hi95 == 0);
  CHECK(black.image_mean_half_width == 0);
}

TEST_CASE("replicate error: tiles cover the picture, and the noisy one is the worst") {
  Replicates replicates({10, 20, 20, 9}, kCount);
  std::mt19937 random(10);
  std::uniform_real_distribution<float> uniform(0, 2);
  for (int y = 20; y < 29; ++y)
    for (int x = 10; x < 30; ++x)
      for (int r = 0; r < kCount; ++r) {
        const float v = x >= 26 && y >= 28 ? uniform(random) : 1.0f;
        const float sample[] = {v, v, v};
        replicates.add_samples(x, y, r, sample, 1, 0);
      }
  const std::vector<TileError> tiles = tile_errors(replicates);
  REQUIRE(tiles.size() == 6);
  CHECK(tiles[5].x == 26);
  CHECK(tiles[5].y == 28);
  CHECK(tiles[5].relmse == doctest::Approx(1.0 / 3 / kCount).epsilon(0.5));
  CHECK(tiles[5].half_width > 0);
  CHECK(tiles[0].relmse == 0);
  CHECK(tiles[0].mean == doctest::Approx(1));
}

TEST_CASE("line fit: slope and time to a target of an exact power law") {
  std::vector<ErrorCheck> checks;
  CHECK(std::isnan(error_slope(checks)));
  for (const double t : {1.0, 2.0, 4.0, 8.0}) {
    const double e = 0.1 * std::pow(t, -1.25);
    checks.push_back({int(64 * t), t, e, e / 1.1, e * 1.1});
  }
  const double slope = error_slope(checks);
  CHECK(slope == doctest::Approx(-1.25));
  const double target = 0.1 * std::pow(16.0, -1.25);
  CHECK(seconds_to(checks, slope, target) == doctest::Approx(8));
  CHECK(seconds_to(checks, slope, 0.5) == 0);
  CHECK(std::isnan(seconds_to(checks, 0.0, target)));
  CHECK(std::isnan(seconds_to({}, slope, target)));
  checks.back().relmse = 0;
  CHECK(std::isnan(error_slope(checks)));
}
