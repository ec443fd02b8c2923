// A thin sheet of glass: both of its surfaces in one, without refraction. Reflects or passes, each a delta.
#pragma once
#include "bsdf_rough_dielectric.h"

PHALANX_BEGIN

/// Light that bounces any number of times inside, added up without interference: R' = 2 R / (1 + R),
/// T' = T / (1 + R). The same from both sides; radiance is not scaled, the sheet is thin.
PHYS BsdfSample sample_thin_dielectric(Material m, Vec3 wo, float u_lobe) {
  const float cos_i = min_of(wo.z, 1.0f);
  const Refraction once = fresnel_dielectric(cos_i, m.ior);
  const float more = 1.0f / (1.0f + once.reflectance);
  const float passes = once.cos_t > 0.0f ? fresnel_transmittance(cos_i, once.cos_t, m.ior) : 0.0f;
  const DielectricLobes lobes = dielectric_lobes(m, 2.0f * once.reflectance * more, passes * more);
  if (is_dark(lobes)) return no_sample();
  BsdfSample s;
  s.pdf = 0.0f;
  if (chooses_reflection(lobes, u_lobe)) {
    s.wi = vec3(-wo.x, -wo.y, wo.z);
    s.weight = m.specular * (lobes.reflectance / lobes.reflects);
  } else {
    s.wi = neg(wo);
    s.weight = m.transmittance * (lobes.transmittance / lobes.transmits);
  }
  return s;
}

PHALANX_END
