// Rough metal as in bsdf_conductor.h, with roughness that may differ along the tangent and across, and
// with the light that single scattering loses, if asked for.
//
// Multiple scattering: Kulla and Conty, "Revisiting Physically Based Shading at Imageworks" (SIGGRAPH
// 2017 course): f = (1 - E(wo)) (1 - E(wi)) / (pi (1 - E_avg)) times a colour; reciprocal. The colour
// counts the bounces between microfacets: F_avg^2 E_avg / (1 - F_avg (1 - E_avg)) (Hill 2018).
// E: albedo for white microfacets, from Material.table.
#pragma once
#include "albedo_table.h"
#include "bsdf_conductor.h"

PHALANX_BEGIN

PHYS Vec2 glossy_alpha(Material m) { return vec2(m.alpha_x, m.alpha_y); }

/// Row of the table of albedos for direction w: sqrt(alpha) if the metal is isotropic; else the table is
/// one of azimuths, from the local x (0) to y (1).
PHYS float glossy_row(Vec2 alpha, Vec3 w) {
  if (alpha.x == alpha.y) return square_root(alpha.x);
  const float x = abs_of(w.x) * square_root(alpha.x);
  const float y = abs_of(w.y) * square_root(alpha.y);
  return y > 0.0f ? y / (x + y) : 0.0f;
}

/// Colour of what bounces more than once, one channel.
PHYS float multiple_fresnel(float average_fresnel, float average) {
  return average_fresnel * average_fresnel * average / (1.0f - average_fresnel * (1.0f - average));
}

/// Average of Fresnel's reflectance over the hemisphere: Schlick's in closed form; where eta and k are
/// given, Material.reflectance holds it.
PHYS Vec3 conductor_average_fresnel(Material m) {
  if (m.has_ior != 0) return m.reflectance;
  return m.reflectance + (vec3(1.0f, 1.0f, 1.0f) - m.reflectance) * 0.0476190476f;  // / 21
}

/// The lobe of multiple scattering as seen from wo: its value is colour * (1 - E(wi)).
struct MultipleLobe {
  Vec3 colour;
  float probability;  // with which it is sampled, by cosine
};

PHYS MultipleLobe multiple_lobe(const UNI SceneView &scene, Material m, Vec3 wo) {
  MultipleLobe lobe;
  lobe.colour = vec3(0.0f, 0.0f, 0.0f);
  lobe.probability = 0.0f;
  if (m.compensate == 0) return lobe;
  const float row = glossy_row(glossy_alpha(m), wo);
  const float lost = 1.0f - directional_albedo(scene, m.table, row, wo.z);
  const float average = average_albedo(scene, m.table, row);
  const Vec3 f = conductor_average_fresnel(m);
  const Vec3 multiple = vec3(multiple_fresnel(f.x, average), multiple_fresnel(f.y, average),
                             multiple_fresnel(f.z, average));
  if (!(lost > 0.0f) || !(average < 1.0f)) return lobe;
  lobe.colour = multiple * (lost * PHALANX_INV_PI / (1.0f - average));
  lobe.probability = lost * max_component(multiple);
  return lobe;
}

/// f cos and density; h: half vector. wo.h > 0, wi.z > 0.
PHYS BsdfValue glossy_value(const UNI SceneView &scene, Material m, MultipleLobe lobe, Vec3 wo,
                            Vec3 wi, Vec3 h) {
  const Vec2 alpha = glossy_alpha(m);
  const float d = ggx_d(h, alpha) / (4.0f * wo.z);
  const float wo_h = min_of(dot(wo, h), 1.0f);
  BsdfValue v;
  v.pdf = ggx_g1(wo, alpha) * d;
  v.f_cos = conductor_fresnel(m, wo_h) * (d * ggx_g2(wo, wi, alpha));
  if (lobe.probability > 0.0f) {
    const float lost = 1.0f - directional_albedo(scene, m.table, glossy_row(alpha, wi), wi.z);
    const float p = lobe.probability;
    v.f_cos = v.f_cos + lobe.colour * (max_of(lost, 0.0f) * wi.z);
    v.pdf = (1.0f - p) * v.pdf + p * pdf_cosine_hemisphere(wi.z);
  }
  return v;
}

PHYS BsdfSample sample_glossy_conductor(const UNI SceneView &scene, Material m, Vec3 wo, Vec2 u,
                                        float u_lobe) {
  const MultipleLobe lobe = multiple_lobe(scene, m, wo);
  BsdfSample s;
  Vec3 h;
  if (u_lobe < lobe.probability) {
    s.wi = square_to_cosine_hemisphere(u);
    h = safe_normalize(wo + s.wi, vec3(0.0f, 0.0f, 1.0f));
  } else {
    h = sample_ggx_visible(wo, glossy_alpha(m), u);
    s.wi = normalize(h * (2.0f * dot(wo, h)) - wo);
  }
  if (!(s.wi.z > 0.0f) || !(dot(wo, h) > 0.0f)) return no_sample();
  const BsdfValue v = glossy_value(scene, m, lobe, wo, s.wi, h);
  s.pdf = v.pdf;
  if (!(s.pdf > 0.0f) || !is_finite(s.pdf)) return no_sample();
  s.weight = v.f_cos * (1.0f / v.pdf);
  return s;
}

PHYS BsdfValue eval_glossy_conductor(const UNI SceneView &scene, Material m, Vec3 wo, Vec3 wi) {
  if (!(wi.z > 0.0f)) return no_value();
  const Vec3 h = safe_normalize(wo + wi, vec3(0.0f, 0.0f, 1.0f));
  if (!(dot(wo, h) > 0.0f)) return no_value();
  return glossy_value(scene, m, multiple_lobe(scene, m, wo), wo, wi, h);
}

PHALANX_END
