#include "scene_text.h"

#include <fmt/format.h>

#include <cmath>

namespace phalanx::check {

std::string num(double value) { return fmt::format("{}", value); }
std::string vec(const Double3 &v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); }

std::string SceneText::text() const {
  std::string all = fmt::format(
      R"({{"version": 1, "camera": {{{}}}, "film": {{"width": {}, "height": {}, {}}}, "sampler": {{{}}}, "integrator": {{{}}})",
      camera, width, height, film, sampler, integrator);
  std::vector<std::string> all_materials = {
      R"({"name": "grey", "type": "diffuse", "reflectance": 0.5})",
      R"({"name": "white", "type": "diffuse", "reflectance": 1})", R"({"name": "black", "type": "black"})",
      R"({"name": "lamp", "type": "black", "emission": 1})"};
  all_materials.insert(all_materials.end(), materials.begin(), materials.end());
  const auto list = [&](const char *name, const std::vector<std::string> &items) {
    if (!items.empty()) all += fmt::format(", \"{}\": [{}]", name, fmt::join(items, ",\n"));
  };
  list("textures", textures);
  list("materials", all_materials);
  list("lights", lights);
  list("shapes", shapes);
  list("groups", groups);
  list("instances", instances);
  return all + "}";
}

std::string quad(const std::string &material, Double3 corner, Double3 u, Double3 v, const std::string &more) {
  return fmt::format(R"({{"type": "quad", "material": "{}", "corner": {}, "edge_u": {}, "edge_v": {}{}}})",
                     material, vec(corner), vec(u), vec(v), more);
}

std::string sphere(const std::string &material, Double3 center, double radius, const std::string &more) {
  return fmt::format(R"({{"type": "sphere", "material": "{}", "center": {}, "radius": {}{}}})", material,
                     vec(center), radius, more);
}

std::string disk(const std::string &material, Double3 center, Double3 normal, double radius) {
  return fmt::format(R"({{"type": "disk", "material": "{}", "center": {}, "normal": {}, "radius": {}}})",
                     material, vec(center), vec(normal), radius);
}

std::string mesh(const std::string &material, const std::string &arrays) {
  return fmt::format(R"({{"type": "mesh", "material": "{}", {}}})", material, arrays);
}

std::string level(const std::string &material, double half, double height, bool down) {
  const double z = down ? -half : half;
  return quad(material, {-half, height, z}, {2 * half, 0, 0}, {0, 0, -2 * z});
}

std::string material(const std::string &name, const std::string &type, const std::string &keys) {
  return fmt::format(R"({{"name": "{}", "type": "{}"{}{}}})", name, type, keys.empty() ? "" : ", ", keys);
}

std::string emitter(const std::string &name, double radiance, const std::string &keys) {
  return material(name, "black", R"("emission": )" + num(radiance) + (keys.empty() ? "" : ", " + keys));
}

std::string sun(Double3 direction, double irradiance, double angular_diameter) {
  if (angular_diameter == 0)
    return fmt::format(R"({{"type": "directional", "direction": {}, "irradiance": {}}})", vec(direction),
                       irradiance);
  const Double3 to_sun = {-direction[0], -direction[1], -direction[2]};
  return fmt::format(R"({{"type": "sun", "sun_direction": {}, "irradiance": {}, "angular_diameter": {}}})",
                     vec(to_sun), irradiance, angular_diameter);
}

std::string camera(Double3 from, Double3 to, double fov, Double3 up) {
  return fmt::format(R"("position": {}, "look_at": {}, "up": {}, "fov": {})", vec(from), vec(to), vec(up), fov);
}

double rectangle_irradiance(double x0, double x1, double z0, double z1, double h) {
  // A rectangle with one corner right above: pi times the configuration factor of a parallel element.
  const auto corner = [h](double a, double b) {
    const double x = a / h, z = b / h, rx = std::sqrt(1 + x * x), rz = std::sqrt(1 + z * z);
    return 0.5 * (x / rx * std::atan(z / rx) + z / rz * std::atan(x / rz));
  };
  return corner(x1, z1) - corner(x0, z1) - corner(x1, z0) + corner(x0, z0);
}

}  // namespace phalanx::check
