// Transcendental functions of our own, so that both compilers give the same bits.
//
// The libraries of C++ and ISPC round sin, cos, exp and log differently; these polynomials use
// only + - * / and roots, and are compiled without contraction into FMA. Coefficients: minimax, after
// Moshier's Cephes (sinf, cosf, expf, logf, atanf, asinf), if nothing else is said.
#pragma once
#include "lang.h"

PHALANX_BEGIN

#define PHALANX_PI 3.14159265358979f
#define PHALANX_INV_PI 0.318309886183791f

struct SinCos {
  float sine, cosine;
};

/// sin(2 pi u) and cos(2 pi u) for u in [-1, 2]. Absolute error below 2e-7. The argument is reduced
/// exactly in turns, so quarter turns are exact.
PHYS SinCos sincos_turns(float u) {
  const float quarter = round_down(4.0f * u + 0.5f);
  const float x = (u - 0.25f * quarter) * 6.28318530717959f;
  const float x2 = x * x;
  const float s =
      x + x * x2 * (-1.6666654611e-1f + x2 * (8.3321608736e-3f + x2 * -1.9515295891e-4f));
  const float c = 1.0f - 0.5f * x2 +
                  x2 * x2 * (4.166664568298827e-2f +
                             x2 * (-1.388731625493765e-3f + x2 * 2.443315711809948e-5f));
  const int32 q = to_int(quarter) & 3;
  const float s1 = (q & 1) != 0 ? c : s;
  const float c1 = (q & 1) != 0 ? s : c;
  SinCos r;
  r.sine = (q & 2) != 0 ? -s1 : s1;
  r.cosine = (q == 1 || q == 2) ? -c1 : c1;
  return r;
}

// ln 2 in two parts: the first has so few bits that its products with whole numbers below 2^15 are exact.
#define PHALANX_LN2_HI 0.693359375f
#define PHALANX_LN2_LO -2.12194440e-4f
#define PHALANX_SMALLEST_NORMAL 1.17549435e-38f

/// e^(hi + lo), |lo| far below 1. Saturates at 3.4e38; 0 where the result would be denormal.
PHYS float exp_of_sum(float hi, float lo) {
  const float x = clamp_to(hi, -88.0f, 88.72283f);
  const float n = round_down(1.44269504088896f * x + 0.5f);
  const float r = ((x - n * PHALANX_LN2_HI) - n * PHALANX_LN2_LO) + lo;
  float y = 1.9875691500e-4f;
  y = y * r + 1.3981999507e-3f;
  y = y * r + 8.3334519073e-3f;
  y = y * r + 4.1665795894e-2f;
  y = y * r + 1.6666665459e-1f;
  y = y * r + 5.0000001201e-1f;
  y = (y * (r * r) + r) + 1.0f;
  // 2^n in two factors: n reaches 128.
  const int32 half = to_int(n) >> 1;
  const float a = float_from_bits((half + 127) << 23);
  const float b = float_from_bits((to_int(n) - half + 127) << 23);
  return x < -87.33654f ? 0.0f : y * a * b;
}

/// e^x, relative error below 2e-7. Saturates at 3.4e38; 0 below the smallest normal number.
PHYS float exp_of(float x) { return exp_of_sum(x, 0.0f); }

/// x = fraction * 2^exponent with fraction in [sqrt(1/2), sqrt(2)); x normal and positive.
struct Exponent {
  float fraction, exponent;
};

PHYS Exponent split_exponent(float x) {
  // 0x3f3504f3 is sqrt(1/2), rounded.
  const int32 offset = bits_from_float(x) - 0x3f3504f3;
  Exponent r;
  r.exponent = to_float(offset >> 23);
  r.fraction = float_from_bits((offset & 0x007fffff) + 0x3f3504f3);
  return r;
}

/// ln x for x > 0, relative error below 2e-7. Zero and denormals give ln of the smallest normal number.
PHYS float log_of(float x) {
  const Exponent split = split_exponent(max_of(x, PHALANX_SMALLEST_NORMAL));
  const float m = split.fraction - 1.0f;
  const float m2 = m * m;
  float y = 7.0376836292e-2f;
  y = y * m - 1.1514610310e-1f;
  y = y * m + 1.1676998740e-1f;
  y = y * m - 1.2420140846e-1f;
  y = y * m + 1.4249322787e-1f;
  y = y * m - 1.6668057665e-1f;
  y = y * m + 2.0000714765e-1f;
  y = y * m - 2.4999993993e-1f;
  y = y * m + 3.3333331174e-1f;
  y = (y * m) * m2 + split.exponent * PHALANX_LN2_LO;
  y = y - 0.5f * m2;
  return (m + y) + split.exponent * PHALANX_LN2_HI;
}

/// A number as a sum of two floats, |lo| at most half an ulp of hi.
struct Extended {
  float hi, lo;
};

/// a + b exactly, |a| >= |b| (Dekker 1971).
PHYS Extended exact_sum(float a, float b) {
  Extended r;
  r.hi = a + b;
  r.lo = b - (r.hi - a);
  return r;
}

/// The upper 12 bits of the significand: products of such parts are exact.
PHYS float upper_bits(float x) { return float_from_bits(bits_from_float(x) & (int32)0xfffff000u); }

/// a * b exactly, but for underflow of lo (Dekker 1971).
PHYS Extended exact_product(float a, float b) {
  const float a1 = upper_bits(a);
  const float a2 = a - a1;
  const float b1 = upper_bits(b);
  const float b2 = b - b1;
  Extended r;
  r.hi = a * b;
  r.lo = (((a1 * b1 - r.hi) + a1 * b2) + a2 * b1) + a2 * b2;
  return r;
}

