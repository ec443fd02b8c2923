// Scenes of the suite as text, put together from shapes and materials.
#pragma once
#include <string>
#include <vector>

#include "../scene/description.h"

namespace phalanx::check {

/// The shortest text that reads as the same number.
std::string num(double value);
std::string vec(const Double3 &v);

/// A scene file in parts. Every scene has the materials grey (diffuse, 0.5), white (1), black and lamp
/// (radiance 1). The camera looks at the origin from (0, 0.5, 0) through a very narrow angle.
struct SceneText {
  std::string camera = R"("position": [0, 0.5, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "fov": 0.001)";
  int width = 8, height = 8;
  std::string film = R"("filter": {"type": "box"})";
  std::string sampler = R"("type": "independent", "seed": 1)";
  std::string integrator = R"("max_depth": 64, "roulette_depth": 64)";
  std::vector<std::string> textures, materials, lights, shapes, groups, instances;

  std::string text() const;
};

// Shapes. `more`: further keys, starting with a comma.
std::string quad(const std::string &material, Double3 corner, Double3 u, Double3 v, const std::string &more = "");
std::string sphere(const std::string &material, Double3 center, double radius, const std::string &more = "");
std::string disk(const std::string &material, Double3 center, Double3 normal, double radius);
/// `arrays`: positions, indices and what else a mesh has.
std::string mesh(const std::string &material, const std::string &arrays);
/// Square of 2 * half metres across y = height, facing up, or down.
std::string level(const std::string &material, double half, double height, bool down = false);

// Materials and lights. `keys` after the name.
std::string material(const std::string &name, const std::string &type, const std::string &keys = "");
std::string emitter(const std::string &name, double radiance, const std::string &keys = "");
inline const char kSky[] = R"({"type": "environment", "radiance": 1})";
std::string sun(Double3 direction, double irradiance, double angular_diameter = 0);

/// A camera at `from` that looks at `to` through `fov` degrees.
std::string camera(Double3 from, Double3 to, double fov, Double3 up = {0, 0, 1});

/// Irradiance, for radiance 1, of a rectangle with corners at x0..x1, z0..z1 on the plane y = h, on a point at the
/// origin that faces up (Lambert's formula).
double rectangle_irradiance(double x0, double x1, double z0, double z1, double h);

}  // namespace phalanx::check
