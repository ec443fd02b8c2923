// Analytic shapes: ray intersection in forms that keep their digits far from the shape.
#pragma once
#include "mathx.h"
#include "../scene_view.h"

PHALANX_BEGIN

struct ShapeHit {
  float t;       // along the given direction, in units of its length; negative: no hit
  int32 far_root;  // spheres: 1 for the second crossing
};

/// Distance to crossing `far_root` (0 near, 1 far) of a line that is known to hit; the discriminant
/// is taken as zero where rounding makes it negative.
/// Haines et al., "Precision Improvements for Ray/Sphere Intersection" (Ray Tracing Gems, ch. 7):
/// the discriminant from the distance between centre and line, roots without cancellation.
PHYS float sphere_root(Vec3 origin, Vec3 direction, Sphere s, int32 far_root) {
  const Vec3 f = origin - s.center;
  const float a = dot(direction, direction);
  const float b = -dot(f, direction);
  const Vec3 perpendicular = f + direction * (b / a);
  const float r2 = s.radius * s.radius;
  const float root = safe_sqrt(a * (r2 - dot(perpendicular, perpendicular)));
  const float q = b + copy_sign(root, b);
  const float c = dot(f, f) - r2;
  const float first = q != 0.0f ? c / q : 0.0f;
  const float second = q / a;
  const float near_t = min_of(first, second);
  const float far_t = max_of(first, second);
  return far_root != 0 ? far_t : near_t;
}

/// First crossing with t in (t_min, t_max).
PHYS ShapeHit intersect_sphere(Vec3 origin, Vec3 direction, Sphere s, float t_min, float t_max) {
  ShapeHit hit;
  hit.t = -1.0f;
  hit.far_root = 0;
  const Vec3 f = origin - s.center;
  const float a = dot(direction, direction);
  const float b = -dot(f, direction);
  const Vec3 perpendicular = f + direction * (b / a);
  if (dot(perpendicular, perpendicular) > s.radius * s.radius) return hit;
  const float near_t = sphere_root(origin, direction, s, 0);
  if (near_t > t_min && near_t < t_max) {
    hit.t = near_t;
    return hit;
  }
  const float far_t = sphere_root(origin, direction, s, 1);
  if (far_t > t_min && far_t < t_max) {
    hit.t = far_t;
    hit.far_root = 1;
  }
  return hit;
}

/// Distance along `direction` to the plane of a disk; 0 for a parallel line.
PHYS float disk_plane_distance(Vec3 origin, Vec3 direction, Disk d) {
  const Vec3 n = cross(d.axis_u, d.axis_v);
  const float slope = dot(direction, n);
  return slope != 0.0f ? dot(d.center - origin, n) / slope : 0.0f;
}

/// Position of p's projection on the disk in units of its axes.
PHYS Vec2 disk_coordinates(Vec3 p, Disk d) {
  const float inv_r2 = 1.0f / dot(d.axis_u, d.axis_u);
  const Vec3 r = p - d.center;
  return vec2(dot(r, d.axis_u) * inv_r2, dot(r, d.axis_v) * inv_r2);
}

PHYS ShapeHit intersect_disk(Vec3 origin, Vec3 direction, Disk d, float t_min, float t_max) {
  ShapeHit hit;
  hit.t = -1.0f;
  hit.far_root = 0;
  const float t = disk_plane_distance(origin, direction, d);
  if (!(t > t_min && t < t_max)) return hit;
  const Vec2 xy = disk_coordinates(origin + direction * t, d);
  if (xy.x * xy.x + xy.y * xy.y <= 1.0f) hit.t = t;
  return hit;
}

/// Texture coordinates of the point of a sphere with unit normal n: u runs around z from +x, v from 0 at -z
/// to 1 at +z.
PHYS Vec2 sphere_uv(Vec3 n) {
  const float turns = atan2_turns(n.y, n.x);
  return vec2(turns < 0.0f ? turns + 1.0f : turns, 1.0f - acos_of(n.z) * PHALANX_INV_PI);
}

/// Texture coordinates of a disk's point in units of its axes: radius and turns.
PHYS Vec2 disk_uv(Vec2 xy) {
  const float turns = atan2_turns(xy.y, xy.x);
  return vec2(square_root(xy.x * xy.x + xy.y * xy.y), turns < 0.0f ? turns + 1.0f : turns);
}

PHALANX_END
