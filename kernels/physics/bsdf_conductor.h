// Rough metal: GGX microfacets, visible-normal sampling, single scattering.
#pragma once
#include "bsdf_types.h"
#include "fresnel.h"
#include "microfacet.h"

PHALANX_BEGIN

/// Reflectance at a microfacet: measured (eta, k) where given, else Schlick over F0.
PHYS Vec3 conductor_fresnel(Material m, float cos_i) {
  if (m.has_ior != 0) {
    return vec3(fresnel_conductor(cos_i, m.eta.x, m.k.x), fresnel_conductor(cos_i, m.eta.y, m.k.y),
                fresnel_conductor(cos_i, m.eta.z, m.k.z));
  }
  return fresnel_schlick(cos_i, m.reflectance);
}

/// Weight F G2 / G1. Directions below the surface are valid zero samples: their share of the
/// density is energy that single scattering loses.
PHYS BsdfSample sample_conductor(Material m, Vec3 wo, Vec2 u) {
  const Vec3 h = sample_ggx_visible(wo, m.alpha, u);
  const float wo_h = dot(wo, h);
  BsdfSample s;
  s.wi = normalize(h * (2.0f * wo_h) - wo);
  if (!(s.wi.z > 0.0f) || !(wo_h > 0.0f)) return no_sample();
  s.pdf = pdf_ggx_visible(wo, h, m.alpha) / (4.0f * wo_h);
  const float lambda_o = ggx_lambda(wo, m.alpha);
  const float shadowing = (1.0f + lambda_o) / (1.0f + lambda_o + ggx_lambda(s.wi, m.alpha));
  s.weight = conductor_fresnel(m, min_of(wo_h, 1.0f)) * shadowing;
  if (!(s.pdf > 0.0f) || !is_finite(s.pdf)) return no_sample();
  return s;
}

PHYS BsdfValue eval_conductor(Material m, Vec3 wo, Vec3 wi) {
  if (!(wi.z > 0.0f)) return no_value();
  const Vec3 h = safe_normalize(wo + wi, vec3(0.0f, 0.0f, 1.0f));
  const float wo_h = dot(wo, h);
  if (!(wo_h > 0.0f)) return no_value();
  const float d = ggx_d(h, m.alpha);
  BsdfValue v;
  v.pdf = ggx_g1(wo, m.alpha) * d / (4.0f * wo.z);
  v.f_cos = conductor_fresnel(m, min_of(wo_h, 1.0f)) * (d * ggx_g2(wo, wi, m.alpha) / (4.0f * wo.z));
  return v;
}

PHALANX_END
