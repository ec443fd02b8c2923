// The film sums exactly enough, and in a way that nothing but the samples decides.
#include "film/film.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <tuple>

using namespace phalanx;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

Film one_pixel() { return Film({0, 0, 1, 1}, false); }

/// Adds `count` grey samples in passes of `pass`.
template <typename Sample>
void add(Film &film, std::int64_t count, int pass, Sample sample) {
  InvalidSamples invalid;
  std::vector<float> block(3 * static_cast<std::size_t>(pass));
  for (std::int64_t first = 0; first < count; first += pass) {
    for (int i = 0; i < pass; i++)
      block[3 * i] = block[3 * i + 1] = block[3 * i + 2] = sample(first + i);
    film.add_samples(0, 0, block.data(), pass, first, invalid);
  }
  CHECK(invalid.count == 0);
}

}  // namespace

TEST_CASE("film: the mean of 10^7 samples is right to 1e-6 (Q1)") {
  Film film = one_pixel();
  std::mt19937 random(1);
  std::exponential_distribution<float> exponential(1.0f);
  long double sum = 0;
  const std::int64_t count = 10'000'000;
  add(film, count, 64 * 625, [&](std::int64_t) {
    const float x = exponential(random);
    sum += x;
    return x;
  });
  const auto expected = static_cast<double>(sum / count);
  CHECK(film.sample_count(0) == count);
  CHECK(double{film.mean(0).x} == doctest::Approx(expected).epsilon(1e-6));
}

TEST_CASE("film: the variance of 10^4 +- 1 is right to 0.1 % (Q2)") {
  Film film = one_pixel();
  std::mt19937 random(2);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  const int count = 1 << 20;
  std::vector<double> values;
  add(film, count, 64, [&](std::int64_t) {
    values.push_back(double{1e4f + uniform(random)});
    return static_cast<float>(values.back());
  });
  long double mean = 0, squares = 0;
  for (const double v : values) mean += v / count;
  for (const double v : values) squares += (v - mean) * (v - mean);
  const auto expected = static_cast<double>(squares / (count - 1) / count);
  CHECK(double{film.variance_of_mean(0).y} == doctest::Approx(expected).epsilon(1e-3));
}

TEST_CASE("film: after one sample of 1e10 a million samples of 1 still count (L2)") {
  Film film = one_pixel();
  add(film, 1 << 20, 64, [](std::int64_t i) { return i == 0 ? 1e10f : 1.0f; });
  const double expected = (1e10 + (1 << 20) - 1) / (1 << 20);
  CHECK(double{film.mean(0).x} == doctest::Approx(expected).epsilon(1e-6));
}

TEST_CASE("film: where passes end does not change a bit") {
  std::mt19937 random(3);
  std::lognormal_distribution<float> lognormal(0.0f, 2.0f);
  std::vector<float> samples(960);
  for (float &s : samples) s = lognormal(random);
  const auto render = [&](int pass) {
    Film film = one_pixel();
    add(film, 960, pass, [&](std::int64_t i) { return samples[static_cast<std::size_t>(i)]; });
    return film;
  };
  const Film reference = render(960);
  for (const int pass : {1, 3, 64, 320}) {
    const Film film = render(pass);
    CHECK(film.mean(0).x == reference.mean(0).x);
    CHECK(film.variance_of_mean(0).x == reference.variance_of_mean(0).x);
  }
}

TEST_CASE("film: the variance of a constant is 0, of one sample unknown") {
  Film film = one_pixel();
  add(film, 1, 1, [](std::int64_t) { return 0.1f; });
  CHECK(film.variance_of_mean(0).x == kInf);
  add(film, 999, 1, [](std::int64_t) { return 0.1f; });
  CHECK(film.mean(0).x == 0.1f);
  CHECK(film.variance_of_mean(0).x == 0.0f);
}

TEST_CASE("film: a sample that is not finite is counted and left out") {
  Film film({10, 20, 2, 1}, false);
  InvalidSamples invalid;
  const float samples[] = {1, 2, 3, kNan, 0, 0, 3, 4, 5, 0, -kInf, 0, 0, 0, kInf};
  film.add_samples(11, 20, samples, 5, 64, invalid);
  CHECK(film.sample_count(1) == 2);
  CHECK(film.sample_count(0) == 0);
  CHECK(film.mean(1).x == 2.0f);
  CHECK(film.mean(1).y == 3.0f);
  CHECK(film.mean(1).z == 4.0f);
  CHECK(film.mean(0).x == 0.0f);
  CHECK(invalid.count == 3);
  CHECK(invalid.x == 11);
  CHECK(invalid.y == 20);
  CHECK(invalid.sample == 65);
}

