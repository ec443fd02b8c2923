// Surfaces with holes: a ray passes with the probability that the surface does not stop it.
//
// Decided inside the ray query, for bounce and shadow rays alike, by a hash of the ray and the primitive:
// every schedule decides the same, and no path state knows of it (pbrt-v4 does likewise).
#pragma once
#include "rng.h"
#include "surface_material.h"

PHALANX_BEGIN

/// Can rays go through surfaces of this material?
PHYS bool has_holes(Material m) { return m.opacity < 1.0f || m.opacity_texture >= 0; }

/// What distinguishes a ray in passes_through(); 0 in scenes without opacity.
PHYS uint32 ray_id(const UNI SceneView &scene, Vec3 origin, Vec3 direction) {
  if (scene.has_opacity == 0) return 0u;
  uint32 h = hash32((uint32)bits_from_float(origin.x));
  h = hash32(h + (uint32)bits_from_float(origin.y));
  h = hash32(h + (uint32)bits_from_float(origin.z));
  h = hash32(h + (uint32)bits_from_float(direction.x));
  h = hash32(h + (uint32)bits_from_float(direction.y));
  return hash32(h + (uint32)bits_from_float(direction.z));
}

/// True if ray `id` goes through the surface that it meets at `hit`. The ray is in the space of the
/// geometry's group. hit.geometry is a record of SceneView::geometries.
PHYS bool passes_through(const UNI SceneView &scene, Hit hit, Vec3 origin, Vec3 direction,
                         uint32 id) {
  const Geometry g = fetch(scene.geometries, hit.geometry);
  const Material m = fetch(scene.materials, g.material);
  const LocalSurface s = local_surface<kRich>(scene, g, hit, origin, direction);
  TexturePoint at;
  at.uv = s.uv;
  at.position = s.position;
  at.colour = s.colour;
  const uint32 primitive = hash32((uint32)hit.primitive + hash32((uint32)hit.geometry));
  return unit_float(hash32(id + primitive + (uint32)hit.far_root)) >= surface_opacity(scene, m, at);
}

PHALANX_END
