// Random numbers for checks and tests: a counter through SplitMix64, so that a seed fixes every test.
#pragma once
#include <cmath>
#include <cstdint>

#include "../../kernels/physics/vec.h"

namespace phalanx::check {

class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(mix(seed)) {}

  std::uint64_t bits() { return mix(state_ += 0x9e3779b97f4a7c15u); }
  /// In [0, 1 - 2^-24], multiples of 2^-24: what the physics is fed with.
  float unit() { return static_cast<float>(bits() >> 40) * 0x1p-24f; }
  /// In [0, 1), with 53 bits.
  double fine() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  float between(float lo, float hi) { return lo + (hi - lo) * unit(); }
  int below(int n) {
    return static_cast<int>((bits() >> 32) * static_cast<std::uint64_t>(n) >> 32);
  }
  bool chance(double probability) { return fine() < probability; }
  Vec2 square() {
    const float x = unit();
    return {x, unit()};
  }
  /// Uniform on the unit sphere, rounded from double.
  Vec3 direction() {
    const double z = 2 * fine() - 1, phi = 6.283185307179586 * fine(), r = std::sqrt(1 - z * z);
    return {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
            static_cast<float>(z)};
  }
  Vec3 point(float size) {
    const float x = between(-size, size), y = between(-size, size);
    return {x, y, between(-size, size)};
  }

 private:
  static std::uint64_t mix(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }
  std::uint64_t state_;
};

}  // namespace phalanx::check
