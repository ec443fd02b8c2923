// How fast integrals converge: the reason to have the sampler. STABILITY B6.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "../../kernels/physics/rng.h"

using namespace phalanx;

namespace {

double smooth(Vec2 u) {
  return std::exp(-static_cast<double>(u.x) - static_cast<double>(u.y) * static_cast<double>(u.x));
}
/// 1 inside a quarter disk.
double edge(Vec2 u) { return u.x * u.x + u.y * u.y < 1.0f ? 1.0 : 0.0; }

constexpr double kQuarterDisk = 0.78539816339744831;
/// Integral of smooth: of (exp(-x) - exp(-2x)) / x over [0,1], = E1(2) - E1(1) + ln 2.
constexpr double kSmooth = 0.522663756872486;

/// Least-squares slope of log RMSE over log n for n = 2^lo ... 2^hi, over `runs` scrambles.
template <typename F>
double rmse_slope(int sampler, const F &f, double truth, int lo, int hi, int runs) {
  std::vector<double> squares(static_cast<std::size_t>(hi + 1));
  for (int run = 0; run < runs; ++run) {
    const uint32 scramble = pixel_scramble(run, run / 7, 11);
    double sum = 0;
    for (int i = 0, k = 0; k <= hi; ++k) {
      for (; i < 1 << k; ++i) sum += f(sample_pair(sampler, scramble, i, 4));
      const double error = sum / (1 << k) - truth;
      squares[static_cast<std::size_t>(k)] += error * error;
    }
  }
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const int n = hi - lo + 1;
  for (int k = lo; k <= hi; ++k) {
    const double x = k * std::log(2.0);
    const double y = 0.5 * std::log(squares[static_cast<std::size_t>(k)] / runs);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

TEST_CASE("sobol: error of a smooth integral falls at least as n^-1.2") {
  const double slope = rmse_slope(kSobolSampler, smooth, kSmooth, 4, 10, 256);
  CHECK(slope <= -1.2);
}

TEST_CASE("sobol: error of an edge falls as n^-0.75") {
  const double slope = rmse_slope(kSobolSampler, edge, kQuarterDisk, 4, 12, 512);
  CHECK(std::abs(slope + 0.75) <= 0.05);
}

TEST_CASE("independent: error falls as n^-0.5") {
  const double of_smooth = rmse_slope(kIndependentSampler, smooth, kSmooth, 2, 12, 1024);
  const double of_edge = rmse_slope(kIndependentSampler, edge, kQuarterDisk, 2, 12, 1024);
  CHECK(std::abs(of_smooth + 0.5) <= 0.03);
  CHECK(std::abs(of_edge + 0.5) <= 0.03);
}
