// The sampler: every pair is a randomised net, and pairs, pixels and seeds know nothing of each other.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_set>
#include <vector>

#include "../../kernels/physics/rng.h"
#include "support/samplers.h"
#include "support/statistics.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

const FrameView kSobol = sampler_frame(kSobolSampler);

/// Correlation of two columns times sqrt(n): of variance 1 if the numbers are independent.
double scaled_correlation(const std::vector<float> &a, const std::vector<float> &b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += 12 * (static_cast<double>(a[i]) - 0.5) * (static_cast<double>(b[i]) - 0.5);
  return sum / std::sqrt(static_cast<double>(a.size()));
}

struct Columns {
  std::vector<float> x, y;
};
Columns columns(const FrameView &frame, uint32 scramble, int dimension, int n) {
  Columns c;
  for (int i = 0; i < n; ++i) {
    const Vec2 u = sample_pair(frame, scramble, i, dimension);
    c.x.push_back(u.x);
    c.y.push_back(u.y);
  }
  return c;
}

/// Variance of scaled_correlation. Two Owen-scrambled sequences of one pixel order their samples by
/// the same tree: the leading bits of both flip between samples 2i and 2i + 1, so that correlations,
/// 0 on average, scatter with variance 2 (3/4)^2 + 1 (2 3/4 1/4) + ... = 1.6, whatever n. In base 4,
/// for blue noise, that is 4/3 (15/16)^2 + ... = 1.3.
double correlation_variance(int sampler) {
  return sampler == kSobolSampler ? 1.6 : sampler == kBlueNoiseSampler ? 1.3 : 1.0;
}

/// Checks that correlations are 0 but for the scatter that is due.
void check_uncorrelated(int sampler, const std::vector<double> &scaled) {
  Mean mean, squares;
  double worst = 0;
  for (const double value : scaled) {
    const double z = value / std::sqrt(correlation_variance(sampler));
    mean.add(z);
    squares.add(z * z);
    worst = std::max(worst, std::fabs(z));
  }
  CAPTURE(sampler);
  CHECK(mean.p(0) > alpha());
  if (sampler == kHaltonSampler)  // any two primes are even together, not only each by itself
    CHECK(squares.mean() < 0.5);
  else
    CHECK(squares.p(1, 0.02) > alpha());
  CHECK(normal_two_sided(worst) > sidak(1e-3, static_cast<int>(scaled.size())));
}

}  // namespace

TEST_CASE("rng: hash32 is a permutation with avalanche, reverse_bits an involution") {
  std::unordered_set<uint32> seen;
  for (uint32 i = 0; i < 1000000; ++i) seen.insert(hash32(i));
  CHECK(seen.size() == 1000000);
  for (int bit = 0; bit < 32; ++bit) {
    double flipped = 0;
    for (uint32 i = 0; i < 10000; ++i)
      flipped += __builtin_popcount(hash32(i * 977u) ^ hash32((i * 977u) ^ (1u << bit)));
    CHECK(flipped / 10000 == doctest::Approx(16).epsilon(0.02));
  }
  for (uint32 i = 0; i < 1000; ++i) CHECK(reverse_bits(reverse_bits(hash32(i))) == hash32(i));
  CHECK(reverse_bits(1) == 0x80000000u);
  CHECK(reverse_bits(0x0000f00du) == 0xb00f0000u);
}

TEST_CASE("rng: scramble_reversed is an Owen scramble: low bits do not see high ones") {
  for (uint32 seed = 1; seed < 200; ++seed) {
    const uint32 x = hash32(seed), s = hash32(seed + 1000);
    for (int bit = 0; bit < 32; ++bit) {
      const uint32 below = (1u << bit) - 1;
      const uint32 change = scramble_reversed(x, s) ^ scramble_reversed(x ^ (1u << bit), s);
      REQUIRE((change & below) == 0);
      REQUIRE((change & (1u << bit)) != 0);  // a permutation of every bit
    }
  }
}

TEST_CASE("rng: the second Sobol dimension is Pascal's matrix") {
  for (uint32 i = 0; i < 32; ++i) {
    uint32 column = 0;  // Bit r of column i: binomial(i, r) mod 2, by Lucas' theorem.
    for (uint32 r = 0; r <= i; ++r)
      if ((i & r) == r) column |= 1u << r;
    CHECK(sobol_second_reversed(1u << i) == column);
  }
}

