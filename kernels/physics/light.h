// Sampling emitters: which one, where on it, and with what density.
//
// Every density is per solid angle at the receiving point and includes the choice of the light.
// The constant environment is not sampled here: BSDF sampling alone meets it with equal weight
// from every direction (docs/decisions/0003).
#pragma once
#include "warp.h"
#include "../scene_view.h"

PHALANX_BEGIN

struct LightSample {
  Vec3 point;       // on the light
  Vec3 direction;   // unit, from the receiver to the point, moved off the light by its rounding error
  float distance;   // metres
  float pdf;        // per solid angle, > 0; 0: no usable sample
  Vec3 radiance;    // towards the receiver; black where the light's back is seen
  int32 is_delta;   // 1: the light has no extent, nothing but sampling finds it
};

/// Light index by Walker's alias table; probability Light::select_pdf.
PHYS int32 choose_light(const UNI SceneView &scene, Vec2 u) {
  if (scene.num_lights == 1) return 0;
  const int32 last = scene.num_lights - 1;
  const float scaled = u.x * to_float(scene.num_lights);
  int32 i = to_int(scaled);
  i = i < last ? i : last;
  return u.y < scene.alias_threshold[i] ? i : scene.alias_other[i];
}

/// Density of hitting `light` at `position` (normal `n` there, unit) from `origin`.
PHYS float light_pdf(Light light, Vec3 origin, Vec3 position, Vec3 n) {
  if (light.kind == kSphereLight) {
    const float d2 = length_squared(light.p - origin);
    const float r2 = light.radius * light.radius;
    if (d2 > r2) return light.select_pdf * pdf_cone(one_minus_cos_from_sin2(r2 / d2));
  }
  const Vec3 to_light = position - origin;
  const float d2 = length_squared(to_light);
  const float cos_l = abs_of(dot(n, to_light));  // times the distance
  if (!(cos_l > 0.0f)) return 0.0f;
  // Ratios of like magnitude: the cube of a distance leaves the floats above 10^12 m.
  return light.select_pdf * (d2 / light.area) * (square_root(d2) / cos_l);
}

/// A point on a sphere light: by the cone it fills seen from outside, by area from within.
PHYS Vec3 sample_sphere_light(Light light, Vec3 origin, Vec2 u) {
  const Vec3 to_center = light.p - origin;
  const float d2 = length_squared(to_center);
  const float r2 = light.radius * light.radius;
  if (!(d2 > r2)) return light.p + square_to_sphere(u) * light.radius;
  const float d = square_root(d2);
  const Frame f = make_frame(to_center * (1.0f / d));
  const Vec3 w = square_to_cone(u, one_minus_cos_from_sin2(r2 / d2));
  // The near crossing: w = (sin, sin, cos), chord half-length sqrt(r^2 - d^2 sin^2).
  const float sin2 = w.x * w.x + w.y * w.y;
  const float t = d * w.z - safe_sqrt(r2 - d2 * sin2);
  const Vec3 p = origin + to_world(f, w) * t;
  return light.p + safe_normalize(p - light.p, neg(f.n)) * light.radius;
}

/// Is it the front of `light` that `origin` sees at p, normal n? All of a sphere's from outside: at a radius of a few
/// ulps the normals of its points are too coarse to tell.
PHYS bool shows_front(Light light, Vec3 origin, Vec3 p, Vec3 n) {
  if (light.kind == kSphereLight) return length_squared(light.p - origin) > light.radius * light.radius;
  return dot(n, origin - p) > 0.0f;
}

/// Samples the emitted radiance that reaches `origin` directly.
PHYS LightSample sample_light(const UNI SceneView &scene, Vec3 origin, Vec2 u_choice, Vec2 u) {
  const Light light = fetch(scene.lights, choose_light(scene, u_choice));
  Vec3 p;
  Vec3 n = light.normal;
  if (light.kind == kSphereLight) {
    p = sample_sphere_light(light, origin, u);
    n = (p - light.p) * (1.0f / light.radius);
  } else if (light.kind == kQuadLight) {
    p = light.p + light.a * u.x + light.b * u.y;
  } else if (light.kind == kTriangleLight) {
    const Vec2 b = square_to_triangle(u);
    p = light.p + light.a * b.x + light.b * b.y;
  } else {
    const Vec2 d = square_to_disk(u);
    p = light.p + light.a * d.x + light.b * d.y;
  }
  const bool front = shows_front(light, origin, p, n);
  LightSample s;
  s.is_delta = 0;
  s.point = p;
  const Vec3 to_light = p + n * (front ? light.error : -light.error) - origin;
  s.distance = length(to_light);
  s.pdf = light_pdf(light, origin, p, n);
  s.radiance = (front || light.two_sided != 0) ? light.emission : vec3(0.0f, 0.0f, 0.0f);
  s.direction = to_light * (1.0f / s.distance);
  if (!(s.distance > 0.0f) || !is_finite(s.pdf)) s.pdf = 0.0f;
  return s;
}

PHALANX_END
