// Rough diffuse surfaces: Oren-Nayar that keeps its energy.
//
// EON: Portsmouth, Kutz, Hill, "EON: A practical energy-preserving rough diffuse BRDF" (JCGT 14:1, 2025).
// Single scattering is Fujii's Oren-Nayar (FON); multiple scattering adds what that loses, with the exact
// albedo of FON, so that a white surface reflects everything at any roughness.
#pragma once
#include "bsdf_types.h"
#include "warp.h"

PHALANX_BEGIN

#define PHALANX_FON_1 0.287793409f   // 1/2 - 2 / (3 pi)
#define PHALANX_FON_2 0.0724882111f  // 2/3 - 28 / (15 pi)

/// What FON loses in direction mu (cosine, in [0,1]) over A r: PHALANX_FON_1 - G(mu) / pi, where its
/// albedo is A (1 + r G / pi). In [0, PHALANX_FON_1], 0 at grazing angles. Listing 1, without its
/// division by mu: (1 - s^3) / mu = mu (1 + s + s^2) / (1 + s).
PHYS float fon_loss(float mu) {
  const float s = safe_sqrt((1.0f - mu) * (1.0f + mu));
  const float g =
      s * (acos_of(mu) - s * mu) + 0.666666667f * (s * mu * (1.0f + s + s * s) / (1.0f + s) - s);
  return max_of(PHALANX_FON_1 - g * PHALANX_INV_PI, 0.0f);
}

/// Albedo of the light that scatters more than once, one channel. average: of FON's albedo.
PHYS float eon_multiple(float reflectance, float average) {
  return reflectance * reflectance * average / (1.0f - reflectance * (1.0f - average));
}

/// f in units of 1 / pi, for wi.z > 0.
PHYS Vec3 eon_value(Material m, Vec3 wo, Vec3 wi) {
  const float r = m.roughness;
  const float a = 1.0f / (1.0f + PHALANX_FON_1 * r);
  const float s = wo.x * wi.x + wo.y * wi.y;
  const float s_over_t = s > 0.0f ? s / max_of(wo.z, wi.z) : s;
  const float average = a * (1.0f + PHALANX_FON_2 * r);
  const Vec3 multiple =
      vec3(eon_multiple(m.reflectance.x, average), eon_multiple(m.reflectance.y, average),
           eon_multiple(m.reflectance.z, average));
  // Both losses and their mean share the factor A r, which cancels once.
  const float lost = a * r * fon_loss(wo.z) * fon_loss(wi.z) / (PHALANX_FON_1 - PHALANX_FON_2);
  return m.reflectance * max_of(a * (1.0f + r * s_over_t), 0.0f) + multiple * lost;
}

PHYS BsdfSample sample_rough_diffuse(Material m, Vec3 wo, Vec2 u) {
  BsdfSample s;
  s.wi = square_to_cosine_hemisphere(u);
  s.pdf = pdf_cosine_hemisphere(s.wi.z);
  if (!(s.pdf > 0.0f)) return no_sample();
  s.weight = eon_value(m, wo, s.wi);
  return s;
}

PHYS BsdfValue eval_rough_diffuse(Material m, Vec3 wo, Vec3 wi) {
  if (!(wi.z > 0.0f)) return no_value();
  BsdfValue v;
  v.pdf = pdf_cosine_hemisphere(wi.z);
  v.f_cos = eon_value(m, wo, wi) * v.pdf;
  return v;
}

PHALANX_END
