// Lambert's diffuse reflection: f = reflectance / pi, on the side of wo.
#pragma once
#include "bsdf_types.h"
#include "warp.h"

PHALANX_BEGIN

PHYS BsdfSample sample_diffuse(Material m, Vec2 u) {
  BsdfSample s;
  s.wi = square_to_cosine_hemisphere(u);
  s.pdf = pdf_cosine_hemisphere(s.wi.z);
  s.weight = m.reflectance;
  if (!(s.pdf > 0.0f)) return no_sample();
  return s;
}

PHYS BsdfValue eval_diffuse(Material m, Vec3 wi) {
  BsdfValue v;
  v.pdf = pdf_cosine_hemisphere(wi.z);
  v.f_cos = m.reflectance * v.pdf;
  return v;
}

PHALANX_END
