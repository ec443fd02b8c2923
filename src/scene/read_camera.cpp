// "camera": where the picture is taken from.
#include <cmath>

#include "read_scene.h"

namespace phalanx {

namespace {

enum CameraType { kPinhole, kThinLens, kParallel, kPanorama, kDisc };
const char *const kCameraNames[] = {"a pinhole camera", "a thin_lens camera", "an orthographic camera",
                                    "an equirectangular camera", "a fisheye camera"};
constexpr CameraKind kCameraKinds[] = {kPerspective, kPerspective, kOrthographic, kEquirectangular,
                                       kFisheye};

Double3 minus(const Double3 &a, const Double3 &b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Double3 cross_product(const Double3 &a, const Double3 &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double norm(const Double3 &a) { return std::hypot(a[0], a[1], a[2]); }

/// Refuses cameras that do not say where they look or which way is up.
void check_orientation(const CameraDescription &camera, const ObjectReader &object,
                       Source &source) {
  const Double3 view = minus(camera.look_at, camera.position);
  if (norm(view) == 0) {
    source.error(object.node(),
                 "position and look_at are the same point: the camera looks nowhere");
    return;
  }
  if (norm(camera.up) == 0) {
    source.error(object.node(), "up is [0, 0, 0]: expected a direction");
    return;
  }
  constexpr double kLeastSine = 1e-6;  // of the angle between up and the view
  if (norm(cross_product(view, camera.up)) < kLeastSine * norm(view) * norm(camera.up)) {
    source.error(object.node(), "up is parallel to the view from position to look_at");
  }
}

/// "aperture_radius", "focus_distance", "blades", "blade_rotation".
void read_lens(ObjectReader &object, CameraDescription &camera) {
  constexpr int kMostBlades = 64;
  object.number("aperture_radius", {0, kMaxCoordinate, "metres"}, camera.aperture_radius, kRequired);
  object.number("focus_distance", kLength, camera.focus_distance);
  object.integer("blades", 3, kMostBlades, camera.blades,
                 object.has("blade_rotation") ? kRequired : kOptional);
  object.number("blade_rotation", {-360, 360, "degrees"}, camera.blade_rotation);
}

}  // namespace

CameraDescription read_camera(const Node &node, Source &source) {
  CameraDescription camera;
  ObjectReader object(node, source);
  int type = kPinhole;
  if (!object.choice("type",
                     {{"pinhole", kPinhole},
                      {"thin_lens", kThinLens},
                      {"orthographic", kParallel},
                      {"equirectangular", kPanorama},
                      {"fisheye", kDisc}},
                     type) &&
      !object.ok())
    return camera;
  camera.kind = kCameraKinds[type];
  object.vector("position", kCoordinate, camera.position);
  object.vector("look_at", kCoordinate, camera.look_at);
  object.vector("up", kDirection, camera.up);
  if (camera.kind == kPerspective) object.number("fov", {1e-9, 180, "degrees", true}, camera.fov);
  if (type == kThinLens) read_lens(object, camera);
  if (type == kParallel) object.number("height", kLength, camera.height, kRequired);
  if (type == kDisc) object.number("angle", {1e-9, 360, "degrees"}, camera.angle);
  object.finish(kCameraNames[type]);
  if (object.ok()) check_orientation(camera, object, source);
  return camera;
}

}  // namespace phalanx
