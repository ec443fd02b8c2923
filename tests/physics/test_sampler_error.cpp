// How fast integrals converge: the reason to have the sampler. STABILITY B6.
#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "support/samplers.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

double smooth(Vec2 u) {
  return std::exp(-static_cast<double>(u.x) - static_cast<double>(u.y) * static_cast<double>(u.x));
}
/// 1 inside a quarter disk.
double edge(Vec2 u) { return u.x * u.x + u.y * u.y < 1.0f ? 1.0 : 0.0; }

constexpr double kQuarterDisk = 0.78539816339744831;
/// Integral of smooth: of (exp(-x) - exp(-2x)) / x over [0,1], = E1(2) - E1(1) + ln 2.
constexpr double kSmooth = 0.522663756872486;

struct Integral {
  double (*f)(Vec2);
  double truth;
};
const Integral kIntegrals[] = {{smooth, kSmooth}, {edge, kQuarterDisk}};

/// Error of the integral with frame.spp samples of pixel (x, y).
double error_of(const FrameView &frame, const Integral &integral, int x, int y, int dimension) {
  const uint32 scramble = pixel_scramble(frame, x, y);
  double sum = 0;
  for (int i = 0; i < frame.spp; ++i)
    sum += integral.f(sample_pair(frame, scramble, i, dimension));
  return sum / frame.spp - integral.truth;
}

