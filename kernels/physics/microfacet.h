// The GGX microfacet distribution (Trowbridge-Reitz) with its visible normals, isotropic and anisotropic.
//
// Directions are in the local frame, z along the macroscopic normal. alpha in [1e-3, 1]; where it is a
// Vec2, it is the roughness along the local x and along y.
// Sources: Walter et al. 2007; Heitz, "Understanding the Masking-Shadowing Function" (JCGT 3:2,
// 2014); Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical Caps" (HPG 2023).
#pragma once
#include "warp.h"

PHALANX_BEGIN

/// Narrower lobes than this are more than floats can describe: what may be smooth is smooth below.
#define PHALANX_LEAST_ALPHA 1e-3f

/// Density of normals D(m) per solid angle, m.z >= 0. In the form (1 - c^2) + alpha^2 c^2 with
/// 1 - c^2 taken from x and y, which keeps its digits down to alpha = 1e-4 (STABILITY M1).
PHYS float ggx_d(Vec3 m, float alpha) {
  const float a2 = alpha * alpha;
  const float t = m.x * m.x + m.y * m.y + a2 * m.z * m.z;
  return a2 * PHALANX_INV_PI / (t * t);
}

/// Smith's Lambda for direction w, w.z > 0.
PHYS float ggx_lambda(Vec3 w, float alpha) {
  const float tan2 = (w.x * w.x + w.y * w.y) / (w.z * w.z);
  return 0.5f * (square_root(1.0f + alpha * alpha * tan2) - 1.0f);
}

/// Masking of wo alone, in (0, 1].
PHYS float ggx_g1(Vec3 wo, float alpha) { return 1.0f / (1.0f + ggx_lambda(wo, alpha)); }

/// Height-correlated masking and shadowing, in (0, 1].
PHYS float ggx_g2(Vec3 wo, Vec3 wi, float alpha) {
  return 1.0f / (1.0f + ggx_lambda(wo, alpha) + ggx_lambda(wi, alpha));
}

/// Visible-normal sampling. wo: unit, wo.z > 0. u: two uniforms in [0,1).
/// Returns the unit microfacet normal, z >= 0, with density pdf_ggx_visible().
PHYS Vec3 sample_ggx_visible(Vec3 wo, float alpha, Vec2 u) {
  const Vec3 w = normalize(vec3(alpha * wo.x, alpha * wo.y, wo.z));
  const float z = (1.0f - u.x) * (1.0f + w.z) - w.z;
  const float r = safe_sqrt(1.0f - z * z);
  const SinCos sc = sincos_turns(u.y);
  const Vec3 h = vec3(r * sc.cosine, r * sc.sine, z) + w;
  return safe_normalize(vec3(alpha * h.x, alpha * h.y, max_of(h.z, 0.0f)), vec3(0.0f, 0.0f, 1.0f));
}

/// Density of sample_ggx_visible per solid angle of m: G1(wo) max(wo.m, 0) D(m) / wo.z.
PHYS float pdf_ggx_visible(Vec3 wo, Vec3 m, float alpha) {
  return ggx_g1(wo, alpha) * max_of(dot(wo, m), 0.0f) * ggx_d(m, alpha) / wo.z;
}

// ---- anisotropic: the same, stretched by alpha.x and alpha.y --------------------------------------

/// Density of normals D(m) per solid angle, m.z >= 0.
PHYS float ggx_d(Vec3 m, Vec2 alpha) {
  const float x = m.x / alpha.x;
  const float y = m.y / alpha.y;
  const float t = x * x + y * y + m.z * m.z;
  return PHALANX_INV_PI / (alpha.x * alpha.y * t * t);
}

/// Smith's Lambda for direction w, w.z > 0.
PHYS float ggx_lambda(Vec3 w, Vec2 alpha) {
  const float x = alpha.x * w.x;
  const float y = alpha.y * w.y;
  return 0.5f * (square_root(1.0f + (x * x + y * y) / (w.z * w.z)) - 1.0f);
}

/// Masking of wo alone, in (0, 1].
PHYS float ggx_g1(Vec3 wo, Vec2 alpha) { return 1.0f / (1.0f + ggx_lambda(wo, alpha)); }

/// Height-correlated masking and shadowing, in (0, 1].
PHYS float ggx_g2(Vec3 wo, Vec3 wi, Vec2 alpha) {
  return 1.0f / (1.0f + ggx_lambda(wo, alpha) + ggx_lambda(wi, alpha));
}

/// Visible-normal sampling. wo: unit, wo.z > 0. u: two uniforms in [0,1).
/// Returns the unit microfacet normal, z >= 0, with density pdf_ggx_visible().
PHYS Vec3 sample_ggx_visible(Vec3 wo, Vec2 alpha, Vec2 u) {
  const Vec3 w = normalize(vec3(alpha.x * wo.x, alpha.y * wo.y, wo.z));
  const float z = (1.0f - u.x) * (1.0f + w.z) - w.z;
  const float r = safe_sqrt(1.0f - z * z);
  const SinCos sc = sincos_turns(u.y);
  const Vec3 h = vec3(r * sc.cosine, r * sc.sine, z) + w;
  return safe_normalize(vec3(alpha.x * h.x, alpha.y * h.y, max_of(h.z, 0.0f)),
                        vec3(0.0f, 0.0f, 1.0f));
}

/// Density of sample_ggx_visible per solid angle of m: G1(wo) max(wo.m, 0) D(m) / wo.z.
PHYS float pdf_ggx_visible(Vec3 wo, Vec3 m, Vec2 alpha) {
  return ggx_g1(wo, alpha) * max_of(dot(wo, m), 0.0f) * ggx_d(m, alpha) / wo.z;
}

PHALANX_END
