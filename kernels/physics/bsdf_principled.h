// glTF 2.0's metallic-roughness material with clearcoat, sheen, transmission, specular and ior
// (KHR_materials_*), put together so that it is reciprocal and never gains energy:
//
//   coat over sheen over  metallic * metal + (1 - metallic) * ((1 - transmission) * plastic + transmission * glass)
//
// metal: GGX with Schlick's F. plastic: GGX over diffuse. glass: GGX reflection and refraction, single
// scattering. The three share their microfacets. Light that the GGX of metal and plastic does not reflect
// goes on as in Kulla and Conty 2017: (1 - E(wo)) (1 - E(wi)) / (pi (1 - E_avg)) times a colour, E being the
// directional albedo of the GGX. What lies under a layer is scaled by the smaller of 1 - E(wo) and
// 1 - E(wi), E of the layer (as KHR_materials_sheen does; for the coat glTF takes 1 - F(wo), which is not
// reciprocal). Coat and sheen are on the outer side, of opaque surfaces on both.
//
// Tables, one after the other from Material.table (src/scene/albedo_tables.h): GGX with F = 1, GGX with
// F = (1 - cos)^5, both over sqrt(alpha); sheen over sqrt(sheen_alpha).
#pragma once
#include "albedo_table.h"
#include "bsdf_rough_dielectric.h"
#include "warp.h"

PHALANX_BEGIN

#define PHALANX_COAT_F0 0.04f  // index 1.5
#define PHALANX_LEAST_SHEEN_ALPHA 0.01f

PHYS float principled_alpha(float alpha) { return clamp_to(alpha, PHALANX_LEAST_ALPHA, 1.0f); }

// ---- directional albedos --------------------------------------------------------------------------

/// Albedo of GGX with Schlick's Fresnel term is f0 * at_f0 + f90 * at_f90.
struct SchlickAlbedo {
  float at_f0, at_f90;
};

PHYS SchlickAlbedo schlick_albedo(const UNI SceneView &scene, int32 table, float alpha, float mu) {
  const float row = square_root(alpha);
  SchlickAlbedo a;
  a.at_f90 = directional_albedo(scene, table + PHALANX_ALBEDO_FLOATS, row, mu);
  a.at_f0 = max_of(directional_albedo(scene, table, row, mu) - a.at_f90, 0.0f);
  return a;
}

PHYS SchlickAlbedo average_schlick_albedo(const UNI SceneView &scene, int32 table, float alpha) {
  const float row = square_root(alpha);
  SchlickAlbedo a;
  a.at_f90 = average_albedo(scene, table + PHALANX_ALBEDO_FLOATS, row);
  a.at_f0 = max_of(average_albedo(scene, table, row) - a.at_f90, 0.0f);
  return a;
}

/// Share of light along direction mu that does not get to what is below a layer with this albedo.
PHYS float albedo_of(SchlickAlbedo a, float f0, float f90) {
  return min_of(f0 * a.at_f0 + f90 * a.at_f90, 1.0f);
}

// ---- coat and sheen -------------------------------------------------------------------------------

/// What the layers on top do to light along one direction. On the inner side they are not met.
struct TopLayers {
  float coat, sheen;  // their albedos; sheen for white
  float sheen_scale;  // what keeps narrow sheen from reflecting more than it gets
};

PHYS TopLayers no_top_layers() {
  TopLayers t;
  t.coat = 0.0f;
  t.sheen = 0.0f;
  t.sheen_scale = 1.0f;
  return t;
}

PHYS float sheen_alpha(Material m) {
  return clamp_to(m.sheen_alpha, PHALANX_LEAST_SHEEN_ALPHA, 1.0f);
}

PHYS TopLayers top_layers(const UNI SceneView &scene, Material m, float mu) {
  TopLayers t = no_top_layers();
  if (m.clearcoat > 0.0f) {
    const float alpha = principled_alpha(m.clearcoat_alpha);
    t.coat =
        m.clearcoat * albedo_of(schlick_albedo(scene, m.table, alpha, mu), PHALANX_COAT_F0, 1.0f);
  }
  if (!is_black(m.sheen)) {
    const float e = directional_albedo(scene, m.table + 2 * PHALANX_ALBEDO_FLOATS,
                                       square_root(sheen_alpha(m)), mu);
    t.sheen_scale = 1.0f / max_of(e, 1.0f);
    t.sheen = min_of(e, 1.0f);
  }
  return t;
}

