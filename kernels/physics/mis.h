// Weighting two ways to sample the same light.
#pragma once
#include "lang.h"

PHALANX_BEGIN

/// Power heuristic with exponent 2: a^2 / (a^2 + b^2), a > 0, b >= 0, without overflow (Veach 1997,
/// section 9.2.4; STABILITY L12).
PHYS float power_heuristic(float a, float b) {
  const bool swap = b > a;
  const float r = swap ? a / b : b / a;
  const float w = 1.0f / (1.0f + r * r);
  return swap ? r * r * w : w;
}

PHALANX_END
