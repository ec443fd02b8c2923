// Camera rays: pixel filter by importance sampling, pinhole and thin lens.
#pragma once
#include "rng.h"
#include "warp.h"

PHALANX_BEGIN

struct Ray {
  Vec3 origin, direction;  // direction is unit
};

/// Offset from the pixel's centre in pixels, distributed like the reconstruction filter.
PHYS float filter_offset(const UNI FrameView &frame, float u) {
  const float x = u * to_float(PHALANX_FILTER_CELLS);
  const int32 cell = to_int(x);
  const float a = frame.filter_offsets[cell];
  const float b = frame.filter_offsets[cell + 1];
  return a + (b - a) * (x - to_float(cell));
}

/// Ray of sample `index` of pixel (x, y); y grows downwards. `scramble`: pixel_scramble().
PHYS Ray camera_ray(const UNI FrameView &frame, int32 x, int32 y, uint32 scramble, int32 index) {
  const Vec2 u = sample_pair(frame, scramble, index, PHALANX_PAIR_PIXEL);
  const float height = to_float(frame.height);
  const float px = to_float(x) + 0.5f + filter_offset(frame, u.x);
  const float py = to_float(y) + 0.5f + filter_offset(frame, u.y);
  const float scale = 2.0f * frame.camera.tan_half_fov_y / height;
  const float sx = (px - 0.5f * to_float(frame.width)) * scale;
  const float sy = (0.5f * height - py) * scale;
  // The point of the focal plane one unit in front of the camera.
  const Vec3 aim = frame.camera.forward + frame.camera.right * sx + frame.camera.up * sy;
  Ray r;
  r.origin = frame.camera.position;
  r.direction = normalize(aim);
  if (frame.camera.lens_radius > 0.0f) {
    const Vec2 lens =
        square_to_disk(sample_pair(frame, scramble, index, PHALANX_PAIR_LENS));
    const Vec3 shift = (frame.camera.right * lens.x + frame.camera.up * lens.y) *
                       frame.camera.lens_radius;
    r.origin = r.origin + shift;
    r.direction = normalize(aim * frame.camera.focus_distance - shift);
  }
  return r;
}

PHALANX_END