TEST_CASE("rng: Sobol and independent numbers are those of version 0.1") {
  const uint32 scramble = pixel_scramble(12, 34, 5);
  CHECK(scramble == 0xdccdec61u);
  const Vec2 a = sample_pair(kSobol, scramble, 6, 7);
  const Vec2 b = sample_pair(sampler_frame(kIndependentSampler), scramble, 6, 7);
  CHECK((a.x == 0.620274067f && a.y == 0.172717869f));
  CHECK((b.x == 0.205038488f && b.y == 0.877633035f));
}

TEST_CASE("rng: quotient and log2_ceil are exact") {
  for (int k = 0; k < 31; ++k) {
    const int n = 1 << k;
    CHECK(log2_ceil(n) == k);
    if (k > 1) CHECK(log2_ceil(n - 1) == k);
    if (k < 30) CHECK(log2_ceil(n + 1) == k + 1);
  }
  for (uint32 i = 0; i < 1000000; ++i) {
    const int b = 1 + static_cast<int>((hash32(i) & 0x1fffff) >> (i % 21));
    const int any = static_cast<int>(hash32(i + 77) >> (2 + i % 30));
    // Half of them next to a multiple.
    const int a = i % 2 == 0 ? any : std::max(any / b * b - static_cast<int>(i / 2 % 2), 0);
    REQUIRE(quotient(a, b) == a / b);
  }
}

TEST_CASE("rng: unit_float is in [0, 1)") {
  CHECK(unit_float(0) == 0.0f);
  CHECK(unit_float(0xffffffffu) == 1.0f - 0x1p-24f);
  CHECK(unit_float(0x80000000u) == 0.5f);
}

TEST_CASE("rng: uniforms are in [0, 1) for every sampler, with the moments of the square") {
  for (const SamplerKind sampler : kSamplers) {
    const FrameView frame = sampler_frame(sampler, 16, 3);
    Mean x, y, xx, xy;
    float least = 1, most = 0;
    for (int i = 0; i < 1 << 20; ++i) {
      const uint32 scramble = pixel_scramble(frame, i & 255, i >> 8 & 255);
      const Vec2 u = sample_pair(frame, scramble, i >> 16, i & 7);
      least = std::min({least, u.x, u.y});
      most = std::max({most, u.x, u.y});
      const double a = static_cast<double>(u.x), b = static_cast<double>(u.y);
      x.add(a), y.add(b), xx.add(a * a), xy.add(a * b);
    }
    CHECK(least >= 0.0f);
    CHECK(most < 1.0f);
    CHECK(x.p(0.5) > alpha());
    CHECK(y.p(0.5) > alpha());
    CHECK(xx.p(1.0 / 3) > alpha());
    CHECK(xy.p(0.25) > alpha());
  }
}

TEST_CASE("sobol: aligned blocks of 2^m samples are (0,m,2)-nets, m <= 10") {
  for (const int dimension : {0, 1, 2, 5, 6, 17, 61})
    for (int pixel = 0; pixel < 6; ++pixel)
      for (int m = 0; m <= 10; ++m)
        for (const int block : {0, 1, 2, 3, 7, 1000}) {
          CAPTURE(dimension);
          CAPTURE(m);
          CAPTURE(block);
          const uint32 scramble = pixel_scramble(pixel, 3 * pixel, 42);
          REQUIRE(is_net(points(kSobol, scramble, dimension, block << m, 1 << m), m));
        }
}

TEST_CASE("sobol: nets of up to 2^16 samples, and late in the sequence") {
  const uint32 scramble = pixel_scramble(5, 9, 0);
  for (int m = 11; m <= 16; ++m) CHECK(is_net(points(kSobol, scramble, 3, 0, 1 << m), m));
  CHECK(is_net(points(kSobol, scramble, 3, (1 << 30) + (5 << 12), 1 << 12), 12));
}

TEST_CASE("rng: samples of a block differ between pixels, dimensions and seeds") {
  for (const SamplerKind sampler : kSamplers) {
    std::set<std::pair<float, float>> seen;
    for (int i = 0; i < 4096; ++i) {
      const FrameView frame = sampler_frame(sampler, 16, i >> 8 & 3);
      const Vec2 u = sample_pair(frame, pixel_scramble(frame, i & 15, i >> 4 & 15), 0, i >> 10);
      seen.insert({u.x, u.y});
    }
    CAPTURE(sampler);
    CHECK(seen.size() == 4096);
  }
}

