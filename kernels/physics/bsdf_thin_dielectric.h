// A thin sheet of glass: both of its surfaces in one, without refraction. Reflects or passes, each a delta.
#pragma once
#include "bsdf_rough_dielectric.h"

PHALANX_BEGIN

/// Light that bounces any number of times inside, added up without interference: R' = 2 R / (1 + R),
/// T' = 1 - R'. The same from both sides; radiance is not scaled, the sheet is thin.
PHYS BsdfSample sample_thin_dielectric(Material m, Vec3 wo, float u_lobe) {
  const Refraction once = fresnel_dielectric(min_of(wo.z, 1.0f), m.ior);
  const float reflectance = 2.0f * once.reflectance / (1.0f + once.reflectance);
  const float p = reflection_probability(m, reflectance);
  BsdfSample s;
  s.pdf = 0.0f;
  if (u_lobe < p) {
    s.wi = vec3(-wo.x, -wo.y, wo.z);
    s.weight = m.specular * (reflectance / p);
  } else {
    s.wi = neg(wo);
    s.weight = m.transmittance * ((1.0f - reflectance) / (1.0f - p));
  }
  return s;
}

PHALANX_END
