// The Phong and Blinn-Phong lobes of "dirt" scenes: f cos = reflectance times the density of sampling.
//
// There is no cosine in them, so neither is reciprocal. What is drawn below the surface is lost: albedos
// are at most the reflectance, less at grazing angles and small exponents.
#pragma once
#include "bsdf_types.h"
#include "warp.h"

PHALANX_BEGIN

/// Directions around +z with density (n + 1) / (2 pi) cos^n, n = exponent in [0, 1e6].
PHYS Vec3 square_to_cosine_power(Vec2 u, float exponent) {
  const float h = one_minus_exp(neg_log_1m(u.x) / (exponent + 1.0f));  // 1 - cos
  const float r = safe_sqrt(h * (2.0f - h));
  const SinCos sc = sincos_turns(u.y);
  return vec3(r * sc.cosine, r * sc.sine, 1.0f - h);
}
/// Its density per solid angle, given 1 - cos: high powers need digits that the cosine has lost.
PHYS float pdf_cosine_power(float one_minus_cos, float exponent) {
  if (!(one_minus_cos < 1.0f)) return 0.0f;
  return (exponent + 1.0f) * 0.159154943091895f * exp_of(-exponent * neg_log_1m(one_minus_cos));
}

PHYS BsdfValue phong_value(Material m, float pdf) {
  BsdfValue v;
  v.pdf = pdf;
  v.f_cos = m.reflectance * pdf;
  return v;
}

PHYS BsdfSample phong_sample(Material m, Vec3 wi, float pdf) {
  if (!(wi.z > 0.0f) || !(pdf > 0.0f) || !is_finite(pdf)) return no_sample();
  BsdfSample s;
  s.wi = wi;
  s.weight = m.reflectance;
  s.pdf = pdf;
  return s;
}

/// Phong: cos^n around the mirror direction.
PHYS float pdf_phong(Material m, Vec3 wo, Vec3 wi) {
  const Vec3 off = wi - vec3(-wo.x, -wo.y, wo.z);
  return pdf_cosine_power(0.5f * length_squared(off), m.exponent);
}

PHYS BsdfSample sample_phong(Material m, Vec3 wo, Vec2 u) {
  const Frame around_mirrored = make_frame(vec3(-wo.x, -wo.y, wo.z));
  const Vec3 wi = normalize(to_world(around_mirrored, square_to_cosine_power(u, m.exponent)));
  return phong_sample(m, wi, pdf_phong(m, wo, wi));
}

PHYS BsdfValue eval_phong(Material m, Vec3 wo, Vec3 wi) {
  if (!(wi.z > 0.0f)) return no_value();
  return phong_value(m, pdf_phong(m, wo, wi));
}

/// Blinn-Phong: half vectors h with density (n + 1) / (2 pi) cos^n around the normal.
PHYS float pdf_blinn_phong(Material m, Vec3 wo, Vec3 h) {
  const float wo_h = dot(wo, h);
  if (!(wo_h > 0.0f)) return 0.0f;
  const float one_minus_cos = (h.x * h.x + h.y * h.y) / (1.0f + h.z);
  return pdf_cosine_power(one_minus_cos, m.exponent) / (4.0f * wo_h);
}

PHYS BsdfSample sample_blinn_phong(Material m, Vec3 wo, Vec2 u) {
  const Vec3 h = square_to_cosine_power(u, m.exponent);
  const Vec3 wi = normalize(h * (2.0f * dot(wo, h)) - wo);
  return phong_sample(m, wi, pdf_blinn_phong(m, wo, h));
}

PHYS BsdfValue eval_blinn_phong(Material m, Vec3 wo, Vec3 wi) {
  if (!(wi.z > 0.0f)) return no_value();
  const Vec3 h = safe_normalize(wo + wi, vec3(0.0f, 0.0f, 1.0f));
  const float pdf = pdf_blinn_phong(m, wo, h);
  if (!is_finite(pdf)) return no_value();
  return phong_value(m, pdf);
}

PHALANX_END
