// Stratified, Halton and blue-noise samples: what each promises about its points.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "support/samplers.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

/// True if the sorted numbers lie one in each of as many equal parts of [0, 1), but for rounding.
bool one_in_each(std::vector<float> numbers) {
  std::sort(numbers.begin(), numbers.end());
  const double n = static_cast<double>(numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const double scaled = static_cast<double>(numbers[k]) * n - static_cast<double>(k);
    if (scaled < -1e-3 || scaled > 1.001) return false;
  }
  return true;
}

/// True if each of nx x ny cells holds one of the points, none of which lies near its walls.
bool one_in_each_cell(const std::vector<Vec2> &points, int nx, int ny) {
  std::vector<int> counts(static_cast<std::size_t>(nx * ny));
  for (const Vec2 p : points) {
    const int x = static_cast<int>(static_cast<double>(p.x) * nx);
    const int y = static_cast<int>(static_cast<double>(p.y) * ny);
    ++counts[static_cast<std::size_t>(x * ny + y)];
  }
  return std::all_of(counts.begin(), counts.end(), [](int count) { return count == 1; });
}

std::vector<float> column(const std::vector<Vec2> &points, float Vec2::*coordinate) {
  std::vector<float> numbers;
  for (const Vec2 p : points) numbers.push_back(p.*coordinate);
  return numbers;
}

}  // namespace

TEST_CASE("permuted: a permutation, and any two elements go anywhere") {
  for (const int n : {1, 2, 3, 4, 5, 7, 8, 9, 16, 100, 1000}) {
    std::vector<char> seen(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      const int32 j = permuted<5>(i, n, hash32(static_cast<uint32>(n)));
      REQUIRE((j >= 0 && j < n));
      seen[static_cast<std::size_t>(j)] = 1;
    }
    CHECK(std::count(seen.begin(), seen.end(), 1) == n);
  }
  CHECK(permuted<5>(PHALANX_MAX_STRATA - 1, PHALANX_MAX_STRATA, 5) < PHALANX_MAX_STRATA);
  for (const int n : {2, 3, 4, 5, 8, 12})
    for (const int other : {1, n - 1}) {
      Histogram histogram({n, n, 0, 1, 0, 1});
      std::vector<double> masses;
      for (int k = 0; k < n * n; ++k) masses.push_back(k % (n + 1) == 0 ? 0 : 1.0 / (n * (n - 1)));
      for (uint32 seed = 0; seed < 100000; ++seed) {
        const uint32 h = hash32(seed);
        histogram.add((permuted<5>(0, n, h) + 0.5) / n, (permuted<5>(other, n, h) + 0.5) / n);
      }
      CAPTURE(n);
      CHECK(chi_square_fit(histogram, masses).p > alpha());
    }
}

TEST_CASE("stratified: any number of samples has one in each part of either side") {
  for (const int spp : {1, 2, 3, 4, 5, 7, 12, 16, 17, 60, 64, 100, 529, 1024})
    for (const int set : {0, 1, 9})
      for (const int dimension : {0, 1, 7, 70})
        for (uint32 pixel = 0; pixel < 5; ++pixel) {
          const FrameView frame = sampler_frame(kStratifiedSampler, spp);
          const std::vector<Vec2> p = points(frame, hash32(pixel), dimension, set * spp, spp);
          CAPTURE(spp);
          REQUIRE(one_in_each(column(p, &Vec2::y)));
          const int columns = static_cast<int>(std::sqrt(spp)), rows = (spp + columns - 1) / columns;
          if (columns * rows != spp) continue;
          REQUIRE(one_in_each(column(p, &Vec2::x)));
          REQUIRE(one_in_each_cell(p, columns, rows));
        }
}

TEST_CASE("stratified: samples beyond the largest number of strata are further sets") {
  const FrameView frame = sampler_frame(kStratifiedSampler, 1 << 30);
  std::vector<Vec2> late;
  for (int i = 0; i < 1 << 16; ++i)
    late.push_back(sample_pair(frame, 1, (1 << 30) - 1 - i * 16381, 2));
  CHECK(chi_square_of(late, 16) > alpha());
}

TEST_CASE("halton: the primes") {
  int n = 0;
  for (int candidate = 2; n < PHALANX_NUM_PRIMES; ++candidate) {
    bool is_prime = true;
    for (int k = 2; k * k <= candidate; ++k) is_prime &= candidate % k != 0;
    if (is_prime) REQUIRE(kPrimes[n++] == candidate);
  }
}

TEST_CASE("halton: runs of b^k samples have one in each b^-k of the coordinate of base b") {
  for (int d = 0; d < PHALANX_NUM_PRIMES; d += d < 12 ? 1 : 9) {
    const int base = kPrimes[d];
    for (int n = base; n <= 5000; n *= base)
      for (const int run : {0, 1, 7}) {
        const FrameView frame = sampler_frame(kHaltonSampler, (run + 1) * n);
        const std::vector<Vec2> p =
            points(frame, hash32(static_cast<uint32>(d)), d / 2, run * n, n);
        CAPTURE(base);
        CAPTURE(n);
        REQUIRE(one_in_each(column(p, d % 2 == 0 ? &Vec2::x : &Vec2::y)));
      }
  }
}