/// Least-squares slope of log RMSE over log n for n = 2^lo ... 2^hi samples, over `runs` pixels of as many
/// pictures.
double rmse_slope(SamplerKind sampler, const Integral &integral, int lo, int hi, int runs) {
  std::vector<double> squares(static_cast<std::size_t>(hi + 1));
  for (int run = 0; run < runs; ++run)
    for (int k = lo; k <= hi; ++k) {
      const FrameView frame = sampler_frame(sampler, 1 << k, 11 + run / 64);
      const double error = error_of(frame, integral, run, run / 7, 4);
      squares[static_cast<std::size_t>(k)] += error * error;
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

constexpr int kSize = 64;  // of pictures of errors
constexpr int kPixels = kSize * kSize;

std::vector<double> error_picture(SamplerKind sampler, int spp, const Integral &integral, int seed,
                                  int dimension) {
  const FrameView frame = sampler_frame(sampler, spp, seed, kSize);
  std::vector<double> errors;
  for (int k = 0; k < kPixels; ++k)
    errors.push_back(error_of(frame, integral, k % kSize, k / kSize, dimension));
  return errors;
}

double product(const std::vector<double> &a, const std::vector<double> &b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
  return sum / static_cast<double>(a.size());
}

/// The picture moved by dx, dy pixels; it repeats.
std::vector<double> moved(const std::vector<double> &a, int dx, int dy) {
  std::vector<double> b;
  for (int k = 0; k < kPixels; ++k)
    b.push_back(a[static_cast<std::size_t>((k / kSize + dy + kSize) % kSize * kSize +
                                           (k % kSize + dx + kSize) % kSize)]);
  return b;
}

/// Filtered by a Gaussian of standard deviation sigma, in pixels.
std::vector<double> low_pass(std::vector<double> a, double sigma) {
  for (const bool down : {false, true}) {
    std::vector<double> b(a.size());
    double total = 0;
    for (int d = -8; d <= 8; ++d) {
      const double weight = std::exp(-d * d / (2 * sigma * sigma));
      const std::vector<double> c = moved(a, down ? 0 : d, down ? d : 0);
      for (std::size_t k = 0; k < a.size(); ++k) b[k] += weight * c[k];
      total += weight;
    }
    for (double &value : b) value /= total;
    a = b;
  }
  return a;
}

}  // namespace

TEST_CASE("sobol: error of a smooth integral falls at least as n^-1.2") {
  CHECK(rmse_slope(kSobolSampler, kIntegrals[0], 4, 10, 256) <= -1.2);
}

TEST_CASE("sobol: error of an edge falls as n^-0.75") {
  CHECK(std::abs(rmse_slope(kSobolSampler, kIntegrals[1], 4, 12, 512) + 0.75) <= 0.05);
}

TEST_CASE("independent: error falls as n^-0.5") {
  for (const Integral &integral : kIntegrals)
    CHECK(std::abs(rmse_slope(kIndependentSampler, integral, 2, 11, 1024) + 0.5) <= 0.03);
}

TEST_CASE("stratified: error falls as n^-0.75") {
  // The offsets within cells are shared by the cells of a row, so those of a smooth integral do not fall
  // as n^-1 as with independent jitter; with 16 to 1024 samples they are smaller all the same.
  CHECK(rmse_slope(kStratifiedSampler, kIntegrals[0], 4, 10, 512) <= -0.75);
  CHECK(std::abs(rmse_slope(kStratifiedSampler, kIntegrals[1], 4, 12, 512) + 0.75) <= 0.06);
}

TEST_CASE("halton: error falls at least as n^-1 for a smooth integral, n^-0.7 for an edge") {
  const auto slope = [](const Integral &integral, int hi) {
    double squares[2] = {};
    const int lo = 4;
    for (int run = 0; run < 512; ++run)
      for (const int k : {lo, hi}) {
        const FrameView frame = sampler_frame(kHaltonSampler, 1 << k);
        const double error = error_of(frame, integral, run, run / 7, 0);
        squares[k == hi] += error * error;
      }
    return 0.5 * std::log2(squares[1] / squares[0]) / (hi - lo);
  };
  CHECK(slope(kIntegrals[0], 10) <= -1.0);
  CHECK(slope(kIntegrals[1], 12) <= -0.7);
}

TEST_CASE("blue_noise: errors of pixels fall like Sobol's") {
  CHECK(rmse_slope(kBlueNoiseSampler, kIntegrals[0], 4, 10, 1024) <= -1.2);
  CHECK(std::abs(rmse_slope(kBlueNoiseSampler, kIntegrals[1], 4, 11, 2048) + 0.75) <= 0.06);
}

TEST_CASE("samplers: estimates are unbiased") {
  for (const SamplerKind sampler : kSamplers)
    for (const Integral &integral : kIntegrals)
      for (const int spp : {1, 3, 4, 17}) {
        Mean mean;
        for (int run = 0; run < 20000; ++run)
          mean.add(error_of(sampler_frame(sampler, spp, run), integral, 5, 6, 3));
        CAPTURE(sampler);
        CAPTURE(spp);
        CHECK(mean.p(0) > alpha());
      }
}

TEST_CASE("samplers: errors of neighbouring pixels and of other dimensions are uncorrelated") {
  for (const SamplerKind sampler : kSamplers) {
    Mean right, down, dimension;
    for (const Integral &integral : kIntegrals)
      for (int seed = 0; seed < 16; ++seed) {
        const std::vector<double> a = error_picture(sampler, 4, integral, seed, 2);
        const std::vector<double> b = error_picture(sampler, 4, integral, seed, 3);
        const double scale = kSize / product(a, a);  // of the correlation: standard deviation 1
        right.add(scale * product(a, moved(a, 1, 0)));
        down.add(scale * product(a, moved(a, 0, 1)));
        dimension.add(scale * product(a, b));
      }
    CAPTURE(sampler);
    CHECK(normal_two_sided(dimension.mean() * std::sqrt(32)) > alpha());
    if (sampler == kBlueNoiseSampler) continue;  // its errors are meant to cancel
    CHECK(normal_two_sided(right.mean() * std::sqrt(32)) > alpha());
    CHECK(normal_two_sided(down.mean() * std::sqrt(32)) > alpha());
  }
}

TEST_CASE("blue_noise: filtered errors are far smaller than Sobol's at few samples") {
  for (const int spp : {1, 2, 4})
    for (const Integral &integral : kIntegrals) {
      // The whole picture shares one scramble of the first bits: pictures differ more than Sobol's.
      double plain[2] = {}, filtered[2] = {};
      for (const bool blue : {false, true})
        for (int seed = 0; seed < 24; ++seed) {
          const std::vector<double> errors = error_picture(
              blue ? kBlueNoiseSampler : kSobolSampler, spp, integral, seed, seed % 5);
          const std::vector<double> smoothed = low_pass(errors, 1.5);
          plain[blue] += product(errors, errors);
          filtered[blue] += product(smoothed, smoothed);
        }
      CAPTURE(spp);
      CHECK(plain[1] < 1.5 * plain[0]);
      CHECK(filtered[1] / plain[1] < (integral.f == edge ? 0.5 : 0.25) * filtered[0] / plain[0]);
    }
}
