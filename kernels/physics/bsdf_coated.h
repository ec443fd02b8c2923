// A diffuse base under a dielectric coat: plastic, varnish. The coat is smooth (a delta) or rough (GGX).
//
// What the coat does not reflect reaches the base; part of what the base scatters is reflected back from
// inside, again and again: f = albedo T(wi) T(wo) / (pi eta^2 (1 - albedo R_in)). T = 1 - E with E the
// albedo of the coat's reflection (Material.table over sqrt(alpha)); R_in = 1 - T_avg / eta^2 is what
// reciprocity makes of T. So a white base under any coat reflects all light.
#pragma once
#include "albedo_table.h"
#include "bsdf_types.h"
#include "fresnel.h"
#include "microfacet.h"

PHALANX_BEGIN

PHYS bool has_rough_coat(Material m) { return m.alpha >= PHALANX_LEAST_ALPHA; }
/// Row of the table.
PHYS float coat_row(Material m) { return has_rough_coat(m) ? square_root(m.alpha) : 0.0f; }

/// Share of light from direction mu that enters the coat.
PHYS float coat_entered(const UNI SceneView &scene, Material m, float mu) {
  if (has_rough_coat(m)) {
    return max_of(1.0f - directional_albedo(scene, m.table, coat_row(m), mu), 0.0f);
  }
  const Refraction r = fresnel_dielectric(min_of(mu, 1.0f), m.ior);
  return 1.0f - r.reflectance;
}

/// Both layers as seen from wo.
struct CoatedLobes {
  Vec3 base;          // f of the base is base * T(wi)
  float probability;  // of sampling the coat
};

/// base * T(wi) in one channel, over T(wo) / pi. leaves: share of the light inside that gets out.
PHYS float coated_base(float albedo, float inv_eta2, float leaves) {
  return albedo * inv_eta2 / (1.0f - albedo * (1.0f - leaves));
}

PHYS CoatedLobes coated_lobes(const UNI SceneView &scene, Material m, Vec3 wo) {
  const float entered = coat_entered(scene, m, wo.z);
  const float entered_average = 1.0f - average_albedo(scene, m.table, coat_row(m));
  const float inv_eta2 = 1.0f / (m.ior * m.ior);
  const float leaves = entered_average * inv_eta2;
  const Vec3 base = vec3(coated_base(m.reflectance.x, inv_eta2, leaves),
                         coated_base(m.reflectance.y, inv_eta2, leaves),
                         coated_base(m.reflectance.z, inv_eta2, leaves)) *
                    entered;
  const float coat_albedo = max_component(m.specular) * (1.0f - entered);
  const float base_albedo = max_component(base) * entered_average;
  CoatedLobes lobes;
  lobes.base = base * PHALANX_INV_PI;
  // A base whose share rounds to 0 is sampled nevertheless.
  const float share = coat_albedo > 0.0f ? coat_albedo / (coat_albedo + base_albedo) : 0.0f;
  lobes.probability = min_of(share, 0.999999f);
  return lobes;
}

/// f cos and density without deltas; h: half vector. wo.h > 0, wi.z > 0.
PHYS BsdfValue coated_value(const UNI SceneView &scene, Material m, CoatedLobes lobes, Vec3 wo,
                            Vec3 wi, Vec3 h) {
  const float p = lobes.probability;
  BsdfValue v;
  v.f_cos = lobes.base * (coat_entered(scene, m, wi.z) * wi.z);
  v.pdf = (1.0f - p) * pdf_cosine_hemisphere(wi.z);
  if (has_rough_coat(m)) {
    const Refraction r = fresnel_dielectric(min_of(dot(wo, h), 1.0f), m.ior);
    const float d = ggx_d(h, m.alpha) / (4.0f * wo.z);
    v.f_cos = v.f_cos + m.specular * (r.reflectance * d * ggx_g2(wo, wi, m.alpha));
    v.pdf = v.pdf + p * d * ggx_g1(wo, m.alpha);
  }
  return v;
}

PHYS BsdfSample sample_coated(const UNI SceneView &scene, Material m, Vec3 wo, Vec2 u,
                              float u_lobe) {
  const CoatedLobes lobes = coated_lobes(scene, m, wo);
  const float p = lobes.probability;
  const bool is_coat = u_lobe < p;
  BsdfSample s;
  if (is_coat && !has_rough_coat(m)) {
    const Refraction r = fresnel_dielectric(min_of(wo.z, 1.0f), m.ior);
    s.wi = vec3(-wo.x, -wo.y, wo.z);
    s.weight = m.specular * (r.reflectance / p);
    s.pdf = 0.0f;
    return s;
  }
  Vec3 h;
  if (is_coat) {
    h = sample_ggx_visible(wo, m.alpha, u);
    s.wi = normalize(h * (2.0f * dot(wo, h)) - wo);
  } else {
    s.wi = square_to_cosine_hemisphere(u);
    h = safe_normalize(wo + s.wi, vec3(0.0f, 0.0f, 1.0f));
  }
  if (!(s.wi.z > 0.0f) || !(dot(wo, h) > 0.0f)) return no_sample();
  const BsdfValue v = coated_value(scene, m, lobes, wo, s.wi, h);
  s.pdf = v.pdf;
  if (!(s.pdf > 0.0f) || !is_finite(s.pdf)) return no_sample();
  s.weight = v.f_cos * (1.0f / v.pdf);
  return s;
}

PHYS BsdfValue eval_coated(const UNI SceneView &scene, Material m, Vec3 wo, Vec3 wi) {
  if (!(wi.z > 0.0f)) return no_value();
  const Vec3 h = safe_normalize(wo + wi, vec3(0.0f, 0.0f, 1.0f));
  if (!(dot(wo, h) > 0.0f)) return no_value();
  return coated_value(scene, m, coated_lobes(scene, m, wo), wo, wi, h);
}

PHALANX_END