/// Share of light that the coat lets through on its way from or to both directions.
PHYS float below_coat(TopLayers o, TopLayers i) { return 1.0f - max_of(o.coat, i.coat); }
PHYS float below_sheen(Material m, TopLayers o, TopLayers i) {
  return 1.0f - max_component(m.sheen) * max_of(o.sheen, i.sheen);
}

/// f of white sheen. Estevez and Kulla 2017 ("Charlie", eq. 2) with the visibility term of Neubelt and
/// Pettineo 2013. h: unit half vector.
PHYS float sheen_value(float alpha, float cos_o, float cos_i, Vec3 h) {
  const float sin2 = min_of(h.x * h.x + h.y * h.y, 1.0f);
  const float inverse = 1.0f / alpha;
  const float d = (2.0f + inverse) * 0.159154943091895f * pow_of(sin2, 0.5f * inverse);
  return d / (4.0f * (cos_o + cos_i - cos_o * cos_i));
}

// ---- reflectances of the base ---------------------------------------------------------------------

/// Reflectance of the plastic and of the glass along and across the microfacets, KHR_materials_specular.
struct Specular {
  Vec3 f0;
  float f90;
  float eta;      // of the glass: index on the far side over the near one
  float f0_bare;  // of the index alone
};

PHYS Specular principled_specular(Material m, int32 front) {
  const float r = (m.ior - 1.0f) / (m.ior + 1.0f);
  Specular s;
  s.f0_bare = r * r;
  s.f90 = m.specular_level;
  s.f0 = vec3(min_of(s.f0_bare * m.specular.x, 1.0f), min_of(s.f0_bare * m.specular.y, 1.0f),
              min_of(s.f0_bare * m.specular.z, 1.0f)) *
         m.specular_level;
  s.eta = relative_index(m, front);
  return s;
}

/// Between f0 and f90 by t in [0, 1].
PHYS Vec3 fresnel_between(Vec3 f0, float f90, float t) {
  return f0 * (1.0f - t) + vec3(f90, f90, f90) * t;
}

/// What microfacets do with light that meets them at cosine cos_i: all three materials by their shares.
struct FacetScattering {
  Vec3 reflected, transmitted;
  float cos_t;        // of the refracted direction
  float probability;  // of sampling reflection
};

/// cos_t: of the refracted direction, 0 under total reflection.
PHYS FacetScattering facet_scattering(Material m, Specular s, float cos_i, float cos_t) {
  const float x = clamp_to(1.0f - cos_i, 0.0f, 1.0f);
  const float x5 = x * x * x * x * x;
  const float dielectric = 1.0f - m.metallic;
  float reflectance = 1.0f;
  float transmittance = 0.0f;
  if (cos_t > 0.0f) {
    reflectance = fresnel_reflectance(cos_i, cos_t, s.eta);
    transmittance = fresnel_transmittance(cos_i, cos_t, s.eta);
  }
  const float t = clamp_to((reflectance - s.f0_bare) / (1.0f - s.f0_bare), 0.0f, 1.0f);
  const Vec3 glass = fresnel_between(s.f0, s.f90, t);
  // 1 - glass, which keeps its digits close to total reflection.
  const float rest = clamp_to(transmittance / (1.0f - s.f0_bare), 0.0f, 1.0f);
  const float edge = (1.0f - s.f90) * t;
  const Vec3 passes = (vec3(1.0f, 1.0f, 1.0f) - s.f0) * rest + vec3(edge, edge, edge);
  FacetScattering f;
  f.reflected =
      fresnel_between(m.reflectance, 1.0f, x5) * m.metallic +
      (fresnel_between(s.f0, s.f90, x5) * (1.0f - m.transmission) + glass * m.transmission) *
          dielectric;
  f.transmitted = m.reflectance * passes * (m.transmission * dielectric);
  f.cos_t = cos_t;
  if (!(cos_t > 0.0f)) f.transmitted = vec3(0.0f, 0.0f, 0.0f);
  const float reflected = max_component(f.reflected);
  const float transmitted = max_component(f.transmitted);
  f.probability = transmitted > 0.0f ? reflected / (reflected + transmitted) : 1.0f;
  return f;
}

