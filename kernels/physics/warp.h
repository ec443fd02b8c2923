// Maps from the unit square to the shapes that a path tracer samples, each beside its density.
#pragma once
#include "mathx.h"
#include "vec.h"

PHALANX_BEGIN

/// Unit disk, area-preserving and with low distortion (Shirley and Chiu 1997). Density 1/pi.
PHYS Vec2 square_to_disk(Vec2 u) {
  const float a = 2.0f * u.x - 1.0f;
  const float b = 2.0f * u.y - 1.0f;
  const bool wide = abs_of(a) > abs_of(b);
  const float r = wide ? a : b;
  const float other = wide ? b : a;
  if (r == 0.0f) return vec2(0.0f, 0.0f);
  const float turns = 0.125f * (other / r);
  const SinCos sc = sincos_turns(wide ? turns : 0.25f - turns);
  return vec2(r * sc.cosine, r * sc.sine);
}

/// Hemisphere z >= 0 with density cos / pi per solid angle (Malley's method).
PHYS Vec3 square_to_cosine_hemisphere(Vec2 u) {
  const Vec2 d = square_to_disk(u);
  return vec3(d.x, d.y, safe_sqrt(1.0f - d.x * d.x - d.y * d.y));
}
PHYS float pdf_cosine_hemisphere(float cos_theta) { return max_of(cos_theta, 0.0f) * PHALANX_INV_PI; }

/// Unit sphere, uniform: density 1 / (4 pi).
PHYS Vec3 square_to_sphere(Vec2 u) {
  const float z = 1.0f - 2.0f * u.x;
  const float r = 2.0f * safe_sqrt(u.x * (1.0f - u.x));
  const SinCos sc = sincos_turns(u.y);
  return vec3(r * sc.cosine, r * sc.sine, z);
}
PHYS float pdf_sphere() { return 0.0795774715459477f; }

/// Directions around +z within a cone, uniform in solid angle. `one_minus_cos` = 1 - cos(half
/// angle) in (0, 2], given instead of the angle so that narrow cones keep their digits.
PHYS Vec3 square_to_cone(Vec2 u, float one_minus_cos) {
  const float h = u.x * one_minus_cos;  // 1 - cos theta
  const float r = safe_sqrt(h * (2.0f - h));
  const SinCos sc = sincos_turns(u.y);
  return vec3(r * sc.cosine, r * sc.sine, 1.0f - h);
}
PHYS float pdf_cone(float one_minus_cos) { return 0.159154943091895f / one_minus_cos; }

/// 1 - cos of the half angle under which a sphere appears whose sine is s, in [0,1]: s^2 / (1 +
/// sqrt(1 - s^2)), exact for small angles where 1 - cos cancels (STABILITY L3).
PHYS float one_minus_cos_from_sin2(float sin2) { return sin2 / (1.0f + safe_sqrt(1.0f - sin2)); }

/// Barycentric coordinates (of the second and third corner), uniform in area. Heitz, "A
/// Low-Distortion Map Between Triangle and Square" (2019).
PHYS Vec2 square_to_triangle(Vec2 u) {
  if (u.y > u.x) return vec2(0.5f * u.x, u.y - 0.5f * u.x);
  return vec2(u.x - 0.5f * u.y, 0.5f * u.y);
}

/// Regular polygon with corners on the unit circle, the first at `turns` from the x axis, in [0, 1]; n >= 3.
/// Uniform in area: a triangle of the n around the centre, then a point in it.
PHYS Vec2 square_to_polygon(Vec2 u, int32 n, float turns) {
  const float scaled = u.x * to_float(n);
  const float side = round_down(scaled);
  const Vec2 b = square_to_triangle(vec2(scaled - side, u.y));
  const SinCos from = sincos_turns(turns + side / to_float(n));
  const SinCos to = sincos_turns(turns + (side + 1.0f) / to_float(n));
  return vec2(from.cosine * b.x + to.cosine * b.y, from.sine * b.x + to.sine * b.y);
}

PHALANX_END
