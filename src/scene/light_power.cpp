#include "light_power.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../../kernels/physics/light_rich.h"
#include "build_lights.h"
#include "build_materials.h"

namespace phalanx {
namespace {

using std::size_t;

double luminance_of(Vec3 emission) {
  Material emitter = {};
  emitter.emission = emission;
  return emitted_luminance(emitter);
}

/// Mean luminance over the surface, from side * side points spread over it.
double mean_luminance(const SceneView &view, const Light &light, int side) {
  if (light.emission_texture < 0 && light.opacity_texture < 0) return luminance_of(light.emission);
  Light by_area = light;
  by_area.by_solid_angle = 0;
  double sum = 0;
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const Vec2 u = {(static_cast<float>(i) + 0.5f) / static_cast<float>(side),
                      (static_cast<float>(j) + 0.5f) / static_cast<float>(side)};
      // From a sphere's centre, points are drawn all over it.
      sum += luminance_of(surface_emission(view, light, sample_surface_light(by_area, light.p, u)));
    }
  return sum / (side * side);
}

/// Mean of a profile's table over the sphere.
double mean_intensity(const Scene &scene, const Light &light) {
  if (light.profile < 0) return 1;
  const LightProfile &profile = scene.profiles[static_cast<size_t>(light.profile)];
  double sum = 0, weights = 0;
  for (int v = 0; v < profile.num_vertical; ++v) {
    const float turns = 0.5f * static_cast<float>(v) / static_cast<float>(profile.num_vertical - 1);
    const auto weight = static_cast<double>(sincos_turns(turns).sine);
    const auto row = static_cast<size_t>(profile.first + v * profile.num_horizontal);
    for (int h = 0; h < profile.num_horizontal; ++h)
      sum += weight * static_cast<double>(scene.tables[row + static_cast<size_t>(h)]);
    weights += weight * profile.num_horizontal;
  }
  return sum / weights;
}

/// Squared radius of the sphere around the scene's box; 1 for an empty scene.
double squared_radius(const Scene &scene) {
  const Vec3 size = scene.bounds_hi - scene.bounds_lo;
  if (!(size.x >= 0)) return 1;
  const double x = static_cast<double>(size.x), y = static_cast<double>(size.y),
               z = static_cast<double>(size.z);
  const double sum = 0.25 * (x * x + y * y + z * z);
  return sum > 0 ? sum : 1;
}

double finite_power(const Scene &scene, const SceneView &view, const Light &light, int side) {
  if (light.kind == kPointLight)
    return 4 * luminance_of(light.emission) * mean_intensity(scene, light);
  if (light.kind == kSpotLight) {
    const double inner = static_cast<double>(light.cos_inner),
                 outer = static_cast<double>(light.cos_outer);
    return 2 * luminance_of(light.emission) * (1 - 0.5 * (inner + outer)) *
           mean_intensity(scene, light);
  }
  return mean_luminance(view, light, side) * static_cast<double>(light.area) *
         (light.two_sided != 0 ? 2.0 : 1.0);
}

}  // namespace

std::vector<double> light_powers(const Scene &scene, const std::vector<double> &infinite) {
  const SceneView view = scene.view();
  const size_t num_finite = scene.lights.size() - infinite.size();
  const int side = num_finite < 1000 ? 16 : num_finite < 100'000 ? 8 : 4;
  std::vector<double> powers;
  powers.reserve(scene.lights.size());
  for (size_t i = 0; i < num_finite; ++i)
    powers.push_back(finite_power(scene, view, scene.lights[i], side));
  for (const double power : infinite) powers.push_back(power * squared_radius(scene));
  const double mean = std::accumulate(powers.begin(), powers.end(), 0.0) /
                      static_cast<double>(std::max<size_t>(powers.size(), 1));
  for (double &power : powers) power = std::max(power, mean * kMinLightShare);
  return powers;
}

}  // namespace phalanx
