// Blends: which of two materials a path meets. One is drawn by its weight before anything else happens at
// the surface, so that scattering only ever sees plain materials and their kinds.
#pragma once
#include "rng.h"
#include "surface_material.h"

PHALANX_BEGIN

/// Index of the material at a hit (hit.geometry >= 0) on path vertex `depth`: the geometry's own unless
/// that is a blend.
PHYS int32 resolve_material(const UNI SceneView &scene, const UNI FrameView &frame, Hit hit,
                            Vec3 origin, Vec3 direction, int32 scramble, int32 sample,
                            int32 depth) {
  const Geometry g = fetch(scene.geometries, hit.geometry);
  if (g.kind != kBlend) return g.material;
  const Surface s = make_surface<kRich>(scene, hit, origin, direction);
  uint32 random = hash32((uint32)sample * 64u + (uint32)depth + 0x51ed270bu);
  random = hash32((uint32)scramble + hash32(random + (uint32)frame.seed));
  int32 index = g.material;
  for (UNI int32 level = 0; level < PHALANX_MAX_BLEND_DEPTH; level++) {
    const Material m = fetch(scene.materials, index);
    if (m.kind == kBlend) {
      float weight = m.weight;
      if (m.weight_texture >= 0) weight = texture_number(scene, m.weight_texture, s.at);
      random = hash32(random + 0x9e3779b9u);
      index = unit_float(random) < weight ? m.blend_b : m.blend_a;
    }
  }
  return index;
}

/// The hit with its material resolved.
template <int D>
PHYS Hit resolve_hit(const UNI SceneView &scene, const UNI FrameView &frame, Hit hit, Vec3 origin,
                     Vec3 direction, int32 scramble, int32 sample, int32 depth) {
  Hit resolved = hit;
  if (D == kRich && scene.has_blends != 0) {
    if (hit.geometry >= 0)
      resolved.material =
          1 + resolve_material(scene, frame, hit, origin, direction, scramble, sample, depth);
  }
  return resolved;
}

PHALANX_END