/// The same where the refracted direction follows from Snell's law.
PHYS FacetScattering facet_scattering(Material m, Specular s, float cos_i) {
  const Refraction r = fresnel_dielectric(cos_i, s.eta);
  return facet_scattering(m, s, cos_i, r.cos_t);
}

// ---- lobes as seen from wo ------------------------------------------------------------------------

struct PrincipledLobes {
  Specular specular;
  TopLayers top;
  int32 is_outer;     // 1: coat and sheen are on wo's side
  float specular_f0;  // largest component of specular.f0
  Vec3 diffuse,
      multiple;  // times 1 - E(wi): f of the diffuse base, and of the metal's multiple scattering
  float p_coat, p_sheen, p_broad,
      p_facets;  // probabilities of sampling, sum 1; broad: diffuse and multiple
};

/// Colour of light that metal microfacets scatter more than once (Hill 2018), one channel of F0.
PHYS float multiple_schlick(float f0, float average) {
  const float f = f0 + (1.0f - f0) * 0.0476190476f;  // average of Schlick's term: 1 / 21
  return f * f * average / (1.0f - f * (1.0f - average));
}

PHYS PrincipledLobes principled_lobes(const UNI SceneView &scene, Material m, int32 front,
                                      Vec3 wo) {
  const float alpha = principled_alpha(m.alpha);
  const float dielectric = 1.0f - m.metallic;
  const float plastic = dielectric * (1.0f - m.transmission);
  const float glass = dielectric * m.transmission;
  PrincipledLobes l;
  l.specular = principled_specular(m, front);
  l.specular_f0 = max_component(l.specular.f0);
  l.is_outer = front != 0 || glass == 0.0f ? 1 : 0;
  l.top = no_top_layers();
  if (l.is_outer != 0) l.top = top_layers(scene, m, wo.z);

  const SchlickAlbedo e = schlick_albedo(scene, m.table, alpha, wo.z);
  const SchlickAlbedo average = average_schlick_albedo(scene, m.table, alpha);
  const float left = 1.0f - albedo_of(e, l.specular_f0, l.specular.f90);
  const float left_average = 1.0f - albedo_of(average, l.specular_f0, l.specular.f90);
  const float left_white = 1.0f - albedo_of(e, 1.0f, 1.0f);
  const float white_average = albedo_of(average, 1.0f, 1.0f);
  const Vec3 multiple = vec3(multiple_schlick(m.reflectance.x, white_average),
                             multiple_schlick(m.reflectance.y, white_average),
                             multiple_schlick(m.reflectance.z, white_average)) *
                        m.metallic;
  l.diffuse = vec3(0.0f, 0.0f, 0.0f);
  l.multiple = vec3(0.0f, 0.0f, 0.0f);
  if (left_average > 0.0f)
    l.diffuse = m.reflectance * (plastic * left * PHALANX_INV_PI / left_average);
  if (white_average < 1.0f)
    l.multiple = multiple * (left_white * PHALANX_INV_PI / (1.0f - white_average));

  // Each lobe in proportion to its albedo; the glass has all that it does not absorb.
  const float below = below_coat(l.top, l.top) * below_sheen(m, l.top, l.top);
  const Vec3 f0 = m.reflectance * m.metallic + l.specular.f0 * plastic;
  const float f90 = m.metallic + l.specular.f90 * plastic;
  const FacetScattering facets = facet_scattering(m, l.specular, min_of(wo.z, 1.0f));
  const float w_coat = l.top.coat;
  const float w_sheen = (1.0f - l.top.coat) * max_component(m.sheen) * l.top.sheen;
  const float w_broad =
      below * max_component(m.reflectance * (plastic * left) + multiple * left_white);
  const float w_facets =
      below * (max_component(f0 * e.at_f0) + f90 * e.at_f90 +
               max_component(facets.reflected) * glass + max_component(facets.transmitted));
  const float sum = w_coat + w_sheen + w_broad + w_facets;
  const float scale = sum > 0.0f ? 1.0f / sum : 0.0f;
  l.p_coat = w_coat * scale;
  l.p_sheen = w_sheen * scale;
  l.p_broad = w_broad * scale;
  l.p_facets = w_facets * scale;
  return l;
}

