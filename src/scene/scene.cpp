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
         bytes_of(lights) + bytes_of(alias_threshold) + bytes_of(alias_other) + bytes_of(tables);
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
  view.num_materials = count_of(materials);
  view.num_geometries = count_of(geometries);
  view.num_lights = count_of(lights);
  view.num_instances = count_of(instances);
  view.num_spheres = count_of(spheres);
  view.num_top_geometries = top_level.count;
  view.has_environment = has_environment ? 1 : 0;
  view.environment = environment;
  for (const Material &m : materials) {
    view.has_blends |= m.kind == kBlend ? 1 : 0;
    view.has_opacity |= has_holes(m) ? 1 : 0;
  }
  return view;
}

}  // namespace phalanx
