// FLIP against the values of its authors' program (flip-evaluator 1.7) for the same pictures.
#include "report/flip.h"

#include <doctest/doctest.h>

#include <algorithm>

using namespace phalanx;

namespace {

/// A ramp; in the test image every other square of 5 x 5 pixels is 25 % brighter.
Image ramp(bool brighter_squares, float scale, float white) {
  Image image = make_image(40, 30);
  for (int c = 0; c < 3; c++) {
    std::vector<float> &plane = add_channel(image, std::string(1, "RGB"[c]));
    for (int y = 0; y < 30; y++)
      for (int x = 0; x < 40; x++) {
        const float value = static_cast<float>((x + 1) * (y + 1) * (c + 1)) / 1024;
        const bool brighter = brighter_squares && (x / 5 + y / 5) % 2 == 1;
        plane[y * 40 + x] = std::min(value * (brighter ? 1.25f : 1.0f) * scale, white);
      }
  }
  return image;
}

}  // namespace

TEST_CASE("flip: limited range") {
  const FlipResult result = flip(ramp(true, 0.25f, 1), ramp(false, 0.25f, 1), false);
  CHECK(result.mean == doctest::Approx(0.138988).epsilon(1e-4));
  CHECK(result.num_exposures == 1);
}

TEST_CASE("flip: high dynamic range") {
  const FlipResult result = flip(ramp(true, 1, 1e9f), ramp(false, 1, 1e9f), true);
  CHECK(result.mean == doctest::Approx(0.149155).epsilon(1e-4));
  CHECK(result.num_exposures == 3);
  CHECK(result.first_exposure == doctest::Approx(-0.0405138).epsilon(1e-4));
  CHECK(result.last_exposure == doctest::Approx(2.281414).epsilon(1e-4));
}

TEST_CASE("flip: an image does not differ from itself, black from white does") {
  CHECK(flip(ramp(true, 1, 1e9f), ramp(true, 1, 1e9f), true).mean == 0);
  CHECK(flip(ramp(false, 0, 1), ramp(false, 0, 1), true).mean == 0);
  CHECK(flip(ramp(false, 1e9f, 1), ramp(false, 0, 1), false).mean ==
        doctest::Approx(1).epsilon(0.05));
}
