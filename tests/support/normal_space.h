// Coordinates of the hemisphere of normals in which GGX of any roughness looks alike.
//
// With slope t = tan(theta) / alpha, c = t^2 / (1 + t^2) is uniform in [0,1) for the normals of GGX
// itself, seen along the surface's normal. So grids over (c, phi) resolve sharp lobes, too.
#pragma once
#include "../../kernels/physics/vec.h"
#include "statistics.h"

namespace phalanx::test {

struct NormalSpace {
  double alpha;

  struct Place {
    double c, phi;
  };
  Place place(Vec3 m) const {
    const double x = static_cast<double>(m.x), y = static_cast<double>(m.y);
    const double z = static_cast<double>(m.z) * alpha;
    const double sin2 = x * x + y * y;
    return {sin2 / (sin2 + z * z), azimuth(x, y)};
  }

  struct Normal {
    Vec3 direction;
    double x, y, z;     // the same in double
    double jacobian;    // solid angle per dc dphi
  };
  Normal normal(double c, double phi) const {
    const double r2 = c / (1 - c), tangent = alpha * std::sqrt(r2);
    const double z = 1 / std::sqrt(1 + tangent * tangent), s = tangent * z;
    Normal n;
    n.x = s * std::cos(phi);
    n.y = s * std::sin(phi);
    n.z = z;
    n.direction = {static_cast<float>(n.x), static_cast<float>(n.y), static_cast<float>(n.z)};
    // d omega = cos^3 dslope, dslope = alpha^2 / 2 d(r^2) dphi, d(r^2) = dc / (1 - c)^2.
    n.jacobian = z * z * z * alpha * alpha * 0.5 / ((1 - c) * (1 - c));
    return n;
  }
};

}  // namespace phalanx::test
