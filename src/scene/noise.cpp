#include "noise.h"

namespace phalanx {
namespace {

/// A well mixed 32-bit number. Constants: C. Wellons' search, "Prospecting for Hash Functions" (2018).
std::uint32_t mix(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  x ^= x >> 16;
  return x;
}

/// Directions from the centre of a cube to its twelve edges, four of them twice: a choice by four
/// bits. A table and no branches: the processor could not guess them.
constexpr double kGradients[16][3] = {
    {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
    {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {-1, 1, 0}, {0, -1, 1}, {0, -1, -1}};

double gradient_dot(std::uint32_t hash, double x, double y, double z) {
  const double *const g = kGradients[hash & 15u];
  return g[0] * x + g[1] * y + g[2] * z;
}

double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }
double lerp(double t, double a, double b) { return a + t * (b - a); }

}  // namespace

double gradient_noise(Double3 p, std::uint32_t seed) {
  std::uint32_t cell[3];
  double f[3];
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(p[i] < 1e15 && p[i] > -1e15)) return 0;
    auto floor = static_cast<std::int64_t>(p[i]);
    if (static_cast<double>(floor) > p[i]) --floor;
    cell[i] = static_cast<std::uint32_t>(floor);
    f[i] = p[i] - static_cast<double>(floor);
  }
  const double u = fade(f[0]), v = fade(f[1]), w = fade(f[2]);
  const std::uint32_t base = mix(seed + 0x9e3779b9u);
  // One edge along x after the other: their values at both ends, blended.
  const auto along_x = [&](std::uint32_t y, std::uint32_t z, double fy, double fz) {
    const std::uint32_t hash = mix(mix(base + cell[2] + z) + cell[1] + y) + cell[0];
    return lerp(u, gradient_dot(mix(hash), f[0], fy, fz),
                gradient_dot(mix(hash + 1u), f[0] - 1.0, fy, fz));
  };
  return lerp(w, lerp(v, along_x(0, 0, f[1], f[2]), along_x(1, 0, f[1] - 1.0, f[2])),
              lerp(v, along_x(0, 1, f[1], f[2] - 1.0), along_x(1, 1, f[1] - 1.0, f[2] - 1.0)));
}

double fractal_noise(Double3 p, int octaves, std::uint32_t seed) {
  double sum = 0, height = 1, total = 0;
  for (int octave = 0; octave < octaves; ++octave) {
    const std::uint32_t octave_seed = mix(seed * 16u + static_cast<std::uint32_t>(octave));
    Double3 shifted = p;
    for (std::size_t i = 0; i < 3; ++i)
      shifted[i] += static_cast<double>(mix(octave_seed + static_cast<std::uint32_t>(i))) * 0x1p-24;
    sum += height * gradient_noise(shifted, octave_seed);
    total += height;
    height *= 0.5;
    for (double &coordinate : p) coordinate *= 2;
  }
  return total > 0 ? sum / total : 0;
}

}  // namespace phalanx
