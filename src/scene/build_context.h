// What the parts of the geometry builder know about the shape they are adding.
// Used by build_geometry.cpp and build_mesh.cpp only.
#pragma once
#include "build_geometry.h"
#include "transform.h"

namespace phalanx {

struct GeometryBuilder::Context {
  const std::string &origin;
  const Transform &transform;
  std::int32_t material;
  bool mirrors;              // the transform exchanges left and right
  std::size_t first_vertex;  // vertices and normals in the scene before this shape
  std::size_t first_normal;
  std::size_t first_uv, first_colour;
};

inline Vec3 to_vec3(const Double3 &v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}
inline Double3 to_double3(Vec3 v) { return {v.x, v.y, v.z}; }

/// Has a parallelogram or triangle with these edges area? STABILITY: G1.
/// area^2 <= (1e-12 * longest edge^2)^2 is none; below kMinArea too.
inline bool has_area(double area, double longest_edge) {
  return area > 1e-12 * longest_edge * longest_edge && area >= kMinArea;
}

}  // namespace phalanx
