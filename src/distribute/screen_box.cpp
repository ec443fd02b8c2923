#include "screen_box.h"

#include <algorithm>
#include <cmath>

namespace phalanx {

Rect screen_box(const Scene &scene, const FrameView &frame) {
  const Rect all = {0, 0, frame.width, frame.height};
  const Camera &c = frame.camera;
  if (c.kind != kPerspective && c.kind != kOrthographic) return all;
  const Vec3 lo = scene.bounds_lo, hi = scene.bounds_hi;
  if (!(lo.x <= hi.x)) return all;
  double x0 = frame.width, x1 = 0, y0 = frame.height, y1 = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const double d[3] = {double{corner & 1 ? hi.x : lo.x} - double{c.position.x},
                         double{corner & 2 ? hi.y : lo.y} - double{c.position.y},
                         double{corner & 4 ? hi.z : lo.z} - double{c.position.z}};
    const auto along = [&](const Vec3 &axis) {
      return d[0] * double{axis.x} + d[1] * double{axis.y} + d[2] * double{axis.z};
    };
    const double depth = along(c.forward);
    if (!(depth > 0)) return all;
    const double half = c.kind == kOrthographic ? double{c.half_height}
                                                : double{c.tan_half_fov_y} * depth;  // of the height
    const double x = 0.5 * frame.width + along(c.right) / half * 0.5 * frame.height;
    const double y = 0.5 * frame.height - along(c.up) / half * 0.5 * frame.height;
    x0 = std::min(x0, x), x1 = std::max(x1, x);
    y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  const auto pixel = [](double v, int size) {
    return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(size)));
  };
  const int left = pixel(std::floor(x0), frame.width), right = pixel(std::ceil(x1), frame.width);
  const int top = pixel(std::floor(y0), frame.height), bottom = pixel(std::ceil(y1), frame.height);
  return {left, top, std::max(0, right - left), std::max(0, bottom - top)};
}

}  // namespace phalanx
