#include "scene.h"

#include "../../kernels/physics/opacity.h"

namespace phalanx {
namespace {

template <class T>
std::int64_t bytes_of(const std::vector<T> &values) {
  return static_cast<std::int64_t>(values.size() * sizeof(T));
}

template <class T>
std::int32_t count_of(const std::vector<T> &values) {
  return static_cast<std::int32_t>(values.size());
}

}  // namespace

std::int64_t Scene::num_vertices() const {
  if (positions.size() < kPositionPadding) return 0;
  return static_cast<std::int64_t>((positions.size() - kPositionPadding) / 3);
}

std::int64_t Scene::bytes() const {
  return bytes_of(materials) + bytes_of(geometries) + bytes_of(num_prims) + bytes_of(positions) +
         bytes_of(vertex_normals) + bytes_of(triangles) + bytes_of(quads) + bytes_of(spheres) +
         bytes_of(disks) + bytes_of(instances) + bytes_of(instance_group) + bytes_of(groups) +
         bytes_of(curve_points) + bytes_of(motions) + bytes_of(curve_along) + bytes_of(curve_segments) +
         bytes_of(vertex_uvs) + bytes_of(vertex_colours) + bytes_of(textures) +
         bytes_of(byte_texels) + bytes_of(float_texels) + bytes_of(decode) + bytes_of(lights) + bytes_of(profiles) + bytes_of(light_nodes) +
         bytes_of(environment_texels) + bytes_of(environment_rows) + bytes_of(environment_columns) + bytes_of(alias_threshold) + bytes_of(alias_other) + bytes_of(tables);
}

SceneView Scene::view() const {
  SceneView view = {};
  view.materials = materials.data();
  view.geometries = geometries.data();
  view.positions = positions.data();
  view.vertex_normals = vertex_normals.data();
  view.triangles = triangles.data();
  view.quads = quads.data();
  view.spheres = spheres.data();
  view.disks = disks.data();
  view.instances = instances.data();
  view.lights = lights.data();
  view.alias_threshold = alias_threshold.data();
  view.alias_other = alias_other.data();
  view.tables = tables.data();
  view.textures = textures.data();
  view.byte_texels = byte_texels.data();
  view.float_texels = float_texels.data();
  view.decode = decode.data();
  view.vertex_uvs = vertex_uvs.data();
  view.vertex_colours = vertex_colours.data();
  view.curve_points = curve_points.data();
  view.curve_along = curve_along.data();
  view.curve_segments = curve_segments.data();
  view.num_curve_segments = count_of(curve_segments);
  view.motions = motions.data();
  view.has_motion = motions.empty() ? 0 : 1;
  view.num_textures = count_of(textures);
  view.num_materials = count_of(materials);
  view.num_geometries = count_of(geometries);
  view.num_lights = count_of(lights);
  view.num_instances = count_of(instances);
  view.num_spheres = count_of(spheres);
  view.num_top_geometries = top_level.count;
  view.has_environment = has_environment ? 1 : 0;
  view.environment = environment;
  view.profiles = profiles.data();
  view.light_nodes = light_nodes.data();
  view.num_light_nodes = count_of(light_nodes);
  view.num_infinite_lights = num_infinite_lights;
  view.infinite_share = infinite_share;
  view.environment_texels = environment_texels.data();
  view.environment_rows = environment_rows.data();
  view.environment_columns = environment_columns.data();
  view.environment_width = environment_width;
  view.environment_height = environment_height;
  view.environment_x = environment_x;
  view.environment_y = environment_y;
  view.environment_z = environment_z;
  for (const Material &m : materials) {
    view.has_blends |= m.kind == kBlend ? 1 : 0;
    view.has_opacity |= has_holes(m) ? 1 : 0;
  }
  return view;
}

}  // namespace phalanx
