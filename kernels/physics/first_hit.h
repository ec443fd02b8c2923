// What the first surface of a path looks like to a denoiser or a compositor.
#pragma once
#include "fresnel.h"
#include "surface_material.h"

PHALANX_BEGIN

struct FirstHit {
  Vec3 albedo;   // reflectance at normal incidence; white for glass, black where nothing was hit
  Vec3 normal;   // shading normal towards the viewer; 0 where nothing was hit
  float depth;   // metres along the ray; 0 where nothing was hit
};

/// Reflectance as a denoiser wants it: at normal incidence, white for glass.
PHYS Vec3 material_albedo(Material m) {
  if (m.kind == kDielectric || m.kind == kRoughDielectric || m.kind == kThinDielectric)
    return vec3(1.0f, 1.0f, 1.0f);
  if ((m.kind == kConductor || m.kind == kGlossyConductor) && m.has_ior != 0)
    return vec3(fresnel_conductor(1.0f, m.eta.x, m.k.x), fresnel_conductor(1.0f, m.eta.y, m.k.y),
                fresnel_conductor(1.0f, m.eta.z, m.k.z));
  if (m.kind == kBlack) return vec3(0.0f, 0.0f, 0.0f);
  return m.reflectance;
}

template <int D>
PHYS FirstHit first_hit(const UNI SceneView &scene, Hit hit, Vec3 origin, Vec3 direction) {
  FirstHit f;
  f.albedo = vec3(0.0f, 0.0f, 0.0f);
  f.normal = vec3(0.0f, 0.0f, 0.0f);
  f.depth = 0.0f;
  if (hit.geometry < 0) return f;
  Surface s = make_surface<D>(scene, hit, origin, direction);
  Material m = surface_material<D>(scene, hit, s);
  if (D == kRich) {
    m = textured_material(scene, m, s.at);
    s.shading = mapped_frame(scene, m, s, direction);
  }
  f.normal = s.shading.n;
  f.depth = length(s.position - origin);
  f.albedo = material_albedo(m);
  return f;
}

PHALANX_END
