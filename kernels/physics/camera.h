// Camera rays: pixel filter by importance sampling; pinhole, thin lens with a round or polygonal iris,
// orthographic, equirectangular, fisheye.
#pragma once
#include "rng.h"
#include "warp.h"

PHALANX_BEGIN

struct Ray {
  Vec3 origin, direction;  // direction is unit
  float weight;            // 1, or 0 where the camera sees nothing: the ray then starts beyond all scenes
};

/// Offset from the pixel's centre in pixels, distributed like the reconstruction filter.
PHYS float filter_offset(const UNI FrameView &frame, float u) {
  const float x = u * to_float(PHALANX_FILTER_CELLS);
  const int32 cell = to_int(x);
  const float a = frame.filter_offsets[cell];
  const float b = frame.filter_offsets[cell + 1];
  return a + (b - a) * (x - to_float(cell));
}

/// Point of the iris of radius 1.
PHYS Vec2 iris_point(const UNI FrameView &frame, Vec2 u) {
  if (frame.camera.blades > 0)
    return square_to_polygon(u, frame.camera.blades, frame.camera.blade_turns);
  return square_to_disk(u);
}

/// Ray of a camera without perspective. (sx, sy): point of the picture from its centre, right and up, in
/// half heights of the picture; aspect: width over height.
PHYS_CALL Ray wide_ray(const UNI FrameView &frame, float sx, float sy, float aspect) {
  Ray r;
  r.origin = frame.camera.position;
  r.direction = frame.camera.forward;
  r.weight = 1.0f;
  if (frame.camera.kind == kOrthographic) {
    r.origin = r.origin + (frame.camera.right * sx + frame.camera.up * sy) * frame.camera.half_height;
    return r;
  }
  if (frame.camera.kind == kEquirectangular) {
    // Beyond the picture's edges longitude goes round, and latitude over the pole.
    const float longitude = 0.5f * (sx / aspect);
    const float latitude = 0.25f * sy;
    const SinCos east = sincos_turns(longitude - round_down(longitude));
    const SinCos north = sincos_turns(latitude - round_down(latitude));
    r.direction = normalize((frame.camera.forward * east.cosine + frame.camera.right * east.sine) *
                                north.cosine +
                            frame.camera.up * north.sine);
    return r;
  }
  // Fisheye, equidistant: the angle from the axis grows as the distance from the picture's centre.
  const float distance = square_root(sx * sx + sy * sy);
  if (distance > 1.0f) {
    r.origin = r.direction * 1.0e18f;
    r.weight = 0.0f;
    return r;
  }
  if (distance > 0.0f) {
    const SinCos off = sincos_turns(frame.camera.half_angle_turns * distance);
    const Vec3 aside = frame.camera.right * (sx / distance) + frame.camera.up * (sy / distance);
    r.direction = normalize(frame.camera.forward * off.cosine + aside * off.sine);
  }
  return r;
}

/// Ray of sample `index` of pixel (x, y); y grows downwards. `scramble`: pixel_scramble().
PHYS Ray camera_ray(const UNI FrameView &frame, int32 x, int32 y, uint32 scramble, int32 index) {
  const Vec2 u = sample_pair(frame, scramble, index, PHALANX_PAIR_PIXEL);
  const float width = to_float(frame.width);
  const float height = to_float(frame.height);
  const float px = to_float(x) + 0.5f + filter_offset(frame, u.x);
  const float py = to_float(y) + 0.5f + filter_offset(frame, u.y);
  if (frame.camera.kind != kPerspective)
    return wide_ray(frame, (px - 0.5f * width) * (2.0f / height), (0.5f * height - py) * (2.0f / height),
                    width / height);
  const float scale = 2.0f * frame.camera.tan_half_fov_y / height;
  const float sx = (px - 0.5f * width) * scale;
  const float sy = (0.5f * height - py) * scale;
  // The point of the focal plane one unit in front of the camera.
  const Vec3 aim = frame.camera.forward + frame.camera.right * sx + frame.camera.up * sy;
  Ray r;
  r.origin = frame.camera.position;
  r.direction = normalize(aim);
  r.weight = 1.0f;
  if (frame.camera.lens_radius > 0.0f) {
    const Vec2 lens = iris_point(frame, sample_pair(frame, scramble, index, PHALANX_PAIR_LENS));
    const Vec3 shift = (frame.camera.right * lens.x + frame.camera.up * lens.y) *
                       frame.camera.lens_radius;
    r.origin = r.origin + shift;
    r.direction = normalize(aim * frame.camera.focus_distance - shift);
  }
  return r;
}

PHALANX_END