TEST_CASE("film: a negative sample is counted as such and left out") {
  Film film({0, 0, 1, 1}, false);
  InvalidSamples invalid;
  const float samples[] = {1, 2, 3, 1, -1e-6f, 1, kNan, -1, 0, 0, 0, -0.0f};
  film.add_samples(0, 0, samples, 4, 0, invalid);
  CHECK(film.sample_count(0) == 2);
  CHECK(invalid.count == 2);
  CHECK(invalid.negative == 1);
  CHECK(invalid.not_finite == 1);
  CHECK(invalid.sample == 1);
}

TEST_CASE("film: clamped samples keep their colour, and what they lose is known") {
  Film film({0, 0, 1, 1}, false);
  film.set_clamp(2);
  InvalidSamples counts;
  const float samples[] = {1, 2, 0.5f, 8, 4, 0, 0, 0, 0, 0, 0, 2};
  film.add_samples(0, 0, samples, 4, 0, counts);
  CHECK(counts.count == 0);
  CHECK(counts.clamped == 1);
  CHECK(counts.clamped_energy == doctest::Approx((6 + 3) / 3.0));
  CHECK(film.mean(0).x == doctest::Approx((1 + 2) / 4.0));
  CHECK(film.mean(0).y == doctest::Approx((2 + 1) / 4.0));
  CHECK(film.energy() == doctest::Approx((3.5 + 3 + 2) / 3));
}

TEST_CASE("film: the first invalid sample does not depend on the order of tiles") {
  InvalidSamples a, b, c;
  a.add(5, 5, 3);
  b.add(9, 2, 3);
  c.add(1, 1, 4);
  for (const auto &[x, y, z] : {std::tuple(a, b, c), std::tuple(c, b, a), std::tuple(b, c, a)}) {
    InvalidSamples all;
    for (const InvalidSamples &part : {x, y, InvalidSamples{}, z}) all.merge(part);
    CHECK(all.count == 3);
    CHECK(all.x == 9);
    CHECK(all.y == 2);
    CHECK(all.sample == 3);
  }
}

TEST_CASE("film: first hits are averaged, depth over those that hit") {
  Film film({0, 0, 1, 1}, true);
  const float records[] = {1,    0.5f, 0, 0, 0, 1, 4,  // a hit
                           0,    0,    0, 0, 0, 0, 0,  // nothing there
                           kNan, 0,    0, 0, 0, 0, 1,  // left out
                           1,    0.5f, 0, 0, 1, 0, 6};
  film.add_aovs(0, 0, records, 4);
  CHECK(film.albedo(0).x == doctest::Approx(2.0 / 3));
  CHECK(film.albedo(0).y == doctest::Approx(1.0 / 3));
  CHECK(film.normal(0).y == doctest::Approx(1.0 / 3));
  CHECK(film.normal(0).z == doctest::Approx(1.0 / 3));
  CHECK(film.depth(0) == 5.0f);
}

TEST_CASE("film: without first hits there are no planes for them") {
  CHECK_FALSE(one_pixel().has_aovs());
  CHECK(Film::bytes_per_pixel(false) < Film::bytes_per_pixel(true));
}

TEST_CASE("film: a region goes out and in to the last bit, and nothing else changes") {
  for (const bool aovs : {false, true}) {
    const Rect crop = {10, 20, 7, 5}, region = {12, 21, 4, 3};
    Film a(crop, aovs), b(crop, aovs);
    InvalidSamples invalid;
    for (int y = 20; y < 25; ++y)
      for (int x = 10; x < 17; ++x) {
        const float samples[] = {0.1f * static_cast<float>(x), 3, 1e-30f, 5, kNan, 1, 7, 8, 1e20f};
        const float records[] = {0.1f, 0.2f, 0.3f, 0, 1, 0, static_cast<float>(y)};
        a.add_samples(x, y, samples, 3, 0, invalid);
        b.add_samples(x, y, samples + 6, 1, 0, invalid);
        if (aovs) a.add_aovs(x, y, records, 1);
      }
    const std::vector<std::byte> before = b.region_bytes({10, 24, 7, 1});
    b.set_region(region, a.region_bytes(region));
    CHECK(b.region_bytes(region) == a.region_bytes(region));
    CHECK(b.region_bytes({10, 24, 7, 1}) == before);
    CHECK(b.mean(8).x != a.mean(8).x);   // (11, 21): beside the region
    CHECK(b.mean(9).x == a.mean(9).x);   // (12, 21)
    CHECK(b.sample_count(9) == 2);
    Film tile(region, aovs);  // a film of the region alone
    tile.set_region(region, a.region_bytes(region));
    CHECK(tile.mean(0).x == a.mean(9).x);
    CHECK_THROWS_AS(tile.set_region(region, before), std::invalid_argument);
    CHECK(a.region_bytes({12, 21, 0, 0}).empty());
  }
}
