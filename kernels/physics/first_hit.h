// What the first surface of a path looks like to a denoiser or a compositor.
#pragma once
#include "fresnel.h"
#include "surface.h"

PHALANX_BEGIN

struct FirstHit {
  Vec3 albedo;   // reflectance at normal incidence; white for glass, black where nothing was hit
  Vec3 normal;   // shading normal towards the viewer; 0 where nothing was hit
  float depth;   // metres along the ray; 0 where nothing was hit
};

PHYS FirstHit first_hit(const UNI SceneView &scene, Hit hit, Vec3 origin, Vec3 direction) {
  FirstHit f;
  f.albedo = vec3(0.0f, 0.0f, 0.0f);
  f.normal = vec3(0.0f, 0.0f, 0.0f);
  f.depth = 0.0f;
  if (hit.geometry < 0) return f;
  const Surface s = make_surface(scene, hit, origin, direction);
  const Material m = scene.materials[s.material];
  f.normal = s.shading.n;
  f.depth = length(s.position - origin);
  if (m.kind == kDielectric) f.albedo = vec3(1.0f, 1.0f, 1.0f);
  else if (m.kind == kConductor && m.has_ior != 0)
    f.albedo = vec3(fresnel_conductor(1.0f, m.eta.x, m.k.x), fresnel_conductor(1.0f, m.eta.y, m.k.y),
                    fresnel_conductor(1.0f, m.eta.z, m.k.z));
  else if (m.kind != kBlack) f.albedo = m.reflectance;
  return f;
}

PHALANX_END
