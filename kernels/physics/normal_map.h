// Normal maps and bump maps: the fine shape of a surface as a change of its shading normal.
#pragma once
#include "texture.h"

PHALANX_BEGIN

/// The normal (0, 0, 1) of a local frame.
PHYS Vec3 local_up() { return vec3(0.0f, 0.0f, 1.0f); }

/// n as a unit vector that does not lie below the horizon; straight up if it has no direction.
PHYS Vec3 upright(Vec3 n) {
  if (!all_finite(n)) return local_up();
  const Vec3 unit = safe_normalize(vec3(n.x, n.y, max_of(n.z, 0.0f)), local_up());
  if (unit.z >= 0.01f) return unit;
  return normalize(vec3(unit.x, unit.y, 0.01f));
}

/// True for textures that depend on the position instead of uv.
PHYS bool is_solid(Texture t) {
  return t.kind == kMarbleTexture || t.kind == kNoiseTexture ||
         (t.kind == kCheckerTexture && t.scale > 0.0f);
}

/// The step in uv that moves a texture by one texel, or by 1e-3 where it has no texels. `du`, `dv`: how
/// the texture's own coordinates move with the step.
PHYS float uv_step(Texture t, float du, float dv) {
  if (t.kind != kImageTexture) return 1.0e-3f;
  const float texels = max_of(abs_of(du) * to_float(t.width), abs_of(dv) * to_float(t.height));
  return texels > 0.0f ? 1.0f / texels : 1.0f;
}

/// How fast a texture's number changes from `at` along one direction, per `step`: central difference.
PHYS float texture_slope(const UNI SceneView &scene, int32 texture, TexturePoint at, Vec2 step_uv,
                         Vec3 step_position, float step) {
  float ends[2];
  for (UNI int32 k = 0; k < 2; k++) {
    const float half = (float)k - 0.5f;
    TexturePoint end = at;
    end.uv = vec2(at.uv.x + half * step_uv.x, at.uv.y + half * step_uv.y);
    end.position = at.position + step_position * half;
    ends[k] = texture_number(scene, texture, end);
  }
  return (ends[1] - ends[0]) / step;
}

/// The gradient g in a plane of a function whose slopes along the vectors p and q of that plane are known:
/// dot(g, p) = along_p, dot(g, q) = along_q. 0 where p and q are parallel.
PHYS Vec2 plane_gradient(Vec3 p, Vec3 q, float along_p, float along_q) {
  const float determinant = p.x * q.y - p.y * q.x;
  const float inverse = determinant != 0.0f ? 1.0f / determinant : 0.0f;
  return vec2((along_p * q.y - along_q * p.y) * inverse, (along_q * p.x - along_p * q.x) * inverse);
}

/// How a surface moves under its textures: the world position with uv, and TexturePoint::position with a
/// metre along the shading frame's s and t (s and t themselves but in instances).
struct Tangents {
  Vec3 dpdu, dpdv;
  Vec3 solid_s, solid_t;
};

/// 1/256 of a cell of a solid texture in metres of the world, where a metre moves the texture by `moves`.
PHYS float solid_step(Texture t, Vec3 moves) {
  const float rate = length(moves) * (t.scale > 0.0f ? t.scale : 1.0f);
  return rate > 0.0f ? 0.00390625f / rate : 1.0f;
}

/// The gradient of a texture's number in the plane of frame.s and frame.t, per metre.
PHYS Vec2 texture_gradient(const UNI SceneView &scene, int32 texture, Frame frame, TexturePoint at,
                           Tangents tangents) {
  const Texture t = fetch(scene.textures, texture);
  const bool solid = is_solid(t);
  const Vec3 none = vec3(0.0f, 0.0f, 0.0f);
  const float step_u = solid ? solid_step(t, tangents.solid_s) : uv_step(t, t.m00, t.m10);
  const float step_v = solid ? solid_step(t, tangents.solid_t) : uv_step(t, t.m01, t.m11);
  const Vec2 uv_u = vec2(solid ? 0.0f : step_u, 0.0f);
  const Vec2 uv_v = vec2(0.0f, solid ? 0.0f : step_v);
  Vec3 position_u = none;
  Vec3 position_v = none;
  if (solid) {
    position_u = tangents.solid_s * step_u;
    position_v = tangents.solid_t * step_v;
  }
  const float u = texture_slope(scene, texture, at, uv_u, position_u, step_u);
  const float v = texture_slope(scene, texture, at, uv_v, position_v, step_v);
  if (solid) return vec2(u, v);
  return plane_gradient(to_local(frame, tangents.dpdu), to_local(frame, tangents.dpdv), u, v);
}

/// The shading normal after the maps of a material, in the shading frame: unit, z > 0. `frame` is seen from
/// the front, s along the texture's u, t along its v. Normal maps hold (n + 1) / 2, with green along v.
/// Bump maps: J. Blinn, "Simulation of Wrinkled Surfaces" (SIGGRAPH 1978), by way of the surface gradient
/// of M. Mikkelsen, "Bump Mapping Unparametrized Surfaces on the GPU" (2010).
PHYS_CALL Vec3 mapped_normal(const UNI SceneView &scene, Material m, Frame frame, TexturePoint at,
                             Tangents tangents) {
  Vec3 n = local_up();
  if (m.normal_texture >= 0) {
    const Vec3 c = texture_value(scene, m.normal_texture, at);
    n = upright(vec3((2.0f * c.x - 1.0f) * m.normal_scale, (2.0f * c.y - 1.0f) * m.normal_scale,
                     2.0f * c.z - 1.0f));
  }
  if (m.bump_texture >= 0) {
    const Vec2 g = texture_gradient(scene, m.bump_texture, frame, at, tangents);
    const float height = m.bump_scale * n.z;
    n = upright(vec3(n.x - height * g.x, n.y - height * g.y, n.z));
  }
  return n;
}

PHALANX_END
