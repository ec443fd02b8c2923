#include "source_lights.h"

#include <cmath>
#include <map>

#include "../../kernels/physics/mathx.h"
#include "../output/files.h"
#include "build_environment.h"
#include "build_report.h"
#include "ies.h"
#include "transform.h"

namespace phalanx {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLuminousEfficacy = 683;  // lm W^-1 of light at 555 nm

Vec3 to_vec3(const Double3 &v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

double luminance_of(const Double3 &c) { return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2]; }

Double3 unit(const Double3 &v) {
  const double size = length(v);
  return {v[0] / size, v[1] / size, v[2] / size};
}

double sine_of(double degrees) {
  return static_cast<double>(sincos_turns(static_cast<float>(degrees / 360)).sine);
}

float cosine_of(double degrees) { return sincos_turns(static_cast<float>(degrees / 360)).cosine; }

/// Tables of the IES files that lights have asked for so far: many luminaires share one.
class ProfileTables {
 public:
  ProfileTables(Scene &scene, Diagnostics &diagnostics)
      : scene_(scene), diagnostics_(diagnostics) {}

  struct Table {
    LightProfile profile;  // without a frame
    double peak = 0;       // candela; 0 after an error
  };
  const Table &find(const LightDescription &light) {
    const auto [place, is_new] = tables_.try_emplace(light.profile);
    if (is_new) read(light, place->second);
    return place->second;
  }

 private:
  void read(const LightDescription &light, Table &table);

  Scene &scene_;
  Diagnostics &diagnostics_;
  std::map<std::string, Table> tables_;
};

void ProfileTables::read(const LightDescription &light, Table &result) {
  try {
    const IesProfile profile = parse_ies(read_file(light.profile), light.profile);
    if (profile.is_tilted)
      diagnostics_.warn(problem_at(
          light.origin, "'" + light.profile + "' asks for a tilt of its lamp, which is ignored"));
    const IesTable table = make_ies_table(profile);
    if (!(table.peak > 0))
      throw InputError("'" + light.profile + "': all of its light is within half a degree");
    result.profile.first = static_cast<std::int32_t>(scene_.tables.size());
    result.profile.num_vertical = table.num_vertical;
    result.profile.num_horizontal = table.num_horizontal;
    result.peak = table.peak;
    scene_.tables.insert(scene_.tables.end(), table.values.begin(), table.values.end());
  } catch (const InputError &error) {
    for (const Problem &problem : error.problems())
      diagnostics_.error(problem_at(light.origin, problem.text()));
  }
}

void set_profile(const LightDescription &from, const ProfileTables::Table &table, Light &light,
                 Scene &scene) {
  const Double3 n = unit(from.direction), s = unit(cross(n, cross(from.horizontal, n)));
  LightProfile profile = table.profile;
  profile.n = to_vec3(n);
  profile.s = to_vec3(s);
  profile.t = to_vec3(cross(s, n));  // seen from above, horizontal angles go counter-clockwise
  light.profile = static_cast<std::int32_t>(scene.profiles.size());
  scene.profiles.push_back(profile);
  if (!from.profile_intensity) return;
  const auto intensity = static_cast<float>(table.peak / kLuminousEfficacy);
  light.emission = {intensity, intensity, intensity};
}

/// Adds a light at infinity whose rays make the irradiance `from.emission` on a surface across them.
void add_directional(const LightDescription &from, Scene &scene, std::vector<double> &power) {
  Light light = blank_light();
  light.kind = kDirectionalLight;
  const Double3 d = unit(from.direction);
  light.normal = to_vec3({-d[0], -d[1], -d[2]});
  Double3 emission = from.emission;
  if (from.angular_diameter > 0) {
    const double quarter = sine_of(from.angular_diameter / 4),
                 half = sine_of(from.angular_diameter / 2);
    light.one_minus_cos = static_cast<float>(2 * quarter * quarter);
    for (double &e : emission) e /= kPi * half * half;
    scene.has_environment = true;
  }
  light.emission = to_vec3(emission);
  scene.lights.push_back(light);
  power.push_back(luminance_of(from.emission));
}

void add_environment(EnvironmentMap map, Scene &scene, std::vector<double> &power) {
  if (map.texels.empty()) return;
  const double total = set_environment_map(std::move(map), scene);
  if (!(total > 0)) {
    scene.notes.push_back("the environment map is black: left out");
    return;
  }
  Light light = blank_light();
  light.kind = kEnvironmentLight;
  scene.lights.push_back(light);
  scene.has_environment = true;
  power.push_back(total);
}

void add_sky(const SkyDescription &from, Scene &scene, std::vector<double> &power) {
  Sky sky = make_sky(from);
  const Double3 &s = from.sun_direction;
  sky.map.turns =
      static_cast<double>(atan2_turns(static_cast<float>(-s[0]), static_cast<float>(-s[2])));
  if (from.sun && luminance_of(sky.sun) > 0) {
    LightDescription sun;
    sun.direction = {-s[0], -s[1], -s[2]};
    sun.angular_diameter = from.angular_diameter;
    const double half = sine_of(from.angular_diameter / 2);
    for (std::size_t c = 0; c < 3; ++c) sun.emission[c] = sky.sun[c] * kPi * half * half;
    add_directional(sun, scene, power);
  }
  add_environment(std::move(sky.map), scene, power);
}

}  // namespace

Light blank_light() {
  Light light = {};
  light.area = 1;
  light.emission = {1, 1, 1};
  light.emission_texture = light.opacity_texture = light.profile = -1;
  return light;
}

void add_point_lights(const SceneDescription &description, Scene &scene, Diagnostics &diagnostics) {
  ProfileTables tables(scene, diagnostics);
  for (const LightDescription &from : description.lights) {
    if (from.kind == kDirectionalLight) continue;
    Light light = blank_light();
    light.kind = from.kind;
    light.p = to_vec3(from.position);
    light.normal = to_vec3(unit(from.direction));
    light.emission = to_vec3(from.emission);
    light.cos_inner = cosine_of(from.inner_angle);
    light.cos_outer = cosine_of(from.outer_angle);
    if (!from.profile.empty()) {
      const ProfileTables::Table &table = tables.find(from);
      if (!(table.peak > 0)) continue;
      set_profile(from, table, light, scene);
    }
    if (luminance(light.emission) > 0.0f) scene.lights.push_back(light);
  }
}

std::vector<double> add_infinite_lights(const SceneDescription &description, Scene &scene,
                                        Diagnostics &diagnostics) {
  std::vector<double> power;
  for (const LightDescription &from : description.lights)
    if (from.kind == kDirectionalLight && luminance_of(from.emission) > 0)
      add_directional(from, scene, power);
  if (description.sky) add_sky(*description.sky, scene, power);
  if (description.environment_map)
    add_environment(read_environment_map(*description.environment_map, diagnostics), scene, power);
  scene.num_infinite_lights = static_cast<std::int32_t>(power.size());
  return power;
}

}  // namespace phalanx