TEST_CASE("halton: 2^a 3^b samples have one in each cell of 2^a x 3^b") {
  for (int a = 0; a <= 6; ++a)
    for (int b = 0; b <= 4; ++b) {
      const int nx = 1 << a, ny = static_cast<int>(std::lround(std::pow(3, b)));
      for (uint32 pixel = 0; pixel < 10; ++pixel) {
        const FrameView frame = sampler_frame(kHaltonSampler, nx * ny);
        CHECK(one_in_each_cell(points(frame, hash32(pixel), 0, 0, nx * ny), nx, ny));
      }
    }
}

TEST_CASE("halton: digits are permuted so that any two go anywhere, first and second ones") {
  for (const int d : {0, 1, 2, 3, 4, 7}) {
    const int b = kPrimes[d];
    for (const int step : {1, b}) {  // samples that differ in the first digit, or in the second
      const int cells = step == 1 ? b : b * b;
      Histogram histogram({b, b, 0, 1, 0, 1});
      std::vector<double> masses;
      for (int k = 0; k < b * b; ++k) masses.push_back(k % (b + 1) == 0 ? 0 : 1.0 / (b * (b - 1)));
      for (uint32 pixel = 0; pixel < 100000; ++pixel) {
        const auto digit = [&](int index) {
          const float u = scrambled_radical_inverse(index, b, hash32(pixel), b * b);
          return (static_cast<int>(static_cast<double>(u) * cells) % b + 0.5) / b;
        };
        const int other = static_cast<int>(1 + pixel % static_cast<uint32>(b - 1));
        const double a = digit(0);
        histogram.add(a, digit(other * step));
      }
      CAPTURE(b);
      CAPTURE(step);
      CHECK(chi_square_fit(histogram, masses).p > alpha());
    }
  }
}

TEST_CASE("blue_noise: morton_code") {
  CHECK(morton_code(0, 0) == 0);
  CHECK(morton_code(1, 0) == 1);
  CHECK(morton_code(0, 1) == 2);
  CHECK(morton_code(5, 3) == 27);
  CHECK(morton_code(65535, 65535) == 0xffffffffu);
  CHECK(blue_noise_bits(1024, 600, 64) == 26);
  CHECK(blue_noise_bits(600, 1025, 65) == 29);
}

TEST_CASE("blue_noise: scramble_base4 permutes digits depending on those before") {
  std::map<int, double> counts;  // of the permutations of one digit
  for (uint32 seed = 0; seed < 50000; ++seed) {
    const uint32 h = hash32(seed), before = hash32(seed + 1000000);
    const int place = static_cast<int>(2 * (seed % 15));
    const uint32 high = before >> (place + 2) << (place + 2);
    int code = 0;
    for (uint32 digit = 0; digit < 4; ++digit) {
      const uint32 x = scramble_base4(high | digit << place, h);
      // Digits before do not depend on this one, nor on those after.
      REQUIRE(((x ^ scramble_base4(before, h)) >> (place + 2)) == 0);
      code = 4 * code + static_cast<int>(x >> place & 3);
    }
    counts[code] += 1;
  }
  REQUIRE(counts.size() == 24);
  for (const auto &[code, count] : counts) CHECK(count * 24 / 50000 == doctest::Approx(1).epsilon(0.15));
}

TEST_CASE("blue_noise: samples of every aligned block of pixels are a net") {
  for (int m = 0; m <= 7; ++m)
    for (const int dimension : {0, 1, 5, 40})
      for (int seed = 0; seed < 3; ++seed)
        for (int log2_block = 0; log2_block <= 3; ++log2_block) {
          const FrameView frame = sampler_frame(kBlueNoiseSampler, 1 << m, seed);
          const int size = 1 << log2_block;
          std::vector<Vec2> all;
          for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
              const uint32 place = pixel_scramble(frame, 21 * size + x, 13 * size + y);
              for (int i = 0; i < 1 << m; ++i)
                all.push_back(sample_pair(frame, place, i, dimension));
            }
          CAPTURE(m);
          CAPTURE(size);
          REQUIRE(is_net(all, m + 2 * log2_block));
        }
}

TEST_CASE("blue_noise: samples beyond spp are of a further sequence, and nets again") {
  const FrameView frame = sampler_frame(kBlueNoiseSampler, 12);  // counts as 16
  const uint32 place = pixel_scramble(frame, 7, 8);
  const std::vector<Vec2> first = points(frame, place, 3, 0, 16), next = points(frame, place, 3, 16, 16);
  CHECK(is_net(first, 4));
  CHECK(is_net(next, 4));
  for (std::size_t k = 0; k < 16; ++k) CHECK(first[k].x != next[k].x);
}
