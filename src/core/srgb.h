// The sRGB curve, IEC 61966-2-1.
#pragma once
#include <cmath>

namespace phalanx {

/// Both ends of [0, 1] stay where they are.
inline double srgb_from_linear(double x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

inline double linear_from_srgb(double x) {
  return x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
}

}  // namespace phalanx
