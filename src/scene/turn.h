// Sine and cosine in double from + - * / alone: the same bits on every machine, unlike those of
// the mathematics library.
#pragma once

namespace phalanx {

struct SinCos {
  double sin, cos;
};

/// Sine and cosine of an angle in turns (1 is a full circle). |turns| below 2^31; error below
/// 1e-15. Exact at multiples of a quarter.
inline SinCos sin_cos_of_turns(double turns) {
  // To a quarter and the rest in [-1/8, 1/8] turns: exact, the multiple of 1/4 has few digits.
  const double quarters = turns * 4.0;
  auto quarter = static_cast<long long>(quarters + (quarters < 0 ? -0.5 : 0.5));
  const double angle = (quarters - static_cast<double>(quarter)) * 1.57079632679489661923;
  const double square = angle * angle;
  // Taylor: on |angle| <= pi/4 the next terms are below 1e-17.
  double sine = 1, cosine = 1;
  for (int n = 18; n >= 2; n -= 2) {
    cosine = 1.0 - square / (n * (n - 1)) * cosine;
    sine = 1.0 - square / (n * (n + 1)) * sine;
  }
  sine *= angle;
  switch (quarter & 3) {
    case 0:
      return {sine, cosine};
    case 1:
      return {cosine, -sine};
    case 2:
      return {-sine, -cosine};
    default:
      return {-cosine, sine};
  }
}

}  // namespace phalanx
