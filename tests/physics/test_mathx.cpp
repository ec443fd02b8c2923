// The language layer and the functions that both compilers must agree on.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../kernels/physics/mathx.h"
#include "support/random.h"

using namespace phalanx;
using test::Random;

namespace {

const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();

double sincos_error(float u) {
  const double angle = 2 * 3.14159265358979323846 * static_cast<double>(u);
  const SinCos r = sincos_turns(u);
  return std::max(std::fabs(static_cast<double>(r.sine) - std::sin(angle)),
                  std::fabs(static_cast<double>(r.cosine) - std::cos(angle)));
}

}  // namespace

TEST_CASE("sincos_turns: error below 2e-7 on [-1, 2]") {
  double worst = 0;
  for (int i = -1 << 20; i <= 1 << 21; ++i)
    worst = std::max(worst, sincos_error(static_cast<float>(i) * 0x1p-20f));
  Random random(1);
  for (int i = 0; i < 1000000; ++i) {
    worst = std::max(worst, sincos_error(random.between(-1, 2)));
    worst = std::max(worst, sincos_error(std::ldexp(random.unit(), -random.below(100))));
  }
  // Around every eighth of a turn, where the pieces meet.
  for (int eighth = -8; eighth <= 16; ++eighth) {
    float up = static_cast<float>(eighth) / 8, down = up;
    for (int ulp = 0; ulp < 100; ++ulp) {
      up = std::nextafter(up, 3.0f);
      down = std::nextafter(down, -3.0f);
      worst =
          std::max({worst, sincos_error(std::min(up, 2.0f)), sincos_error(std::max(down, -1.0f))});
    }
  }
  CHECK(worst < 2e-7);
}

TEST_CASE("sincos_turns: quarter turns are exact") {
  const float sine[] = {0, 1, 0, -1};
  for (int quarter = -4; quarter <= 8; ++quarter) {
    const SinCos r = sincos_turns(0.25f * static_cast<float>(quarter));
    CHECK(r.sine == sine[quarter & 3]);
    CHECK(r.cosine == sine[(quarter + 1) & 3]);
  }
}

TEST_CASE("lang: min, max and clamp take their second argument where one is NaN") {
  CHECK(min_of(kNan, 1.0f) == 1.0f);
  CHECK(max_of(kNan, 1.0f) == 1.0f);
  CHECK(std::isnan(min_of(1.0f, kNan)));
  CHECK(std::isnan(max_of(1.0f, kNan)));
  CHECK(clamp_to(kNan, 2.0f, 3.0f) == 2.0f);
  CHECK(clamp_to(5.0f, 2.0f, 3.0f) == 3.0f);
  CHECK(std::signbit(min_of(0.0f, -0.0f)));
  CHECK_FALSE(std::signbit(max_of(-0.0f, 0.0f)));
}

TEST_CASE("lang: bits, signs, roots and finiteness") {
  CHECK(abs_of(-0.0f) == 0.0f);
  CHECK_FALSE(std::signbit(abs_of(-0.0f)));
  CHECK(abs_of(-3.5f) == 3.5f);
  CHECK(copy_sign(-2.0f, 1.0f) == 2.0f);
  CHECK(copy_sign(2.0f, -0.0f) == -2.0f);
  CHECK(bits_from_float(1.0f) == 0x3f800000);
  CHECK(float_from_bits(0x40490fdb) == 3.14159274f);
  CHECK(to_float(-7) == -7.0f);
  CHECK(to_int(2.9f) == 2);
  CHECK(round_down(-0.5f) == -1.0f);
  CHECK(square_root(2.0f) == std::sqrt(2.0f));
  CHECK(safe_sqrt(-1e-9f) == 0.0f);
  CHECK(safe_sqrt(kNan) == 0.0f);
  CHECK(safe_sqrt(9.0f) == 3.0f);
  CHECK(is_finite(0.0f));
  CHECK(is_finite(-std::numeric_limits<float>::max()));
  CHECK(is_finite(PHALANX_FAR));
  CHECK_FALSE(is_finite(kInf));
  CHECK_FALSE(is_finite(-kInf));
  CHECK_FALSE(is_finite(kNan));
}
