// Transcendental functions of our own, so that both compilers give the same bits.
//
// The libraries of C++ and ISPC round sin, cos, exp and log differently; these polynomials use
// only + - * and are compiled without contraction into FMA.
#pragma once
#include "lang.h"

PHALANX_BEGIN

#define PHALANX_PI 3.14159265358979f
#define PHALANX_INV_PI 0.318309886183791f

struct SinCos {
  float sine, cosine;
};

/// sin(2 pi u) and cos(2 pi u) for u in [-1, 2]. Absolute error below 2e-7. The argument is reduced
/// exactly in turns, so quarter turns are exact. Polynomials: minimax on [-pi/4, pi/4] after
/// Moshier's Cephes (sinf, cosf).
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

PHALANX_END
