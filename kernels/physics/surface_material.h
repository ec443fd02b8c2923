// What a surface is made of: which material, its parameters from textures, its shading normal from maps.
#pragma once
#include "material.h"
#include "normal_map.h"
#include "surface.h"

PHALANX_BEGIN

/// The material that scatters at a hit: the geometry's, or what its blend came down to.
template <int D>
PHYS Material surface_material(const UNI SceneView &scene, Hit hit, Surface s) {
  if (D == kRich) {
    if (hit.material > 0) return fetch(scene.materials, hit.material - 1);
  }
  return fetch(scene.materials, s.material);
}

/// The shading frame after the material's normal or bump map. `direction`: of the ray that came.
PHYS Frame mapped_frame(const UNI SceneView &scene, Material m, Surface s, Vec3 direction) {
  if (m.normal_texture < 0 && m.bump_texture < 0) return s.shading;
  // Maps are drawn as seen from the front.
  Frame outer = s.shading;
  if (s.front == 0) outer.n = neg(outer.n);
  Tangents tangents;
  tangents.dpdu = s.dpdu;
  tangents.dpdv = s.dpdv;
  tangents.solid_s = s.solid_s;
  tangents.solid_t = s.solid_t;
  const Vec3 mapped = mapped_normal(scene, m, outer, s.at, tangents);
  Vec3 n = safe_normalize(to_world(outer, mapped), outer.n);
  if (s.front == 0) n = neg(n);
  if (!(dot(n, direction) < 0.0f)) return s.shading;
  return textured_frame(n, s.dpdu, s.dpdv);
}

/// The part of light that a surface stops, in [0, 1].
PHYS float surface_opacity(const UNI SceneView &scene, Material m, TexturePoint at) {
  if (m.opacity_texture < 0) return m.opacity;
  return m.opacity * clamp_to(texture_number(scene, m.opacity_texture, at), 0.0f, 1.0f);
}

PHALANX_END
