// Scenes of nothing but lights of any kind, for tests.
#pragma once
#include <utility>
#include <vector>

#include "../../kernels/physics/light_rich.h"
#include "lights.h"
#include "random.h"
#include "scene/build_environment.h"
#include "scene/light_tree_build.h"
#include "scene/source_lights.h"

namespace phalanx::test {

inline Light point_light(Vec3 p, float intensity) {
  Light light = blank_light();
  light.kind = kPointLight;
  light.p = p;
  light.emission = {intensity, intensity, intensity};
  return light;
}
/// `normal`: unit, to the light. one_minus_cos 0: from one direction only.
inline Light directional_light(Vec3 normal, float one_minus_cos, float emission) {
  Light light = blank_light();
  light.kind = kDirectionalLight;
  light.normal = normal;
  light.one_minus_cos = one_minus_cos;
  light.emission = {emission, emission, emission};
  return light;
}
inline Light environment_light() {
  Light light = blank_light();
  light.kind = kEnvironmentLight;
  return light;
}
inline Light by_solid_angle(Light light) {
  light.by_solid_angle = 1;
  return light;
}

/// Any lights, those at infinity last, with equal chances; with `tree`, by a tree for equal powers.
inline Scene rich_scene(std::vector<Light> lights, EnvironmentMap map = {}, bool tree = false) {
  Scene scene;
  scene.lights = std::move(lights);
  if (!map.texels.empty()) set_environment_map(std::move(map), scene);
  for (Light &light : scene.lights) {
    if (light.kind < kPointLight)
      light.emission_texture = light.opacity_texture = light.profile = -1;
    if (light.kind >= kDirectionalLight) ++scene.num_infinite_lights;
  }
  const std::size_t num_finite =
      scene.lights.size() - static_cast<std::size_t>(scene.num_infinite_lights);
  if (tree) {
    scene.infinite_share = scene.num_infinite_lights > 0 ? 0.25f : 0.0f;
    scene.light_nodes = build_light_tree(scene.lights, std::vector<double>(num_finite, 1.0));
  }
  const std::size_t first = tree ? num_finite : 0;
  const AliasTable table = make_alias_table(std::vector<double>(scene.lights.size() - first, 1.0));
  scene.alias_threshold.assign(first, 1.0f);
  scene.alias_other.assign(first, 0);
  for (std::size_t i = 0; i < table.probability.size(); ++i) {
    scene.lights[first + i].select_pdf =
        static_cast<float>(table.probability[i]) * (tree ? scene.infinite_share : 1.0f);
    scene.alias_threshold.push_back(table.threshold[i]);
    scene.alias_other.push_back(table.other[i] + static_cast<std::int32_t>(first));
  }
  return scene;
}

/// Lights of every kind and every option, in a cube of half-width 2.
inline Scene any_lights(std::uint64_t seed, bool tree) {
  Random random(seed);
  std::vector<Light> lights;
  for (int i = 0; i < 40; ++i) {
    const Vec3 p = random.point(2), a = random.direction(), side = make_frame(a).s;
    const int kind = i % 6;
    Light light = kind == kSphereLight ? sphere_light(p, random.between(0.1f, 1))
                  : kind == kDiskLight ? disk_light(p, a, random.between(0.1f, 1))
                  : kind < kPointLight ? planar_light(static_cast<LightKind>(kind), p, a,
                                                      side * random.between(0.1f, 2))
                                       : point_light(p, random.between(1, 5));
    if (kind == kSpotLight) {
      light.kind = kSpotLight;
      light.normal = a;
      light.cos_outer = 0.2f;
      light.cos_inner = 0.7f;
    }
    light.by_solid_angle = kind <= kQuadLight && i % 4 < 3 ? 1 : 0;
    light.two_sided = random.below(2);
    lights.push_back(light);
  }
  lights.push_back(directional_light(random.direction(), 0, 2));
  lights.push_back(directional_light(random.direction(), 0.2f, 2));
  lights.push_back(environment_light());
  EnvironmentMap map;
  map.width = 9;
  map.height = 5;
  map.turns = 0.3;
  for (int i = 0; i < 3 * 9 * 5; ++i)
    map.texels.push_back(random.chance(0.3) ? 0.0f : random.unit() * random.unit());
  Scene scene = rich_scene(std::move(lights), std::move(map), tree);
  scene.tables.assign(3, 0.0f);
  for (int i = 0; i < 5 * 4; ++i) scene.tables.push_back(random.unit());
  const Frame f = make_frame(random.direction());
  scene.profiles = {{3, 5, 4, f.s, f.t, f.n}};
  for (Light &light : scene.lights)
    if (light.kind == kPointLight || light.kind == kSpotLight) light.profile = random.below(2) - 1;
  return scene;
}

}  // namespace phalanx::test
