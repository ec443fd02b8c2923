// Vectors of two and three floats, colours, and orthonormal frames.
#pragma once
#include "lang.h"

PHALANX_BEGIN

struct Vec2 {
  float x, y;
};

/// A point, a direction, or a linear RGB colour (x red, y green, z blue).
struct Vec3 {
  float x, y, z;
};

PHYS Vec2 vec2(float x, float y) {
  Vec2 v;
  v.x = x;
  v.y = y;
  return v;
}

PHYS Vec3 vec3(float x, float y, float z) {
  Vec3 v;
  v.x = x;
  v.y = y;
  v.z = z;
  return v;
}

PHYS Vec3 operator+(Vec3 a, Vec3 b) { return vec3(a.x + b.x, a.y + b.y, a.z + b.z); }
PHYS Vec3 operator-(Vec3 a, Vec3 b) { return vec3(a.x - b.x, a.y - b.y, a.z - b.z); }
PHYS Vec3 operator*(Vec3 a, Vec3 b) { return vec3(a.x * b.x, a.y * b.y, a.z * b.z); }
PHYS Vec3 operator*(Vec3 a, float s) { return vec3(a.x * s, a.y * s, a.z * s); }
PHYS Vec3 neg(Vec3 a) { return vec3(-a.x, -a.y, -a.z); }
PHYS float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
PHYS Vec3 cross(Vec3 a, Vec3 b) {
  return vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}
PHYS Vec3 abs3(Vec3 a) { return vec3(abs_of(a.x), abs_of(a.y), abs_of(a.z)); }
PHYS Vec3 max3(Vec3 a, Vec3 b) { return vec3(max_of(a.x, b.x), max_of(a.y, b.y), max_of(a.z, b.z)); }
PHYS float length_squared(Vec3 a) { return dot(a, a); }
PHYS float length(Vec3 a) { return square_root(dot(a, a)); }
PHYS float max_component(Vec3 a) { return max_of(max_of(a.x, a.y), a.z); }
PHYS bool is_black(Vec3 a) { return a.x == 0.0f && a.y == 0.0f && a.z == 0.0f; }
PHYS bool all_finite(Vec3 a) { return is_finite(a.x) && is_finite(a.y) && is_finite(a.z); }
/// Can a ray be traced? Ray queries take neither NaN nor infinities nor origins beyond 1.84e18.
PHYS bool is_traceable(Vec3 origin, Vec3 direction) {
  return abs_of(origin.x) <= 1.84e18f && abs_of(origin.y) <= 1.84e18f && abs_of(origin.z) <= 1.84e18f &&
         all_finite(direction);
}
PHYS float luminance(Vec3 c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

/// a / |a|. The caller knows that a is neither zero nor so large that its square overflows.
PHYS Vec3 normalize(Vec3 a) { return a * (1.0f / square_root(dot(a, a))); }

/// a / |a| for any finite a: scaled by the largest component first so that squares neither
/// overflow nor vanish. Returns `fallback` where a is zero or not finite.
PHYS Vec3 safe_normalize(Vec3 a, Vec3 fallback) {
  const float m = max_component(abs3(a));
  if (!(m > 0.0f) || !is_finite(m)) return fallback;
  return normalize(vec3(a.x / m, a.y / m, a.z / m));  // 1 / m may be no float, or flushed to zero
}

/// An orthonormal frame whose third axis is n.
struct Frame {
  Vec3 s, t, n;
};

/// Frame around the unit vector n. Duff et al., "Building an Orthonormal Basis, Revisited"
/// (JCGT 6:1, 2017): no loss of precision near n.z = -1.
PHYS Frame make_frame(Vec3 n) {
  const float sign = copy_sign(1.0f, n.z);
  const float a = -1.0f / (sign + n.z);
  const float b = n.x * n.y * a;
  Frame f;
  f.s = vec3(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
  f.t = vec3(b, sign + n.y * n.y * a, -n.y);
  f.n = n;
  return f;
}

PHYS Vec3 to_local(Frame f, Vec3 v) { return vec3(dot(v, f.s), dot(v, f.t), dot(v, f.n)); }
PHYS Vec3 to_world(Frame f, Vec3 v) { return f.s * v.x + f.t * v.y + f.n * v.z; }

/// Affine map as three rows of four.
struct Affine {
  float m00, m01, m02, m03;
  float m10, m11, m12, m13;
  float m20, m21, m22, m23;
};

PHYS Vec3 transform_point(Affine a, Vec3 p) {
  return vec3(a.m00 * p.x + a.m01 * p.y + a.m02 * p.z + a.m03,
              a.m10 * p.x + a.m11 * p.y + a.m12 * p.z + a.m13,
              a.m20 * p.x + a.m21 * p.y + a.m22 * p.z + a.m23);
}
PHYS Vec3 transform_vector(Affine a, Vec3 v) {
  return vec3(a.m00 * v.x + a.m01 * v.y + a.m02 * v.z, a.m10 * v.x + a.m11 * v.y + a.m12 * v.z,
              a.m20 * v.x + a.m21 * v.y + a.m22 * v.z);
}
/// Multiplies by the transpose of the linear part: with the inverse map this takes normals along.
PHYS Vec3 transform_transposed(Affine a, Vec3 n) {
  return vec3(a.m00 * n.x + a.m10 * n.y + a.m20 * n.z, a.m01 * n.x + a.m11 * n.y + a.m21 * n.z,
              a.m02 * n.x + a.m12 * n.y + a.m22 * n.z);
}
/// |A| v with absolute values everywhere: how far an error box can grow.
PHYS Vec3 transform_abs(Affine a, Vec3 v) {
  return vec3(abs_of(a.m00) * v.x + abs_of(a.m01) * v.y + abs_of(a.m02) * v.z + abs_of(a.m03),
              abs_of(a.m10) * v.x + abs_of(a.m11) * v.y + abs_of(a.m12) * v.z + abs_of(a.m13),
              abs_of(a.m20) * v.x + abs_of(a.m21) * v.y + abs_of(a.m22) * v.z + abs_of(a.m23));
}

PHALANX_END
