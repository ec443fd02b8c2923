// Shapes to geometry records: bakes transforms, drops what cannot be hit.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "../core/error.h"
#include "description.h"
#include "repeated_shapes.h"
#include "scene.h"

namespace phalanx {

/// Axis-parallel box; empty while lo > hi.
struct Bounds {
  Vec3 lo = {PHALANX_FAR, PHALANX_FAR, PHALANX_FAR};
  Vec3 hi = {-PHALANX_FAR, -PHALANX_FAR, -PHALANX_FAR};

  void add(Vec3 p) {
    lo = {min_of(lo.x, p.x), min_of(lo.y, p.y), min_of(lo.z, p.z)};
    hi = max3(hi, p);
  }
  void add(const Bounds &other) {
    if (other.is_empty()) return;
    add(other.lo);
    add(other.hi);
  }
  bool is_empty() const { return lo.x > hi.x; }
};

/// Primitives of less area count as having none: products of their edges would be denormal. m^2.
constexpr double kMinArea = 1e-36;
/// Spheres and disks of less radius likewise. Metres.
constexpr double kMinRadius = 1e-18;

/// Appends geometry records to a scene, one a shape.
class GeometryBuilder {
 public:
  GeometryBuilder(Scene &scene, Diagnostics &diagnostics)
      : scene_(scene), diagnostics_(diagnostics) {}

  /// Room for all meshes at once, so that no array is copied while it grows.
  void reserve(const SceneDescription &description);

  /// Adds the shape, transformed by `transform` (which includes the shape's own) in double
  /// precision. Mirrors keep the outside outside. Primitives without area are left out, counted and
  /// noted; if none is left there is no record. Errors name `origin`.
  /// So are opaque shapes that are the same as an earlier one of their space.
  void add(const ShapeDescription &shape, const Transform &transform, const std::string &origin);

  /// What follows is a group of its own.
  void start_group() { repeated_.start_space(); }

  /// Per geometry record, in the space of the record.
  const std::vector<Bounds> &bounds() const { return bounds_; }

 private:
  struct Context;
  void add_mesh(const MeshShape &shape, const Context &context);
  void add_quad(const QuadShape &shape, const Context &context);
  void add_spheres(const SpheresShape &shape, const Context &context);
  void add_disk(const DiskShape &shape, const Context &context);
  void add_curves(const CurvesShape &shape, const Context &context);

  bool check_mesh(const MeshData &data, const Context &context) const;
  bool bake_positions(const MeshData &data, const Context &context);
  Bounds bake_triangles(const MeshData &data, const Context &context);
  void bake_normals(const MeshData &data, const Context &context);
  void add_vertex_data(const MeshData &data);

  void add_shape(const ShapeDescription &shape, const Context &context);
  void leave_out_if_repeated(const Context &context);
  void error(const Context &context, const std::string &message) const;
  void drop(const Context &context, std::int64_t count, const std::string &what);
  void finish(const Context &context, ShapeKind kind, std::size_t first, std::size_t end,
              const Bounds &bounds);

  Scene &scene_;
  Diagnostics &diagnostics_;
  std::vector<Bounds> bounds_;
  RepeatedShapes repeated_;
};

}  // namespace phalanx
