#include "recentre.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "transform.h"

namespace phalanx {
namespace {

using std::size_t;

constexpr double kFarOff = 256;  // middle's distance from the origin over half the diagonal

struct Box {
  Double3 lo, hi;
  Box() {
    lo.fill(std::numeric_limits<double>::infinity());
    hi.fill(-std::numeric_limits<double>::infinity());
  }
  void add(const Double3 &p) {
    for (size_t i = 0; i < 3; ++i) {
      lo[i] = std::min(lo[i], p[i]);
      hi[i] = std::max(hi[i], p[i]);
    }
  }
  bool is_usable() const {
    for (size_t i = 0; i < 3; ++i)
      if (!(hi[i] >= lo[i]) || !std::isfinite(hi[i] - lo[i])) return false;
    return true;
  }
};

Double3 plus(const Double3 &a, const Double3 &b, double s = 1) {
  return {a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]};
}

/// Centres of spheres, points of everything else: enough to know where a shape is.
void add_points(const ShapeDescription &shape, const Transform &transform, Box &box) {
  const auto add = [&](const Double3 &p) { box.add(transform_point(transform, p)); };
  if (const auto *mesh = std::get_if<MeshShape>(&shape.shape)) {
    const std::vector<float> &p = mesh->data.positions;
    for (size_t i = 0; i + 2 < p.size(); i += 3) add({p[i], p[i + 1], p[i + 2]});
  } else if (const auto *quad = std::get_if<QuadShape>(&shape.shape)) {
    const Double3 far = plus(plus(quad->corner, quad->edge_u), quad->edge_v);
    for (const Double3 &p : {quad->corner, plus(quad->corner, quad->edge_u), plus(quad->corner, quad->edge_v), far})
      add(p);
  } else if (const auto *spheres = std::get_if<SpheresShape>(&shape.shape)) {
    for (const auto &[x, y, z, r] : spheres->spheres) {
      add({x - r, y - r, z - r});
      add({x + r, y + r, z + r});
    }
  } else if (const auto *disk = std::get_if<DiskShape>(&shape.shape)) {
    const Double3 r = {disk->radius, disk->radius, disk->radius};
    add(plus(disk->center, r, -1));
    add(plus(disk->center, r));
  } else if (const auto *curves = std::get_if<CurvesShape>(&shape.shape)) {
    for (const auto &[x, y, z, r] : curves->points) add({x, y, z});
  }
}

Box bounds_of(const SceneDescription &scene) {
  Box box;
  for (const ShapeDescription &shape : scene.shapes) add_points(shape, shape.transform, box);
  for (const InstanceDescription &instance : scene.instances) {
    if (instance.group < 0 || static_cast<size_t>(instance.group) >= scene.groups.size()) continue;
    for (const ShapeDescription &shape : scene.groups[static_cast<size_t>(instance.group)].shapes)
      add_points(shape, compose(instance.transform, shape.transform), box);
  }
  if (box.is_usable()) box.add(scene.camera.position);
  return box;
}

bool has_textures_in_space(const SceneDescription &scene) {
  return std::any_of(scene.textures.begin(), scene.textures.end(),
                     [](const TextureDescription &texture) { return texture.scale > 0; });
}

void move(Transform &transform, const Double3 &by) {
  for (size_t i = 0; i < 3; ++i) transform.m[i][3] += by[i];
}

}  // namespace

void recentre(SceneDescription &scene) {
  const Box box = bounds_of(scene);
  if (!box.is_usable() || has_textures_in_space(scene)) return;
  const Double3 middle = plus(box.lo, plus(box.hi, box.lo, -1), 0.5);
  const double half_diagonal = 0.5 * length(plus(box.hi, box.lo, -1));
  if (!(length(middle) > kFarOff * half_diagonal) || !(half_diagonal > 0)) return;

  const Double3 by = {-middle[0], -middle[1], -middle[2]};
  scene.origin = middle;
  scene.camera.position = plus(scene.camera.position, by);
  scene.camera.look_at = plus(scene.camera.look_at, by);
  for (ShapeDescription &shape : scene.shapes) move(shape.transform, by);
  for (InstanceDescription &instance : scene.instances) {
    move(instance.transform, by);
    if (instance.transform_end) move(*instance.transform_end, by);
  }
  for (LightDescription &light : scene.lights)
    if (light.kind != kDirectionalLight) light.position = plus(light.position, by);
}

}  // namespace phalanx