TEST_CASE("rng: first samples of pixels, dimensions and seeds are uniform") {
  for (const SamplerKind sampler : kSamplers) {
    std::vector<Vec2> pixels, dimensions, seeds;
    const FrameView frame = sampler_frame(sampler);
    for (int i = 0; i < 1 << 18; ++i) {
      pixels.push_back(sample_pair(frame, pixel_scramble(frame, i & 511, i >> 9), 0, 2));
      dimensions.push_back(sample_pair(frame, pixel_scramble(frame, 1, 2), 5, i));
      const FrameView other = sampler_frame(sampler, 64, i);
      seeds.push_back(sample_pair(other, pixel_scramble(other, 100, 50), 0, 0));
    }
    CAPTURE(sampler);
    CHECK(chi_square_of(pixels, 32) > alpha());
    CHECK(chi_square_of(dimensions, 32) > alpha());
    CHECK(chi_square_of(seeds, 32) > alpha());
  }
}

TEST_CASE("rng: samples of one pixel are uniform") {
  for (const SamplerKind sampler : kSamplers) {
    const FrameView frame = sampler_frame(sampler, 1 << 18, 9, 8);
    for (int dimension = 0; dimension < 8; ++dimension) {
      CAPTURE(sampler);
      CAPTURE(dimension);
      const std::vector<Vec2> p = points(frame, pixel_scramble(frame, 7, 3), dimension, 0, 1 << 18);
      CHECK(chi_square_of(p, 32) > alpha());
    }
  }
}

TEST_CASE("rng: pairs of dimensions are uncorrelated") {
  for (const SamplerKind sampler : kSamplers) {
    const FrameView frame = sampler_frame(sampler, 1024);
    std::vector<double> z;
    for (int pixel = 0; pixel < 20; ++pixel) {
      std::vector<Columns> c;
      for (int d = 0; d < 12; ++d)
        c.push_back(columns(frame, pixel_scramble(frame, pixel, 1), d, 1024));
      for (std::size_t a = 0; a < c.size(); ++a)
        for (std::size_t b = a + 1; b < c.size(); ++b) {
          z.push_back(scaled_correlation(c[a].x, c[b].x));
          z.push_back(scaled_correlation(c[a].x, c[b].y));
          z.push_back(scaled_correlation(c[a].y, c[b].y));
        }
    }
    check_uncorrelated(sampler, z);
  }
}

TEST_CASE("rng: neighbouring pixels are uncorrelated") {
  for (const SamplerKind sampler : kSamplers) {
    // Halton's samples go through their strata in one order, scrambled: what is uncorrelated are errors of
    // pixels (test_sampler_error.cpp).
    if (sampler == kHaltonSampler) continue;
    const FrameView frame = sampler_frame(sampler, 256);
    std::vector<double> z;
    for (int dimension = 0; dimension < 6; ++dimension)
      for (int x = 0; x < 40; ++x)
        for (int y = 0; y < 10; ++y) {
          const Columns a = columns(frame, pixel_scramble(frame, x, y), dimension, 256);
          const Columns b = columns(frame, pixel_scramble(frame, x + 1, y), dimension, 256);
          const Columns c = columns(frame, pixel_scramble(frame, x, y + 1), dimension, 256);
          z.push_back(scaled_correlation(a.x, b.x));
          z.push_back(scaled_correlation(a.y, c.y));
          z.push_back(scaled_correlation(a.x, c.y));
        }
    check_uncorrelated(sampler, z);
  }
}

TEST_CASE("rng: pixels of a picture have scrambles of their own, but for chance") {
  // n random 32-bit numbers collide n^2 / 2^33 times. When x was added without being hashed, rows
  // of close hashes shared runs of scrambles: one 1024 x 1024 picture in four had some.
  std::unordered_set<uint32> seen;
  const int size = 1024;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) seen.insert(pixel_scramble(x, y, 1));
  const double collisions = static_cast<double>(size) * size - static_cast<double>(seen.size());
  const double expected = std::pow(size, 4) / std::pow(2, 33);
  CHECK(std::fabs(collisions - expected) < 5 * std::sqrt(expected));
}

TEST_CASE("rng: no two decisions of a path share a pair of numbers") {
  std::set<int> pairs = {PHALANX_PAIR_PIXEL, PHALANX_PAIR_LENS};
  int decisions = 2;
  for (int vertex = 0; vertex < 100; ++vertex)
    for (const int pair : {PHALANX_PAIR_BSDF, PHALANX_PAIR_LOBE, PHALANX_PAIR_LIGHT, PHALANX_PAIR_LIGHT_CHOICE}) {
      pairs.insert(PHALANX_PAIR_FIRST_VERTEX + vertex * PHALANX_PAIRS_PER_VERTEX + pair);
      ++decisions;
    }
  CHECK(pairs.size() == static_cast<std::size_t>(decisions));
}