// ---- value and density ----------------------------------------------------------------------------

/// f cos and density of reflection, h: half vector; wi.z > 0.
PHYS BsdfValue principled_reflected(const UNI SceneView &scene, Material m, PrincipledLobes l,
                                    Vec3 wo, Vec3 wi, Vec3 h) {
  const float alpha = principled_alpha(m.alpha);
  const float wo_h = clamp_to(dot(wo, h), 0.0f, 1.0f);
  TopLayers top = no_top_layers();
  if (l.is_outer != 0) top = top_layers(scene, m, wi.z);
  const SchlickAlbedo e = schlick_albedo(scene, m.table, alpha, wi.z);

  const FacetScattering facets = facet_scattering(m, l.specular, wo_h);
  const float d = ggx_d(h, alpha) / (4.0f * wo.z);
  const float left = 1.0f - albedo_of(e, l.specular_f0, l.specular.f90);
  const float left_white = 1.0f - albedo_of(e, 1.0f, 1.0f);
  BsdfValue v;
  v.f_cos = facets.reflected * (d * ggx_g2(wo, wi, alpha)) +
            (l.diffuse * left + l.multiple * left_white) * wi.z;
  v.pdf = l.p_facets * facets.probability * d * ggx_g1(wo, alpha) +
          l.p_broad * pdf_cosine_hemisphere(wi.z);
  if (l.is_outer == 0) return v;

  if (!is_black(m.sheen)) {
    const float sheen = sheen_value(sheen_alpha(m), wo.z, wi.z, h) *
                        min_of(l.top.sheen_scale, top.sheen_scale) * wi.z;
    v.f_cos = v.f_cos * below_sheen(m, l.top, top) + m.sheen * sheen;
    v.pdf = v.pdf + l.p_sheen * 0.159154943091895f;
  }
  if (m.clearcoat > 0.0f) {
    const float coat_alpha = principled_alpha(m.clearcoat_alpha);
    const float coat_d = ggx_d(h, coat_alpha) / (4.0f * wo.z);
    const Vec3 f = fresnel_schlick(wo_h, vec3(PHALANX_COAT_F0, PHALANX_COAT_F0, PHALANX_COAT_F0));
    v.f_cos =
        v.f_cos * below_coat(l.top, top) + f * (m.clearcoat * coat_d * ggx_g2(wo, wi, coat_alpha));
    v.pdf = v.pdf + l.p_coat * coat_d * ggx_g1(wo, coat_alpha);
  }
  return v;
}

/// Share of light through the layers on top, on its way through the glass from or to wi.
PHYS float through_top(const UNI SceneView &scene, Material m, PrincipledLobes l, Vec3 wi) {
  TopLayers top = l.top;
  if (l.is_outer == 0) top = top_layers(scene, m, abs_of(wi.z));
  return below_coat(top, top) * below_sheen(m, top, top);
}

/// f cos and density of refraction, h: microfacet normal on wo's side; wi.z < 0, facets as met by wo.
PHYS BsdfValue principled_transmitted(const UNI SceneView &scene, Material m, PrincipledLobes l,
                                      FacetScattering facets, Vec3 wo, Vec3 wi, Vec3 h) {
  const float alpha = principled_alpha(m.alpha);
  const float wo_h = dot(wo, h);
  const float eta = l.specular.eta;
  const float d = ggx_d(h, alpha) * wo_h * refraction_jacobian(wo_h, facets.cos_t, eta) / wo.z;
  BsdfValue v;
  v.f_cos =
      facets.transmitted * (through_top(scene, m, l, wi) * d * ggx_g2(wo, wi, alpha) / (eta * eta));
  v.pdf = l.p_facets * (1.0f - facets.probability) * d * ggx_g1(wo, alpha);
  return v;
}

