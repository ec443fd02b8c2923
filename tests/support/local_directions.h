// Nine viewing directions in the local frame, from the normal to grazing, at various azimuths.
#pragma once
#include <array>
#include <cmath>

#include "../../kernels/physics/vec.h"

namespace phalanx::test {

inline std::array<Vec3, 9> local_directions() {
  constexpr double kCosines[] = {1, 0.99, 0.9, 0.7, 0.5, 0.3, 0.1, 0.02, 1e-3};
  std::array<Vec3, 9> directions;
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double z = kCosines[i], r = std::sqrt(1 - z * z), phi = 0.7 * static_cast<double>(i);
    directions[i] = {static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                     static_cast<float>(z)};
  }
  return directions;
}

}  // namespace phalanx::test
