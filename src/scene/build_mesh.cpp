// The mesh part of the geometry builder.
#include <cmath>

#include "build_context.h"
#include "build_report.h"

namespace phalanx {
namespace {

using std::size_t;

/// Vertices, and triangles, of a whole scene: kernels address arrays with 32-bit byte offsets.
constexpr std::int64_t kMaxElements = INT32_MAX / 12;

Double3 vertex_at(const std::vector<float> &positions, size_t vertex) {
  return {positions[vertex * 3], positions[vertex * 3 + 1], positions[vertex * 3 + 2]};
}

Double3 minus(const Double3 &a, const Double3 &b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Normal of the triangle times twice its area.
Double3 area_normal(const std::vector<float> &positions, const Triangle &t) {
  const Double3 a = vertex_at(positions, static_cast<size_t>(t.v0));
  return cross(minus(vertex_at(positions, static_cast<size_t>(t.v1)), a),
               minus(vertex_at(positions, static_cast<size_t>(t.v2)), a));
}

bool has_area(const Double3 &a, const Double3 &b, const Double3 &c) {
  const Double3 ab = minus(b, a), ac = minus(c, a), bc = minus(c, b);
  const Double3 n = cross(ab, ac);
  const double longest2 = std::fmax(dot(ab, ab), std::fmax(dot(ac, ac), dot(bc, bc)));
  const double area2 = 0.25 * dot(n, n);
  return area2 > 1e-24 * longest2 * longest2 && area2 >= kMinArea * kMinArea;
}

void set_normal(std::vector<float> &normals, size_t at, const Double3 &n, double size) {
  for (size_t axis = 0; axis < 3; ++axis)
    normals[at * 3 + axis] = static_cast<float>(n[axis] / size);
}

/// Gives the vertices in `missing` the area-weighted normal of their triangles; where these cancel,
/// the normal of one of them; where there is none, +z.
void replace_normals(Scene &scene, const std::vector<std::uint8_t> &missing, size_t first_vertex,
                     size_t first_normal, size_t first_triangle) {
  std::vector<Double3> sums(missing.size(), Double3{0, 0, 0});
  const auto for_each_missing_corner = [&](const auto &visit) {
    for (size_t i = first_triangle; i < scene.triangles.size(); ++i) {
      const Triangle &t = scene.triangles[i];
      for (const std::int32_t v : {t.v0, t.v1, t.v2})
        if (missing[static_cast<size_t>(v) - first_vertex] != 0)
          visit(sums[static_cast<size_t>(v) - first_vertex], area_normal(scene.positions, t));
    }
  };
  for_each_missing_corner([](Double3 &sum, const Double3 &n) {
    for (size_t axis = 0; axis < 3; ++axis) sum[axis] += n[axis];
  });
  for_each_missing_corner([](Double3 &sum, const Double3 &n) {
    if (!(length(sum) > 0)) sum = n;
  });
  for (size_t i = 0; i < missing.size(); ++i) {
    if (missing[i] == 0) continue;
    const double size = length(sums[i]);
    set_normal(scene.vertex_normals, first_normal + i, size > 0 ? sums[i] : Double3{0, 0, 1},
               size > 0 ? size : 1.0);
  }
}

}  // namespace

void GeometryBuilder::add_mesh(const MeshShape &shape, const Context &context) {
  const MeshData &data = shape.data;
  if (!check_mesh(data, context) || !bake_positions(data, context)) return;
  const size_t first = scene_.triangles.size();
  const Bounds bounds = bake_triangles(data, context);
  if (scene_.triangles.size() == first) {
    scene_.positions.resize(context.first_vertex * 3);
    return;
  }
  if (!data.normals.empty()) bake_normals(data, context);
  add_vertex_data(data);
  finish(context, kMesh, first, scene_.triangles.size(), bounds);
}

bool GeometryBuilder::check_mesh(const MeshData &data, const Context &context) const {
  const size_t num_vertices = data.positions.size() / 3;
  std::string problem;
  if (data.positions.size() % 3 != 0) problem = "positions are not three numbers a vertex";
  if (data.indices.size() % 3 != 0) problem = "indices are not three a triangle";
  if (!data.normals.empty() && data.normals.size() != data.positions.size())
    problem = "the mesh has " + std::to_string(num_vertices) + " vertices but " +
              std::to_string(data.normals.size() / 3) + " normals";
  if ((!data.uvs.empty() && data.uvs.size() != num_vertices * 2) ||
      (!data.colours.empty() && data.colours.size() != num_vertices * 3))
    problem = "the mesh has " + std::to_string(num_vertices) + " vertices but " +
              std::to_string(data.uvs.size() / 2) + " uvs and " +
              std::to_string(data.colours.size() / 3) + " colours";
  if (static_cast<std::int64_t>(context.first_vertex + num_vertices) > kMaxElements ||
      static_cast<std::int64_t>(scene_.triangles.size() + data.indices.size() / 3) > kMaxElements)
    problem = "with this mesh the scene has more than " + std::to_string(kMaxElements) +
              " vertices or triangles";
  const auto check_finite = [&](const std::vector<float> &values, size_t per_vertex, const char *what) {
    for (size_t i = 0; i < values.size() && problem.empty(); ++i)
      if (!std::isfinite(values[i]))
        problem = std::string(what) + " of vertex " + std::to_string(i / per_vertex) + " are not finite";
  };
  check_finite(data.uvs, 2, "the texture coordinates");
  check_finite(data.colours, 3, "the colours");
  for (size_t i = 0; i < data.indices.size() && problem.empty(); ++i)
    if (data.indices[i] < 0 || static_cast<size_t>(data.indices[i]) >= num_vertices)
      problem = "triangle " + std::to_string(i / 3) + " refers to vertex " +
                std::to_string(data.indices[i]) + ", but there are " + std::to_string(num_vertices);
  if (!problem.empty()) error(context, problem);
  return problem.empty();
}

bool GeometryBuilder::bake_positions(const MeshData &data, const Context &context) {
  auto &positions = scene_.positions;
  positions.insert(positions.end(), data.positions.begin(), data.positions.end());
  const bool unchanged = is_identity(context.transform);
  for (size_t i = context.first_vertex * 3; i < positions.size(); i += 3) {
    Double3 p = vertex_at(positions, i / 3);
    if (!unchanged) p = transform_point(context.transform, p);
    if (!is_valid_point(p)) {
      error(context, "vertex " + std::to_string(i / 3 - context.first_vertex) + " is at " +
                         point_text(p) + ": coordinates must be finite and at most 1.8e18");
      positions.resize(context.first_vertex * 3);
      return false;
    }
    if (unchanged) continue;
    for (size_t axis = 0; axis < 3; ++axis) positions[i + axis] = static_cast<float>(p[axis]);
  }
  return true;
}

void GeometryBuilder::add_vertex_data(const MeshData &data) {
  scene_.vertex_uvs.insert(scene_.vertex_uvs.end(), data.uvs.begin(), data.uvs.end());
  scene_.vertex_colours.insert(scene_.vertex_colours.end(), data.colours.begin(),
                               data.colours.end());
}

/// Returns the bounds of the triangles that were kept.
Bounds GeometryBuilder::bake_triangles(const MeshData &data, const Context &context) {
  Bounds bounds;
  std::int64_t num_dropped = 0;
  const auto first = static_cast<std::int32_t>(context.first_vertex);
  for (size_t i = 0; i < data.indices.size(); i += 3) {
    Triangle t = {first + data.indices[i], first + data.indices[i + 1],
                  first + data.indices[i + 2]};
    if (context.mirrors) std::swap(t.v1, t.v2);
    const Double3 a = vertex_at(scene_.positions, static_cast<size_t>(t.v0));
    const Double3 b = vertex_at(scene_.positions, static_cast<size_t>(t.v1));
    const Double3 c = vertex_at(scene_.positions, static_cast<size_t>(t.v2));
    if (!has_area(a, b, c)) {
      ++num_dropped;
      continue;
    }
    scene_.triangles.push_back(t);
    bounds.add(to_vec3(a));
    bounds.add(to_vec3(b));
    bounds.add(to_vec3(c));
  }
  drop(context, num_dropped, "zero-area triangles");
  return bounds;
}

void GeometryBuilder::bake_normals(const MeshData &data, const Context &context) {
  auto &normals = scene_.vertex_normals;
  const size_t num_vertices = data.positions.size() / 3;
  const Transform transform = normal_transform(context.transform);
  normals.resize((context.first_normal + num_vertices) * 3);
  std::vector<std::uint8_t> missing(num_vertices, 0);
  std::int64_t num_missing = 0;
  for (size_t i = 0; i < num_vertices; ++i) {
    const Double3 n = transform_vector(transform, vertex_at(data.normals, i));
    const double size = length(n);
    if (size > 0 && std::isfinite(size)) {
      set_normal(normals, context.first_normal + i, n, size);
    } else {
      missing[i] = 1;
      ++num_missing;
    }
  }
  if (num_missing == 0) return;
  size_t first_triangle = scene_.triangles.size();
  while (first_triangle > 0 &&
         scene_.triangles[first_triangle - 1].v0 >= static_cast<std::int32_t>(context.first_vertex))
    --first_triangle;
  replace_normals(scene_, missing, context.first_vertex, context.first_normal, first_triangle);
  scene_.notes.push_back(std::to_string(num_missing) + " normals without direction replaced in " +
                         context.origin);
}

}  // namespace phalanx