/// ln x for normal x > 0, relative error below 1e-8: 2 artanh((x - 1) / (x + 1)) with the quotient in
/// two floats (the way of fdlibm's powf).
PHYS Extended extended_log(float x) {
  const Exponent split = split_exponent(x);
  const float above = split.fraction - 1.0f;  // exact
  const Extended below = exact_sum(1.0f, split.fraction);
  const float inverse = 1.0f / below.hi;
  const float s = above * inverse;
  const Extended back = exact_product(s, below.hi);
  const float s_rest = (((above - back.hi) - back.lo) - s * below.lo) * inverse;
  const float s2 = s * s;
  float series = 9.0909091e-2f;
  series = series * s2 + 1.1111111e-1f;
  series = series * s2 + 1.4285715e-1f;
  series = series * s2 + 2.0e-1f;
  series = series * s2 + 3.3333334e-1f;
  const float rest = 2.0f * (s_rest + s * s2 * series) + split.exponent * PHALANX_LN2_LO;
  const Extended sum = exact_sum(split.exponent * PHALANX_LN2_HI, 2.0f * s);
  return exact_sum(sum.hi, sum.lo + rest);
}

/// x^y for x >= 0, relative error below 5e-7; y finite. 0^0 = 1. Saturates at 3.4e38; 0 where the result
/// would be denormal. Denormal x count as 0.
PHYS float pow_of(float x, float y) {
  if (x < PHALANX_SMALLEST_NORMAL) return y > 0.0f ? 0.0f : (y == 0.0f ? 1.0f : 3.4e38f);
  const Extended log = extended_log(x);
  const float about = y * log.hi;
  // Beyond this range the exact product could overflow, and the result has no digits to keep.
  if (!(abs_of(about) < 100.0f)) return exp_of(about);
  const Extended product = exact_product(y, log.hi);
  return exp_of_sum(product.hi, product.lo + y * log.lo);
}

/// Angle of the point (x, y) in turns, in (-0.5, 0.5]; relative error below 3e-7. (0, 0) gives 0.
PHYS float atan2_turns(float y, float x) {
  const float ax = abs_of(x);
  const float ay = abs_of(y);
  const float large = max_of(ax, ay);
  const float small = min_of(ax, ay);
  if (!(large > 0.0f)) return 0.0f;
  // Above tan(pi / 8): atan(t) = pi / 4 + atan((t - 1) / (t + 1)).
  const bool steep = small > 0.4142135624f * large;
  const float t = (steep ? small - large : small) / (steep ? small + large : large);
  const float t2 = t * t;
  float p = 8.05374449538e-2f;
  p = p * t2 - 1.38776856032e-1f;
  p = p * t2 + 1.99777106478e-1f;
  p = p * t2 - 3.33329491539e-1f;
  float turns = (p * t2 * t + t) * 0.159154943091895f;
  if (steep) turns = 0.125f + turns;
  if (ay > ax) turns = 0.25f - turns;
  if (x < 0.0f) turns = 0.5f - turns;
  return y < 0.0f && turns < 0.5f ? -turns : turns;
}

/// arcsin of s in [0, 0.5], given with its square.
PHYS float asin_series(float s, float s2) {
  float p = 4.2163199048e-2f;
  p = p * s2 + 2.4181311049e-2f;
  p = p * s2 + 4.5470025998e-2f;
  p = p * s2 + 7.4953002686e-2f;
  p = p * s2 + 1.6666752422e-1f;
  return p * s2 * s + s;
}

/// arccos in radians, in [0, pi], relative error below 3e-7. Arguments are clamped to [-1, 1].
PHYS float acos_of(float x) {
  const float c = clamp_to(x, -1.0f, 1.0f);
  const float a = abs_of(c);
  if (a > 0.5f) {
    const float s2 = 0.5f * (1.0f - a);
    const float angle = 2.0f * asin_series(square_root(s2), s2);
    return c > 0.0f ? angle : PHALANX_PI - angle;
  }
  const float angle = asin_series(a, a * a);
  return 0.5f * PHALANX_PI - (c > 0.0f ? angle : -angle);
}

/// arcsin in radians, in [-pi/2, pi/2], relative error below 3e-7. Arguments are clamped to [-1, 1].
PHYS float asin_of(float x) {
  const float c = clamp_to(x, -1.0f, 1.0f);
  const float a = abs_of(c);
  float angle = asin_series(a, a * a);
  if (a > 0.5f) {
    const float s2 = 0.5f * (1.0f - a);
    angle = 0.5f * PHALANX_PI - 2.0f * asin_series(square_root(s2), s2);
  }
  return copy_sign(angle, c);
}

/// 1 - e^-x for x >= 0, relative error below 5e-7.
PHYS float one_minus_exp(float x) {
  const float series =
      x * (1.0f - x * (0.5f - x * (1.6666667e-1f - x * (4.1666667e-2f - x * 8.3333333e-3f))));
  return x < 0.1f ? series : 1.0f - exp_of(-x);
}

/// -ln(1 - x) for x in [0, 1], relative error below 4e-7; 87.3 at 1.
PHYS float neg_log_1m(float x) {
  // 1 - x rounds; the quotient makes up for it (Kahan; Higham 2002, section 1.14.1).
  const float rest = 1.0f - x;
  if (rest == 1.0f) return x;
  return log_of(rest) * (x / (rest - 1.0f));
}

PHALANX_END
