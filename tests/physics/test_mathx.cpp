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

double relative_error(float got, double wanted) {
  return std::fabs(static_cast<double>(got) / wanted - 1);
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

TEST_CASE("exp_of: relative error below 2e-7, saturation at both ends") {
  Random random(2);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    float x = random.between(-87.336f, 88.722f);
    if (i % 2 == 0) x = std::ldexp(x, -random.below(40));
    worst = std::max(worst, relative_error(exp_of(x), std::exp(static_cast<double>(x))));
  }
  CHECK(worst < 2e-7);
  CHECK(exp_of(0) == 1.0f);
  CHECK(exp_of(88.8f) > 3.4e38f);
  CHECK(exp_of(88.8f) == exp_of(1e30f));
  CHECK(exp_of(kInf) == exp_of(1e30f));
  CHECK(is_finite(exp_of(kInf)));
  CHECK(exp_of(-87.4f) == 0.0f);
  CHECK(exp_of(-1e30f) == 0.0f);
  CHECK(exp_of(-kInf) == 0.0f);
}

TEST_CASE("log_of: relative error below 2e-7 at all magnitudes and around 1") {
  Random random(3);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    const float x = i % 2 == 0 ? std::exp2(random.between(-125.9f, 127.9f)) : random.between(0.4f, 2.5f);
    if (x != 1.0f)
      worst = std::max(worst, relative_error(log_of(x), std::log(static_cast<double>(x))));
  }
  for (float up = 1, down = 1; up < 1.0001f;) {
    up = std::nextafter(up, 2.0f);
    down = std::nextafter(down, 0.0f);
    worst = std::max({worst, relative_error(log_of(up), std::log(static_cast<double>(up))),
                      relative_error(log_of(down), std::log(static_cast<double>(down)))});
  }
  CHECK(worst < 2e-7);
  CHECK(log_of(1) == 0.0f);
  CHECK(log_of(0) == doctest::Approx(-87.3365f));
  CHECK(log_of(1e-42f) == log_of(0));
}

TEST_CASE("pow_of: relative error below 5e-7 for every result in range") {
  Random random(4);
  double worst = 0;
  for (int i = 0; i < 2000000; ++i) {
    float y = std::exp2(random.between(-6, 14)) * (random.chance(0.5) ? 1.0f : -1.0f);
    if (i % 4 == 0) y = std::round(y);
    // Half of the bases are such that the result lies anywhere in range, however large y.
    float x = std::exp2(random.between(-125, 127));
    if (i % 2 == 0 && y != 0) x = std::exp(random.between(-80, 80) / y);
    const double wanted = std::pow(static_cast<double>(x), static_cast<double>(y));
    if (x < 1.2e-38f || wanted < 1.2e-38 || wanted > 3.3e38 || x > 1e38f) continue;
    worst = std::max(worst, relative_error(pow_of(x, y), wanted));
  }
  CHECK(worst < 5e-7);
}

TEST_CASE("pow_of: special values") {
  CHECK(pow_of(0, 0) == 1.0f);
  CHECK(pow_of(0, 3) == 0.0f);
  CHECK(pow_of(0, 1e-3f) == 0.0f);
  CHECK(pow_of(0, -1) > 3e38f);
  CHECK(is_finite(pow_of(0, -1)));
  for (const float x : {1e-30f, 0.3f, 1.0f, 7.0f, 1e30f}) {
    CHECK(pow_of(x, 0) == 1.0f);
    CHECK(pow_of(x, 1) == doctest::Approx(x).epsilon(5e-7));
    CHECK(pow_of(1, x) == 1.0f);
  }
  CHECK(pow_of(2, 1e30f) == exp_of(1e30f));
  CHECK(pow_of(0.5f, 1e30f) == 0.0f);
  CHECK(pow_of(2, 10) == doctest::Approx(1024).epsilon(3e-7));
  CHECK(pow_of(1e-42f, 2) == 0.0f);
}

TEST_CASE("atan2_turns: relative error below 3e-7 in all octants, whole range, the axes exact") {
  Random random(5);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    float y = random.between(-1, 1), x = random.between(-1, 1);
    if (i % 4 == 0) y = std::ldexp(y, -random.below(60));
    if (i % 4 == 1) x = std::ldexp(x, -random.below(60));
    const float turns = atan2_turns(y, x);
    REQUIRE(turns > -0.5f);
    REQUIRE(turns <= 0.5f);
    const double wanted =
        std::atan2(static_cast<double>(y), static_cast<double>(x)) / 6.283185307179586;
    // Just below the negative x axis -0.5 is rounded to +0.5, the same angle.
    const double error = std::fabs(static_cast<double>(turns) - wanted);
    worst = std::max(worst, std::min(error, std::fabs(1 - error)) / std::fabs(wanted));
  }
  CHECK(worst < 3e-7);
  CHECK(atan2_turns(0, 0) == 0.0f);
  CHECK(atan2_turns(0, 3) == 0.0f);
  CHECK(atan2_turns(2, 0) == 0.25f);
  CHECK(atan2_turns(-2, 0) == -0.25f);
  CHECK(atan2_turns(0, -1) == 0.5f);
  CHECK(atan2_turns(-0.0f, -1) == 0.5f);
  CHECK(atan2_turns(-1e-30f, -1) == 0.5f);
  CHECK(atan2_turns(1, 1) == 0.125f);
  CHECK(atan2_turns(-1, -1) == -0.375f);
}

TEST_CASE("acos_of, asin_of: relative error below 3e-7, arguments clamped") {
  Random random(6);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) {
    float x = random.between(-1, 1);
    if (i % 3 == 1) x = std::ldexp(x, -random.below(40));
    if (i % 3 == 2) x = 1 - std::fabs(std::ldexp(x, -random.below(22)));
    const double exact = static_cast<double>(x);
    if (x < 1) worst = std::max(worst, relative_error(acos_of(x), std::acos(exact)));
    if (x != 0) worst = std::max(worst, relative_error(asin_of(x), std::asin(exact)));
  }
  CHECK(worst < 3e-7);
  CHECK(acos_of(1) == 0.0f);
  CHECK(acos_of(1.5f) == 0.0f);
  CHECK(acos_of(-1.5f) == PHALANX_PI);
  CHECK(asin_of(0) == 0.0f);
  CHECK(asin_of(9) == 0.5f * PHALANX_PI);
  CHECK(asin_of(-9) == -0.5f * PHALANX_PI);
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
