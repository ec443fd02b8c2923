// Coordinates of the hemisphere of normals in which GGX of any roughness looks alike.
//
// A normal (x, y, z) is stretched to (x / alpha_x, y / alpha_y, z) / length, which makes the distribution
// of normals that of a hemisphere (alpha = 1). Grids over (cosine, azimuth) of stretched normals resolve
// the sharpest lobes.
#pragma once
#include "../../kernels/physics/vec.h"
#include "statistics.h"

namespace phalanx::check {

struct NormalSpace {
  double alpha;            // along x
  double alpha_y = alpha;

  struct Place {
    double cosine, phi;  // of the stretched normal
  };
  Place place(Vec3 m) const {
    return place(static_cast<double>(m.x), static_cast<double>(m.y), static_cast<double>(m.z));
  }
  Place place(double x, double y, double z) const {
    return {z / std::hypot(x / alpha, y / alpha_y, z), azimuth(x / alpha, y / alpha_y)};
  }
  /// Of the half vector of two unit directions. Their rounded lengths are corrected first: at
  /// grazing angles they would tilt it.
  Place place_half(Vec3 a, Vec3 b) const {
    const double ax = static_cast<double>(a.x), ay = static_cast<double>(a.y);
    const double az = static_cast<double>(a.z), bx = static_cast<double>(b.x);
    const double by = static_cast<double>(b.y), bz = static_cast<double>(b.z);
    const double la = std::hypot(ax, ay, az), lb = std::hypot(bx, by, bz);
    return place(ax / la + bx / lb, ay / la + by / lb, az / la + bz / lb);
  }

  struct Normal {
    Vec3 direction;
    double z;
    double jacobian;  // solid angle of normals per solid angle of stretched ones
  };
  Normal normal(double cosine, double phi) const {
    const double sine = std::sqrt(1 - cosine * cosine);
    const double x = alpha * sine * std::cos(phi), y = alpha_y * sine * std::sin(phi);
    const double size = std::hypot(x, y, cosine);
    Normal n;
    n.z = cosine / size;
    n.direction = {static_cast<float>(x / size), static_cast<float>(y / size),
                   static_cast<float>(n.z)};
    n.jacobian = alpha * alpha_y / (size * size * size);
    return n;
  }
};

}  // namespace phalanx::check
