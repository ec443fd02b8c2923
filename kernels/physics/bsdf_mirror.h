// Perfect specular reflection with Schlick's Fresnel term.
#pragma once
#include "bsdf_types.h"
#include "fresnel.h"

PHALANX_BEGIN

PHYS BsdfSample sample_mirror(Material m, Vec3 wo) {
  BsdfSample s;
  s.wi = vec3(-wo.x, -wo.y, wo.z);
  s.weight = fresnel_schlick(wo.z, m.reflectance);
  s.pdf = 0.0f;
  return s;
}

PHALANX_END
