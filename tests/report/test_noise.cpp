// What is said about noise agrees with noise that is known.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "output/film_image.h"
#include "report/estimate.h"
#include "report/metrics.h"
#include "report/welch.h"

using namespace phalanx;

namespace {

/// Independent samples, uniform in [0, 2 * brightness].
Film noisy_film(int side, int spp, unsigned seed, float brightness = 1) {
  Film film({0, 0, side, side}, false);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.0f, 2.0f * brightness);
  InvalidSamples invalid;
  std::vector<float> samples(3 * static_cast<std::size_t>(spp));
  for (int y = 0; y < side; y++)
    for (int x = 0; x < side; x++) {
      for (float &s : samples) s = uniform(random);
      film.add_samples(x, y, samples.data(), spp, 0, invalid);
    }
  return film;
}

Image noisy_image(int side, int spp, unsigned seed, float brightness = 1) {
  Image image = image_from_film(noisy_film(side, spp, seed, brightness), side, side,
                                layers_from_list("samples,variance"));
  image.metadata = {{"phalanx.seed", std::to_string(seed)}};
  return image;
}

}  // namespace

TEST_CASE("estimate: predicts the relMSE against the truth") {
  const Film film = noisy_film(64, 16, 1);
  Image truth = make_image(64, 64);
  for (const char *name : {"R", "G", "B"}) add_channel(truth, name).assign(64 * 64, 1.0f);
  const double actual = compare_images(image_from_film(film, 64, 64, {}), truth).relmse;
  const ErrorEstimate estimate = estimate_error(film, false);
  CHECK(actual == doctest::Approx(1.0 / 3 / 16).epsilon(0.05));
  CHECK(estimate.relmse == doctest::Approx(actual).epsilon(0.1));
  CHECK(estimate.lo95 < estimate.relmse);
  CHECK(estimate.relmse < estimate.hi95);
  CHECK(estimate.hi95 < 1.1 * estimate.relmse);
  CHECK(estimate.method == "sample variance");
  CHECK(estimate_error(film, true).method == "sample variance (an upper bound for Sobol points)");
}

TEST_CASE("estimate: says nothing where nothing is known") {
  CHECK(std::isnan(estimate_error(noisy_film(32, 1, 1), true).relmse));
  const ErrorEstimate one_tile = estimate_error(noisy_film(8, 4, 1), true);
  CHECK_FALSE(std::isnan(one_tile.relmse));
  CHECK(std::isnan(one_tile.lo95));
}

TEST_CASE("estimate: a black picture and a constant one have no error") {
  CHECK(estimate_error(noisy_film(32, 4, 1, 0), true).relmse == 0);
  CHECK(estimate_error(noisy_film(32, 4, 1, 0), true).hi95 == 0);
}

TEST_CASE("welch: two runs of one scene agree (fixed seeds, false alarm 1e-3)") {
  std::string reason;
  const auto test = welch_test(noisy_image(128, 16, 1), noisy_image(128, 16, 2), reason);
  REQUIRE(test.has_value());
  CHECK(test->num_tiles == 256);
  for (int c = 0; c < 3; c++) {
    CHECK(test->mean_p[c] > 1e-3 / 6);
    CHECK(test->uniformity_p[c] > 1e-3 / 6);
  }
}

TEST_CASE("welch: a bias of 5 %, a third of the noise of a pixel, is found") {
  std::string reason;
  const auto test = welch_test(noisy_image(128, 16, 1), noisy_image(128, 16, 2, 1.05f), reason);
  REQUIRE(test.has_value());
  CHECK(test->mean_p[1] < 1e-10);
  CHECK(test->uniformity_p[1] < 1e-3);
  CHECK(test->mean_difference[1] == doctest::Approx(-0.05).epsilon(0.2));
}

TEST_CASE("welch: says why it is left out") {
  std::string reason;
  const Image a = noisy_image(16, 4, 1);
  CHECK_FALSE(welch_test(a, a, reason).has_value());
  CHECK(reason == "both images have seed 1: the test needs independent samples");
  Image plain = a;
  plain.channels.resize(3);
  CHECK_FALSE(welch_test(plain, noisy_image(16, 4, 2), reason).has_value());
  CHECK(reason.find("--aov samples,variance") != std::string::npos);
  const auto few = welch_test(a, noisy_image(16, 4, 2), reason);
  REQUIRE(few.has_value());
  CHECK(std::isnan(few->uniformity_p[0]));  // 4 tiles do not fill 20 bins
}
