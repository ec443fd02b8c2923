#include "build_geometry.h"

#include <cmath>

#include "build_context.h"
#include "build_report.h"

namespace phalanx {

using std::size_t;

void GeometryBuilder::reserve(const SceneDescription &description) {
  size_t positions = kPositionPadding, normals = 0, uvs = 0, colours = 0, triangles = 0;
  const auto count = [&](const std::vector<ShapeDescription> &shapes) {
    for (const ShapeDescription &shape : shapes)
      if (const auto *mesh = std::get_if<MeshShape>(&shape.shape)) {
        positions += mesh->data.positions.size();
        normals += mesh->data.normals.size();
        uvs += mesh->data.uvs.size();
        colours += mesh->data.colours.size();
        triangles += mesh->data.indices.size() / 3;
      }
  };
  count(description.shapes);
  for (const GroupDescription &group : description.groups) count(group.shapes);
  scene_.positions.reserve(positions);
  scene_.vertex_normals.reserve(normals);
  scene_.vertex_uvs.reserve(uvs);
  scene_.vertex_colours.reserve(colours);
  scene_.triangles.reserve(triangles);
}

void GeometryBuilder::add(const ShapeDescription &shape, const Transform &transform,
                          const std::string &origin) {
  const Context context = {origin,
                           transform,
                           shape.material,
                           relative_determinant(transform) < 0,
                           scene_.positions.size() / 3,
                           scene_.vertex_normals.size() / 3,
                           scene_.vertex_uvs.size() / 2,
                           scene_.vertex_colours.size() / 3};
  if (shape.material < 0 || static_cast<size_t>(shape.material) >= scene_.materials.size())
    return error(context, "there is no material " + std::to_string(shape.material));
  if (!is_finite(transform)) return error(context, "the transform is not finite");
  const size_t before = scene_.geometries.size();
  add_shape(shape, context);
  if (scene_.geometries.size() == before + 1) leave_out_if_repeated(context);
}

void GeometryBuilder::leave_out_if_repeated(const Context &context) {
  const size_t g = scene_.geometries.size() - 1;
  const auto earlier = repeated_.find(scene_, g, context.origin);
  if (!earlier) return;
  const Geometry geometry = scene_.geometries[g];
  const auto first = static_cast<size_t>(geometry.first);
  scene_.num_dropped += scene_.num_prims[g];
  scene_.notes.push_back(context.origin + " is the same as " + *earlier + " and left out");
  if (geometry.shape == kMesh) scene_.triangles.resize(first);
  if (geometry.shape == kQuads) scene_.quads.resize(first);
  if (geometry.shape == kSpheres) scene_.spheres.resize(first);
  if (geometry.shape == kDisks) scene_.disks.resize(first);
  scene_.positions.resize(context.first_vertex * 3);
  scene_.vertex_normals.resize(context.first_normal * 3);
  scene_.vertex_uvs.resize(context.first_uv * 2);
  scene_.vertex_colours.resize(context.first_colour * 3);
  scene_.geometries.pop_back();
  scene_.num_prims.pop_back();
  bounds_.pop_back();
}

void GeometryBuilder::add_shape(const ShapeDescription &shape, const Context &context) {
  if (const auto *mesh = std::get_if<MeshShape>(&shape.shape)) add_mesh(*mesh, context);
  if (const auto *quad = std::get_if<QuadShape>(&shape.shape)) add_quad(*quad, context);
  if (const auto *spheres = std::get_if<SpheresShape>(&shape.shape)) add_spheres(*spheres, context);
  if (const auto *disk = std::get_if<DiskShape>(&shape.shape)) add_disk(*disk, context);
  if (const auto *curves = std::get_if<CurvesShape>(&shape.shape)) add_curves(*curves, context);
}

void GeometryBuilder::error(const Context &context, const std::string &message) const {
  diagnostics_.error(problem_at(context.origin, message));
}

void GeometryBuilder::drop(const Context &context, std::int64_t count, const std::string &what) {
  if (count == 0) return;
  scene_.num_dropped += count;
  scene_.notes.push_back(std::to_string(count) + " " + what + " left out of " + context.origin);
}

/// The primitives first..end-1 of their array become a record, unless there are none.
void GeometryBuilder::finish(const Context &context, ShapeKind kind, size_t first, size_t end,
                             const Bounds &bounds) {
  if (first == end) return;
  Geometry geometry = {};
  geometry.shape = kind;
  geometry.material = context.material;
  geometry.kind = scene_.materials[static_cast<size_t>(context.material)].kind;
  geometry.first = static_cast<std::int32_t>(first);
  geometry.first_light = -1;
  // An array that grew since the shape began holds data of its vertices.
  const auto find_offset = [&](size_t first, size_t end, std::int32_t &has, std::int32_t &offset) {
    if (end == first) return;
    has = 1;
    offset = static_cast<std::int32_t>(static_cast<std::int64_t>(first) -
                                       static_cast<std::int64_t>(context.first_vertex));
  };
  find_offset(context.first_normal, scene_.vertex_normals.size() / 3, geometry.has_normals,
              geometry.normal_offset);
  find_offset(context.first_uv, scene_.vertex_uvs.size() / 2, geometry.has_uvs,
              geometry.uv_offset);
  find_offset(context.first_colour, scene_.vertex_colours.size() / 3, geometry.has_colours,
              geometry.colour_offset);
  scene_.geometries.push_back(geometry);
  scene_.num_prims.push_back(static_cast<std::int32_t>(end - first));
  bounds_.push_back(bounds);
}

namespace {

bool has_texture(const Material &m) {
  return m.textured != 0 || m.emission_texture >= 0 || m.weight_texture >= 0 ||
         m.opacity_texture >= 0 || m.normal_texture >= 0 || m.bump_texture >= 0;
}

/// The two triangles of a quad, with its texture coordinates.
MeshShape triangles_of(const QuadShape &quad) {
  MeshShape mesh;
  for (const float v : {0.0f, 1.0f})
    for (const float u : {0.0f, 1.0f}) {
      for (size_t axis = 0; axis < 3; ++axis)
        mesh.data.positions.push_back(static_cast<float>(
            quad.corner[axis] + double{u} * quad.edge_u[axis] + double{v} * quad.edge_v[axis]));
      mesh.data.uvs.insert(mesh.data.uvs.end(), {u, v});
    }
  mesh.data.indices = {0, 1, 3, 0, 3, 2};
  return mesh;
}

}  // namespace

void GeometryBuilder::add_quad(const QuadShape &shape, const Context &context) {
  // A mirrored quad keeps the side that it faces by having its edges, and so u and v, exchanged.
  if (context.mirrors && has_texture(scene_.materials[static_cast<size_t>(context.material)]))
    return add_mesh(triangles_of(shape), context);
  Quad quad;
  quad.corner = to_vec3(transform_point(context.transform, shape.corner));
  quad.edge_u = to_vec3(transform_vector(context.transform, shape.edge_u));
  quad.edge_v = to_vec3(transform_vector(context.transform, shape.edge_v));
  if (context.mirrors) std::swap(quad.edge_u, quad.edge_v);
  const Double3 corner = to_double3(quad.corner), u = to_double3(quad.edge_u),
                v = to_double3(quad.edge_v);
  Bounds bounds;
  for (const double s : {0.0, 1.0})
    for (const double t : {0.0, 1.0}) {
      const Double3 p = {corner[0] + s * u[0] + t * v[0], corner[1] + s * u[1] + t * v[1],
                         corner[2] + s * u[2] + t * v[2]};
      if (!is_valid_point(p))
        return error(context, "a corner is at " + point_text(p) +
                                  ": coordinates must be finite and at most 1.8e18");
      bounds.add(to_vec3(p));
    }
  if (!has_area(length(cross(u, v)), std::fmax(length(u), length(v))))
    return drop(context, 1, "quad without area");
  scene_.quads.push_back(quad);
  finish(context, kQuads, scene_.quads.size() - 1, scene_.quads.size(), bounds);
}

void GeometryBuilder::add_spheres(const SpheresShape &shape, const Context &context) {
  const double scale = similarity_scale(context.transform);
  if (!(scale > 0))
    return error(
        context,
        "a sphere can be moved, turned, mirrored and scaled equally in all directions only;"
        " for an ellipsoid use the icosphere mesh");
  const size_t first = scene_.spheres.size();
  Bounds bounds;
  std::int64_t num_dropped = 0;
  for (size_t i = 0; i < shape.spheres.size(); ++i) {
    const auto &[x, y, z, r] = shape.spheres[i];
    const Double3 center = transform_point(context.transform, {x, y, z});
    const double radius = r * scale;
    if (!(radius > 0) ||
        !is_valid_point({std::fabs(center[0]) + radius, std::fabs(center[1]) + radius,
                         std::fabs(center[2]) + radius})) {
      scene_.spheres.resize(first);
      return error(context, "sphere " + std::to_string(i) + " at " + point_text(center) +
                                " has radius " + std::to_string(radius) +
                                ": radii must be above 0, coordinates finite and at most 1.8e18");
    }
    if (radius < kMinRadius) {
      ++num_dropped;
      continue;
    }
    const Sphere sphere = {to_vec3(center), static_cast<float>(radius)};
    const Vec3 reach = {sphere.radius, sphere.radius, sphere.radius};
    bounds.add(sphere.center - reach);
    bounds.add(sphere.center + reach);
    scene_.spheres.push_back(sphere);
  }
  drop(context, num_dropped, "spheres of radius below 1e-18");
  finish(context, kSpheres, first, scene_.spheres.size(), bounds);
}

void GeometryBuilder::add_disk(const DiskShape &shape, const Context &context) {
  const double scale = similarity_scale(context.transform);
  if (!(scale > 0))
    return error(context,
                 "a disk can be moved, turned, mirrored and scaled equally in all directions only");
  const Double3 center = transform_point(context.transform, shape.center);
  const Double3 normal = transform_vector(normal_transform(context.transform), shape.normal);
  const double radius = shape.radius * scale, size = length(normal);
  if (!(size > 0) || !std::isfinite(size)) return error(context, "the normal has no direction");
  if (!(radius > 0) ||
      !is_valid_point({std::fabs(center[0]) + radius, std::fabs(center[1]) + radius,
                       std::fabs(center[2]) + radius}))
    return error(context, "a disk at " + point_text(center) + " has radius " +
                              std::to_string(radius) +
                              ": radii must be above 0, coordinates finite and at most 1.8e18");
  if (radius < kMinRadius) return drop(context, 1, "disk of radius below 1e-18");
  const Double3 n = {normal[0] / size, normal[1] / size, normal[2] / size};
  // Start from the coordinate axis least along n.
  size_t least = 0;
  for (size_t i = 1; i < 3; ++i)
    if (std::fabs(n[i]) < std::fabs(n[least])) least = i;
  Double3 axis = {0, 0, 0};
  axis[least] = 1;
  const Double3 across = cross(axis, n);
  const double f = radius / length(across);
  const Double3 u = {across[0] * f, across[1] * f, across[2] * f};
  const Disk disk = {to_vec3(center), to_vec3(u), to_vec3(cross(n, u))};
  Bounds bounds;
  for (const float s : {-1.0f, 1.0f})
    for (const float t : {-1.0f, 1.0f}) bounds.add(disk.center + disk.axis_u * s + disk.axis_v * t);
  scene_.disks.push_back(disk);
  finish(context, kDisks, scene_.disks.size() - 1, scene_.disks.size(), bounds);
}

}  // namespace phalanx
