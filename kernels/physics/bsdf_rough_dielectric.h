// Interface between two dielectrics, rough or smooth, with tints: GGX reflection and transmission.
//
// Walter, Marschner, Li, Torrance, "Microfacet Models for Refraction through Rough Surfaces" (EGSR 2007),
// with visible normals and height-correlated masking. Single scattering: light is lost between
// microfacets. alpha below PHALANX_LEAST_ALPHA is smooth, both lobes are deltas then.
#pragma once
#include "bsdf_types.h"
#include "fresnel.h"
#include "microfacet.h"

PHALANX_BEGIN

/// An index this close to 1 lets light pass straight through: half vectors mean nothing (STABILITY M3).
PHYS bool is_index_matched(float ior) { return abs_of(ior - 1.0f) < 1e-4f; }

/// Index of the far side over that of wo's side.
PHYS float relative_index(Material m, int32 front) { return front != 0 ? m.ior : 1.0f / m.ior; }

/// What an interface does with light, and how the two lobes are chosen: by what they carry, tints included.
struct DielectricLobes {
  float reflectance, transmittance;  // without tints
  float reflects, transmits;         // probabilities
};

PHYS DielectricLobes dielectric_lobes(Material m, float reflectance, float transmittance) {
  const float r = reflectance * max_component(m.specular);
  const float t = transmittance * max_component(m.transmittance);
  DielectricLobes lobes;
  lobes.reflectance = reflectance;
  lobes.transmittance = transmittance;
  lobes.reflects = r > 0.0f ? r / (r + t) : 0.0f;
  lobes.transmits = t > 0.0f ? t / (r + t) : 0.0f;
  return lobes;
}

PHYS bool is_dark(DielectricLobes lobes) { return !(lobes.reflects + lobes.transmits > 0.0f); }
PHYS bool chooses_reflection(DielectricLobes lobes, float u_lobe) {
  return u_lobe < lobes.reflects || !(lobes.transmits > 0.0f);
}

/// The lobes at a surface; cos_t is 0 under total reflection.
PHYS DielectricLobes interface_lobes(Material m, float cos_i, float cos_t, float eta) {
  if (!(cos_t > 0.0f)) return dielectric_lobes(m, 1.0f, 0.0f);
  return dielectric_lobes(m, fresnel_reflectance(cos_i, cos_t, eta),
                          fresnel_transmittance(cos_i, cos_t, eta));
}

/// Solid angle of normals per solid angle of refracted directions (Walter et al., eq. 17):
/// eta^2 cos_t / (wo.h - eta cos_t)^2, without the cancellation.
PHYS float refraction_jacobian(float wo_h, float cos_t, float eta) {
  const float stretch = eta * (wo_h + eta * cos_t) / ((1.0f - eta) * (1.0f + eta));
  return cos_t * stretch * stretch;
}

PHYS BsdfSample sample_rough_dielectric(Material m, int32 front, Vec3 wo, Vec2 u, float u_lobe) {
  BsdfSample s;
  s.pdf = 0.0f;
  if (is_index_matched(m.ior)) {
    s.wi = neg(wo);
    s.weight = m.transmittance;
    return s;
  }
  const bool is_rough = m.alpha >= PHALANX_LEAST_ALPHA;
  const float eta = relative_index(m, front);
  Vec3 h = vec3(0.0f, 0.0f, 1.0f);
  if (is_rough) h = sample_ggx_visible(wo, m.alpha, u);
  const float wo_h = min_of(dot(wo, h), 1.0f);
  if (!(wo_h > 0.0f)) return no_sample();
  const Refraction r = fresnel_dielectric(wo_h, eta);
  const DielectricLobes lobes = interface_lobes(m, wo_h, r.cos_t, eta);
  if (is_dark(lobes)) return no_sample();
  const bool reflects = chooses_reflection(lobes, u_lobe);
  float density;  // of wi, relative to that of h
  if (reflects) {
    s.wi = normalize(h * (2.0f * wo_h) - wo);
    s.weight = m.specular * (lobes.reflectance / lobes.reflects);
    density = lobes.reflects / (4.0f * wo_h);
  } else {
    s.wi = normalize(h * (wo_h / eta - r.cos_t) - wo * (1.0f / eta));
    s.weight = m.transmittance * (lobes.transmittance / (lobes.transmits * eta * eta));
    density = lobes.transmits * refraction_jacobian(wo_h, r.cos_t, eta);
  }
  if ((s.wi.z > 0.0f) != reflects || s.wi.z == 0.0f || is_black(s.weight)) return no_sample();
  if (!is_rough) return s;
  s.pdf = pdf_ggx_visible(wo, h, m.alpha) * density;
  if (!(s.pdf > 0.0f) || !is_finite(s.pdf)) return no_sample();
  const float lambda_o = ggx_lambda(wo, m.alpha);
  s.weight = s.weight * ((1.0f + lambda_o) / (1.0f + lambda_o + ggx_lambda(s.wi, m.alpha)));
  return s;
}

PHYS BsdfValue eval_rough_dielectric(Material m, int32 front, Vec3 wo, Vec3 wi) {
  if (is_index_matched(m.ior) || m.alpha < PHALANX_LEAST_ALPHA || wi.z == 0.0f) return no_value();
  const bool reflects = wi.z > 0.0f;
  const float eta = relative_index(m, front);
  const Vec3 sum = wo + wi * (reflects ? 1.0f : eta);
  const Vec3 along = safe_normalize(sum, vec3(0.0f, 0.0f, 1.0f));
  const Vec3 h = along.z > 0.0f ? along : neg(along);
  const float wo_h = min_of(dot(wo, h), 1.0f);
  if (!(wo_h > 0.0f) || (dot(wi, h) > 0.0f) != reflects) return no_value();
  // From both cosines as they are: close to total reflection Snell's law would lose their digits.
  float cos_t = -dot(wi, h);
  if (reflects) {
    const Refraction r = fresnel_dielectric(wo_h, eta);
    cos_t = r.cos_t;
  }
  const DielectricLobes lobes = interface_lobes(m, wo_h, cos_t, eta);
  const float d = ggx_d(h, m.alpha) / wo.z;
  const float shadowed = d * ggx_g2(wo, wi, m.alpha);
  const float visible = d * ggx_g1(wo, m.alpha);
  BsdfValue v;
  if (reflects) {
    v.f_cos = m.specular * (lobes.reflectance * shadowed * 0.25f);
    v.pdf = lobes.reflects * visible * 0.25f;
  } else {
    const float jacobian = wo_h * refraction_jacobian(wo_h, cos_t, eta);
    v.f_cos = m.transmittance * (lobes.transmittance * shadowed * jacobian / (eta * eta));
    v.pdf = lobes.transmits * visible * jacobian;
  }
  if (!(v.pdf > 0.0f) || !is_finite(v.pdf)) return no_value();
  return v;
}

PHALANX_END
