// "lights": what shines without being a surface. Surfaces shine by their material's emission.
#include <filesystem>

#include "read_scene.h"
#include "transform.h"
#include "turn.h"

namespace phalanx {

namespace {

constexpr Range kIntensity = {0, kMaxRadiance, "W sr^-1"};
constexpr Range kIrradiance = {0, kMaxRadiance, "W m^-2"};
constexpr Range kScale = {0, 1e9};
constexpr Range kTurn = {-1e6, 1e6, "degrees"};
constexpr Range kFromAxis = {0, 180, "degrees"};
constexpr Range kDiameter = {0.001, 180, "degrees"};
constexpr Range kElevation = {-90, 90, "degrees"};
constexpr Range kTurbidity = {1, 10};

/// Reads the keys of one type of light.
using LightReader = void(ObjectReader &object, SceneReader &reader, SceneDescription &scene);

struct LightType {
  const char *name;
  const char *article_and_name;
  LightReader *read;
};

void read_direction(ObjectReader &object, const char *key, Double3 &out, Presence presence) {
  if (object.vector(key, kDirection, out, presence) && out == Double3{0, 0, 0})
    object.error(std::string(key) + " is [0, 0, 0]");
}

/// The path of an existing file, from the folder of the scene.
std::string read_file_name(ObjectReader &object, SceneReader &reader,
                           const std::vector<std::string> &extensions, const std::string &what) {
  namespace fs = std::filesystem;
  std::string file;
  if (!object.text("file", file, kRequired)) return {};
  const Node node = *object.find("file");
  bool known = false;
  for (const std::string &extension : extensions) {
    known |= file.size() > extension.size() && file.ends_with(extension);
  }
  if (!known) {
    reader.source.expected(node, "the name of " + what);
    return {};
  }
  const std::string path = (fs::path(reader.base_dir) / file).string();
  std::error_code error;
  if (!fs::exists(path, error))
    reader.source.error(node, "there is no file '" + printable(path) + "'");
  else if (!fs::is_regular_file(path, error))
    reader.source.error(node, "'" + printable(path) + "' is no regular file");
  return path;
}

void check_first_environment(const ObjectReader &object, SceneReader &reader,
                             const SceneDescription &scene) {
  if (scene.has_environment || scene.environment_map || scene.sky)
    reader.source.error(object.node(), "a second environment light; a scene has one at most");
}

/// A constant one, or a map.
void read_environment(ObjectReader &object, SceneReader &reader, SceneDescription &scene) {
  check_first_environment(object, reader, scene);
  int num_map_keys = 0;  // asks for every key, which makes all of them known
  for (const char *key : {"file", "rotate", "scale"}) num_map_keys += object.has(key);
  if (object.has("radiance") && num_map_keys > 0)
    object.error("give either radiance, or a file with rotate and scale");
  if (!object.has("file")) {
    object.colour("radiance", kRadiance, scene.environment, kRequired);
    scene.has_environment = true;
    return;
  }
  EnvironmentMapDescription map;
  map.origin = reader.source.file() + ": " + object.node().path;
  map.file =
      read_file_name(object, reader, {".hdr", ".exr", ".HDR", ".EXR"}, "an .hdr or .exr file");
  object.number("rotate", kTurn, map.rotation);
  object.colour("scale", kScale, map.scale);
  scene.environment_map = map;
}

LightDescription make_light(const ObjectReader &object, const SceneReader &reader, LightKind kind) {
  LightDescription light;
  light.kind = kind;
  light.origin = reader.source.file() + ": " + object.node().path;
  return light;
}

void read_point(ObjectReader &object, SceneReader &reader, SceneDescription &scene) {
  LightDescription light = make_light(object, reader, kPointLight);
  object.vector("position", kCoordinate, light.position, kRequired);
  object.colour("intensity", kIntensity, light.emission, kRequired);
  scene.lights.push_back(light);
}

void read_spot(ObjectReader &object, SceneReader &reader, SceneDescription &scene) {
  LightDescription light = make_light(object, reader, kSpotLight);
  object.vector("position", kCoordinate, light.position, kRequired);
  read_direction(object, "direction", light.direction, kRequired);
  object.colour("intensity", kIntensity, light.emission, kRequired);
  object.number("inner_angle", kFromAxis, light.inner_angle);
  object.number("outer_angle", kFromAxis, light.outer_angle);
  if (object.ok() && light.inner_angle > light.outer_angle)
    object.error("inner_angle is larger than outer_angle");
  scene.lights.push_back(light);
}

void read_ies(ObjectReader &object, SceneReader &reader, SceneDescription &scene) {
  LightDescription light = make_light(object, reader, kPointLight);
  object.vector("position", kCoordinate, light.position, kRequired);
  read_direction(object, "direction", light.direction, kOptional);
  read_direction(object, "horizontal", light.horizontal, kOptional);
  light.profile = read_file_name(object, reader, {".ies", ".IES"}, "an .ies file");
  light.profile_intensity = !object.has("intensity");
  object.colour("intensity", kIntensity, light.emission);
  const Double3 across = cross(light.direction, light.horizontal);
  if (object.ok() && !(length(across) > 1e-6 * length(light.direction) * length(light.horizontal)))
    object.error("horizontal is parallel to direction");
  scene.lights.push_back(light);
}

void read_directional(ObjectReader &object, SceneReader &reader, SceneDescription &scene) {
  LightDescription light = make_light(object, reader, kDirectionalLight);
  read_direction(object, "direction", light.direction, kRequired);
  object.colour("irradiance", kIrradiance, light.emission, kRequired);
  scene.lights.push_back(light);
}

/// Unit vector to the sun, by its direction or by its angles: elevation over the horizon, and azimuth
/// clockwise seen from above, -z being north.
Double3 read_sun_direction(ObjectReader &object) {
  Double3 direction = {0, 0, 0};
  double elevation = 45, azimuth = 0;
  const bool has_angles = object.has("sun_elevation") || object.has("sun_azimuth");
  if (object.has("sun_direction") && has_angles)
    object.error("give either sun_direction, or sun_elevation and sun_azimuth");
  read_direction(object, "sun_direction", direction, kOptional);
  object.number("sun_elevation", kElevation, elevation);
  object.number("sun_azimuth", kTurn, azimuth);
  const double size = length(direction);
  if (size > 0) return {direction[0] / size, direction[1] / size, direction[2] / size};
  const SinCos up = sin_cos_of_turns(elevation / 360), around = sin_cos_of_turns(azimuth / 360);
  return {up.cos * around.sin, up.sin, -up.cos * around.cos};
}

void read_sun(ObjectReader &object, SceneReader &reader, SceneDescription &scene) {
  LightDescription light = make_light(object, reader, kDirectionalLight);
  const Double3 to_sun = read_sun_direction(object);
  light.direction = {-to_sun[0], -to_sun[1], -to_sun[2]};
  light.angular_diameter = SkyDescription().angular_diameter;
  object.number("angular_diameter", kDiameter, light.angular_diameter);
  object.colour("irradiance", kIrradiance, light.emission, kRequired);
  scene.lights.push_back(light);
}

void read_sky(ObjectReader &object, SceneReader &reader, SceneDescription &scene) {
  check_first_environment(object, reader, scene);
  SkyDescription sky;
  sky.sun_direction = read_sun_direction(object);
  object.number("turbidity", kTurbidity, sky.turbidity);
  object.colour("ground_albedo", kUnitInterval, sky.ground_albedo);
  object.number("angular_diameter", kDiameter, sky.angular_diameter);
  object.boolean("sun", sky.sun);
  object.number("scale", kScale, sky.scale);
  scene.sky = sky;
}

const std::vector<LightType> kLightTypes = {
    {"environment", "an environment light", read_environment},
    {"point", "a point light", read_point},
    {"spot", "a spot light", read_spot},
    {"ies", "an ies light", read_ies},
    {"directional", "a directional light", read_directional},
    {"sun", "a sun light", read_sun},
    {"sky", "a sky light", read_sky}};

}  // namespace

void read_lights(const std::vector<Node> &nodes, SceneReader &reader, SceneDescription &scene) {
  std::vector<Choice> names;
  for (const LightType &type : kLightTypes)
    names.push_back({type.name, static_cast<int>(names.size())});
  for (const Node &node : nodes) {
    ObjectReader object(node, reader.source);
    int index = 0;
    if (!object.choice("type", names, index, kRequired)) {
      object.give_up("a light");
      continue;
    }
    const LightType &type = kLightTypes[static_cast<std::size_t>(index)];
    type.read(object, reader, scene);
    object.finish(type.article_and_name);
  }
}

}  // namespace phalanx
