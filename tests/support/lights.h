// Lights and scenes of nothing but lights, for tests.
#pragma once
#include <cmath>
#include <vector>

#include "../../kernels/physics/light.h"
#include "scene/alias_table.h"
#include "statistics.h"

namespace phalanx::test {

inline Light planar_light(LightKind kind, Vec3 p, Vec3 a, Vec3 b) {
  Light light = {};
  const double ax = static_cast<double>(a.x), ay = static_cast<double>(a.y);
  const double az = static_cast<double>(a.z), bx = static_cast<double>(b.x);
  const double by = static_cast<double>(b.y), bz = static_cast<double>(b.z);
  const double x = ay * bz - az * by, y = az * bx - ax * bz, z = ax * by - ay * bx;
  const double size = std::hypot(x, y, z);
  const double share = kind == kTriangleLight ? 0.5 : kind == kDiskLight ? kPi : 1.0;
  light.kind = kind;
  light.p = p;
  light.a = a;
  light.b = b;
  light.normal = {static_cast<float>(x / size), static_cast<float>(y / size),
                  static_cast<float>(z / size)};
  light.area = static_cast<float>(share * size);
  light.emission = {1, 1, 1};
  light.select_pdf = 1;
  return light;
}
inline Light sphere_light(Vec3 center, float radius) {
  Light light = {};
  light.kind = kSphereLight;
  light.p = center;
  light.radius = radius;
  light.area = 4 * PHALANX_PI * radius * radius;
  light.emission = {1, 1, 1};
  light.select_pdf = 1;
  return light;
}
/// A disk around `center` facing along the unit vector `normal`.
inline Light disk_light(Vec3 center, Vec3 normal, float radius) {
  const Frame f = make_frame(normal);
  return planar_light(kDiskLight, center, f.s * radius, f.t * radius);
}

/// A view of lights, chosen with probabilities proportional to `weights` (all 1 if empty).
class LightScene {
 public:
  explicit LightScene(std::vector<Light> lights, std::vector<double> weights = {})
      : lights_(std::move(lights)) {
    if (weights.empty()) weights.assign(lights_.size(), 1.0);
    table_ = make_alias_table(weights);
    for (std::size_t i = 0; i < lights_.size(); ++i)
      lights_[i].select_pdf = static_cast<float>(table_.probability[i]);
    view.lights = lights_.data();
    view.num_lights = static_cast<int32>(lights_.size());
    view.alias_threshold = table_.threshold.data();
    view.alias_other = table_.other.data();
  }
  LightScene(const LightScene &) = delete;
  LightScene &operator=(const LightScene &) = delete;

  SceneView view = {};

 private:
  std::vector<Light> lights_;
  AliasTable table_;
};

}  // namespace phalanx::test
