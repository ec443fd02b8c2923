// Error metrics on images whose errors can be worked out by hand.
#include "report/metrics.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

using namespace phalanx;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

Image grey(const std::vector<float> &values) {
  Image image = make_image(static_cast<int>(values.size()), 1);
  for (const char *name : {"R", "G", "B"}) add_channel(image, name) = values;
  return image;
}

}  // namespace

TEST_CASE("metrics: an image has no error against itself") {
  const Image image = grey({0, 1, 2, 1e30f, -1});
  const ImageErrors e = compare_images(image, image);
  CHECK(e.num_pixels == 5);
  CHECK(e.num_different == 0);
  for (const double error :
       {e.mse, e.relmse, e.relmse_literature, e.relmse_trimmed, e.smape, e.max})
    CHECK(error == 0);
  CHECK(e.image.negative == 3);  // one pixel, three channels
}

TEST_CASE("metrics: a uniform error of 10 %") {
  const ImageErrors e = compare_images(grey({1.1f, 1.1f}), grey({1, 1}));
  CHECK(e.mse == doctest::Approx(0.01).epsilon(1e-6));
  CHECK(e.relmse == doctest::Approx(0.01 / (1 + 1e-4)).epsilon(1e-6));
  CHECK(e.relmse_literature == doctest::Approx(0.01 / 1.01).epsilon(1e-6));
  CHECK(e.smape == doctest::Approx(0.2 / (2.1 + 1e-3)).epsilon(1e-6));
  CHECK(e.p50 == doctest::Approx(0.1).epsilon(1e-3));
  CHECK(e.max == doctest::Approx(0.1).epsilon(1e-3));
  CHECK(e.num_different == 2);
}

TEST_CASE("metrics: relMSE does not depend on units") {
  const ImageErrors a = compare_images(grey({1, 2, 0.5f}), grey({1.5f, 2, 0.25f}));
  const ImageErrors b = compare_images(grey({1024, 2048, 512}), grey({1536, 2048, 256}));
  CHECK(a.relmse == b.relmse);
  CHECK(a.smape == b.smape);
  CHECK(b.mse == a.mse * 1024 * 1024);
}

TEST_CASE("metrics: trimming drops the worst pixel in a thousand") {
  std::vector<float> reference(1000, 1.0f), image = reference;
  image[500] = 1001;
  const ImageErrors e = compare_images(grey(image), grey(reference));
  CHECK(e.relmse == doctest::Approx(1e6 / (1 + 1e-4) / 1000));
  CHECK(e.relmse_trimmed == 0);
  CHECK(e.p999 == 0);
  CHECK(e.max == doctest::Approx(1000).epsilon(1e-3));
}

TEST_CASE("metrics: what is not finite is left out and counted, never taken as right") {
  const ImageErrors e = compare_images(grey({kNan, 2, kInf, 4}), grey({1, 1, 1, -kInf}));
  CHECK(e.num_pixels == 1);
  CHECK(e.num_left_out == 3);
  CHECK(e.image.nan == 3);
  CHECK(e.image.inf == 3);
  CHECK(e.reference.inf == 3);
  CHECK(e.mse == 1);
  const ImageErrors none = compare_images(grey({kNan}), grey({kNan}));
  CHECK(none.num_pixels == 0);
  CHECK(none.num_left_out == 1);
  CHECK(none.num_different == 0);  // the same bits
}

TEST_CASE("metrics: against a black reference a wrong pixel is infinitely wrong") {
  CHECK(compare_images(grey({0, 0}), grey({0, 0})).relmse == 0);
  const ImageErrors e = compare_images(grey({0, 1}), grey({0, 0}));
  CHECK(std::isinf(e.relmse));
  CHECK(e.mse == 0.5);
  CHECK(e.relmse_literature == doctest::Approx(50));
  CHECK(e.smape == 1);  // 2 in one of two pixels
}

TEST_CASE("metrics: images that cannot be compared are refused") {
  CHECK_THROWS_AS(compare_images(grey({1}), grey({1, 1})), InputError);
  CHECK_THROWS_AS(compare_images(grey({1}), make_image(1, 1)), InputError);
}

TEST_CASE("metrics: the difference image") {
  const Image d = difference_image(grey({1, 3}), grey({2, 3}));
  CHECK(d.channels[0].values == std::vector<float>{1, 0});
  CHECK(find_channel(d, "error.relative")->values[0] == doctest::Approx(0.5).epsilon(1e-3));
}