PHYS BsdfSample principled_sample(BsdfValue v, Vec3 wi) {
  if (!(v.pdf > 0.0f) || !is_finite(v.pdf)) return no_sample();
  BsdfSample s;
  s.wi = wi;
  s.pdf = v.pdf;
  s.weight = v.f_cos * (1.0f / v.pdf);
  if (!all_finite(s.weight)) return no_sample();
  return s;
}

/// Refraction at the microfacet h; straight on where the indices are the same.
PHYS BsdfSample sample_principled_refraction(const UNI SceneView &scene, Material m,
                                             PrincipledLobes l, FacetScattering facets, Vec3 wo,
                                             Vec3 h) {
  if (is_index_matched(m.ior)) {
    BsdfSample s;
    s.wi = neg(wo);
    s.pdf = 0.0f;
    s.weight = facets.transmitted *
               (through_top(scene, m, l, s.wi) / (l.p_facets * (1.0f - facets.probability)));
    return s;
  }
  const float eta = l.specular.eta;
  const Vec3 wi = normalize(h * (dot(wo, h) / eta - facets.cos_t) - wo * (1.0f / eta));
  if (!(wi.z < 0.0f)) return no_sample();
  return principled_sample(principled_transmitted(scene, m, l, facets, wo, wi, h), wi);
}

PHYS BsdfSample sample_principled(const UNI SceneView &scene, Material m, int32 front, Vec3 wo,
                                  Vec2 u, float u_lobe) {
  const PrincipledLobes l = principled_lobes(scene, m, front, wo);
  const float p_top = l.p_coat + l.p_sheen;
  const bool is_coat = u_lobe < l.p_coat;
  const bool is_facets = u_lobe >= p_top + l.p_broad && l.p_facets > 0.0f;
  Vec3 wi;
  Vec3 h;
  if (is_coat || is_facets) {
    h = sample_ggx_visible(wo, principled_alpha(is_coat ? m.clearcoat_alpha : m.alpha), u);
    const float wo_h = min_of(dot(wo, h), 1.0f);
    if (!(wo_h > 0.0f)) return no_sample();
    if (is_facets) {
      const FacetScattering facets = facet_scattering(m, l.specular, wo_h);
      const float rest = u_lobe - (p_top + l.p_broad);
      if (facets.probability < 1.0f && rest >= facets.probability * l.p_facets)
        return sample_principled_refraction(scene, m, l, facets, wo, h);
    }
    wi = normalize(h * (2.0f * wo_h) - wo);
  } else {
    wi = square_to_cosine_hemisphere(u);
    if (u_lobe < p_top) {
      wi = square_to_sphere(u);
      wi.z = abs_of(wi.z);
    }
    h = safe_normalize(wo + wi, vec3(0.0f, 0.0f, 1.0f));
  }
  if (!(wi.z > 0.0f)) return no_sample();
  return principled_sample(principled_reflected(scene, m, l, wo, wi, h), wi);
}

PHYS BsdfValue eval_principled(const UNI SceneView &scene, Material m, int32 front, Vec3 wo,
                               Vec3 wi) {
  const bool reflects = wi.z > 0.0f;
  if (wi.z == 0.0f) return no_value();
  const PrincipledLobes l = principled_lobes(scene, m, front, wo);
  BsdfValue v;
  if (reflects) {
    const Vec3 h = safe_normalize(wo + wi, vec3(0.0f, 0.0f, 1.0f));
    v = principled_reflected(scene, m, l, wo, wi, h);
  } else {
    if (is_index_matched(m.ior) || !(m.transmission > 0.0f)) return no_value();
    const Vec3 along = safe_normalize(wo + wi * l.specular.eta, vec3(0.0f, 0.0f, 1.0f));
    const Vec3 h = along.z > 0.0f ? along : neg(along);
    const float wo_h = min_of(dot(wo, h), 1.0f);
    if (!(wo_h > 0.0f) || dot(wi, h) > 0.0f) return no_value();
    // From both cosines as they are: close to total reflection Snell's law would lose their digits.
    const FacetScattering facets = facet_scattering(m, l.specular, wo_h, -dot(wi, h));
    v = principled_transmitted(scene, m, l, facets, wo, wi, h);
  }
  if (!(v.pdf > 0.0f) || !is_finite(v.pdf)) return no_value();
  return v;
}

PHALANX_END
