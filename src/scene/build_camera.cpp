// The camera as kernels read it.
#include <cmath>

#include "build.h"
#include "build_report.h"
#include "transform.h"

namespace phalanx {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180.0;

Vec3 to_vec3(const Double3 &v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

/// v / |v|; zero if v has no direction. Scaled first: squares neither overflow nor vanish.
Double3 unit(const Double3 &v) {
  const double largest = std::fmax(std::fabs(v[0]), std::fmax(std::fabs(v[1]), std::fabs(v[2])));
  if (!(largest > 0) || !std::isfinite(largest)) return {0, 0, 0};
  const Double3 s = {v[0] / largest, v[1] / largest, v[2] / largest};
  const double size = length(s);
  return {s[0] / size, s[1] / size, s[2] / size};
}

}  // namespace

Camera build_camera(const CameraDescription &description, Diagnostics &diagnostics) {
  const auto error = [&](const char *key, const std::string &message) {
    diagnostics.error({"", 0, 0, std::string("/camera") + key, message});
  };
  const Double3 &from = description.position, &to = description.look_at;
  const Double3 view = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  const Double3 forward = unit(view);
  const Double3 right = unit(cross(forward, unit(description.up)));
  const double focus = description.focus_distance != 0 ? description.focus_distance : length(view);

  if (!is_valid_point(from))
    error("/position", point_text(from) + " must be finite and at most 1.8e18");
  else if (!(dot(forward, forward) > 0))
    error("/look_at", point_text(to) + " must be finite and another point than the position");
  else if (!(dot(right, right) > 0) || !(length(cross(forward, unit(description.up))) > 1e-9))
    error("/up", point_text(description.up) + " must not be zero or parallel to the view");
  if (!(description.fov > 0 && description.fov < 180))
    error("/fov", "the angle of view must be above 0 and below 180 degrees");
  if (!(description.aperture_radius >= 0 && is_valid_coordinate(description.aperture_radius)))
    error("/aperture_radius", "must be 0 or more, and finite");
  if (!(focus > 0 && is_valid_coordinate(focus)))
    error("/focus_distance", "must be above 0 and finite, or 0 for the distance to look_at");
  if (!(description.height > 0 && is_valid_coordinate(description.height)))
    error("/height", "must be above 0 and finite");
  if (!(description.angle > 0 && description.angle <= 360))
    error("/angle", "must be above 0 and at most 360 degrees");
  if (description.blades < 0 || description.blades == 1 || description.blades == 2)
    error("/blades", "an iris has 3 blades or more, or 0 if it is round");
  if (!std::isfinite(description.blade_rotation)) error("/blade_rotation", "must be finite");

  Camera camera = {};
  camera.position = to_vec3(from);
  camera.forward = to_vec3(forward);
  camera.right = to_vec3(right);
  camera.up = to_vec3(cross(right, forward));
  camera.tan_half_fov_y = static_cast<float>(std::tan(0.5 * description.fov * kDegree));
  if (description.kind == kPerspective)
    camera.lens_radius = static_cast<float>(description.aperture_radius);
  camera.focus_distance = static_cast<float>(focus);
  camera.kind = description.kind;
  camera.half_height = static_cast<float>(0.5 * description.height);
  camera.half_angle_turns = static_cast<float>(description.angle / 720);
  camera.blades = description.blades;
  const double turns = description.blade_rotation / 360;
  camera.blade_turns = static_cast<float>(turns - std::floor(turns));
  return camera;
}

}  // namespace phalanx
