// Smooth interface between two dielectrics: reflects or refracts, each a delta.
#pragma once
#include "bsdf_types.h"
#include "fresnel.h"

PHALANX_BEGIN

/// Chooses reflection with probability R, so that both lobes have weight 1. Radiance is scaled by
/// 1/eta^2 on the way through, as radiance (not importance) must be; the factor cancels on the way
/// out. An index within 1e-4 of 1 passes straight through (STABILITY M3).
PHYS BsdfSample sample_dielectric(Material m, int32 front, Vec3 wo, float u_lobe) {
  BsdfSample s;
  s.pdf = 0.0f;
  s.weight = vec3(1.0f, 1.0f, 1.0f);
  if (abs_of(m.ior - 1.0f) < 1e-4f) {
    s.wi = neg(wo);
    return s;
  }
  const float eta = front != 0 ? m.ior : 1.0f / m.ior;
  const Refraction r = fresnel_dielectric(min_of(wo.z, 1.0f), eta);
  if (u_lobe < r.reflectance) {
    s.wi = vec3(-wo.x, -wo.y, wo.z);
    return s;
  }
  const float scale = 1.0f / eta;
  s.wi = normalize(vec3(-wo.x * scale, -wo.y * scale, -r.cos_t));
  const float radiance_scale = scale * scale;
  s.weight = vec3(radiance_scale, radiance_scale, radiance_scale);
  return s;
}

PHALANX_END
