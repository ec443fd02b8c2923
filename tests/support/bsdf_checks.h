// Does a kind of material keep its promises? Checks of sample_bsdf and eval_bsdf that know no model.
//
//   const Seen<kVelvet> velvet = {material};
//   check_sampling(velvet, wo, UpperDirections{}, num_samples());
//   CHECK(worst_difference(velvet) < 1e-4);
//   CHECK(worst_asymmetry(velvet) < 1e-4);
//   CHECK(albedo(velvet, wo, 100000).mean() <= 1);
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../../kernels/physics/bsdf.h"
#include "local_directions.h"
#include "materials.h"
#include "normal_space.h"
#include "random.h"
#include "statistics.h"

namespace phalanx::test {

/// A material, seen from its front or from behind. `scene` holds tables, if the kind needs any.
template <int Kind>
struct Seen {
  Material m;
  int32 front = 1;
  SceneView scene = {};

  BsdfSample sample(Vec3 wo, Random &random) const {
    const Vec2 u = random.square();
    return sample_bsdf<Kind>(scene, m, front, wo, u, random.unit());
  }
  BsdfValue eval(Vec3 wo, Vec3 wi) const { return eval_bsdf<Kind>(scene, m, front, wo, wi); }
  Seen from_behind() const { return {m, 1 - front, scene}; }
  /// Far index of refraction over near one, for kinds that refract: their transmitted radiance is scaled by
  /// its inverse square.
  double eta() const {
    if (Kind != kDielectric && Kind != kRoughDielectric && Kind != kPrincipled) return 1;
    return static_cast<double>(front != 0 ? m.ior : 1.0f / m.ior);
  }
};

inline Vec3 direction(double cosine, double phi) {
  const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0));
  return vec3(static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
              static_cast<float>(cosine));
}
/// Random, above the surface.
inline Vec3 upper(Random &random, float least = 1e-3f) {
  Vec3 w = random.direction();
  w.z = std::max(std::fabs(w.z), least);
  return normalize(w);
}
inline Vec3 mirrored_below(Vec3 w) { return vec3(w.x, w.y, -w.z); }
/// |a - b| / |b|, 0 for equal numbers.
inline double relative(float a, float b) {
  if (b == 0.0f) return std::fabs(static_cast<double>(a));
  return relative_error(static_cast<double>(a), static_cast<double>(b));
}

// ---- where samples are counted ------------------------------------------------------------------

using Place = NormalSpace::Place;

/// Cosine and azimuth of wi, above the surface.
struct UpperDirections {
  Grid grid(int nx, int ny) const { return hemisphere_grid(nx, ny); }
  bool find(Vec3, Vec3 wi, Place &place) const {
    place = {static_cast<double>(wi.z),
             azimuth(static_cast<double>(wi.x), static_cast<double>(wi.y))};
    return true;
  }
  template <typename Eval>
  double density(const Eval &eval, Vec3, double cosine, double phi) const {
    return static_cast<double>(eval(direction(cosine, phi)).pdf);
  }
};
/// Both sides, with cells that are fine at the horizon: the root of the cosine with its sign, and azimuth.
struct AllDirections {
  Grid grid(int nx, int ny) const { return sphere_grid(nx, ny); }
  bool find(Vec3, Vec3 wi, Place &place) const {
    const double z = static_cast<double>(wi.z);
    place = {std::copysign(std::sqrt(std::fabs(z)), z),
             azimuth(static_cast<double>(wi.x), static_cast<double>(wi.y))};
    return true;
  }
  template <typename Eval>
  double density(const Eval &eval, Vec3, double root, double phi) const {
    const double size = std::fabs(root);
    return static_cast<double>(eval(direction(root * size, phi)).pdf) * 2 * size;
  }
};
/// Stretched half vector of reflected directions: for lobes sharper than the cells. Transmitted ones
/// are not counted.
struct ReflectingNormals {
  NormalSpace normals;
  Grid grid(int nx, int ny) const { return hemisphere_grid(nx, ny); }
  bool find(Vec3 wo, Vec3 wi, Place &place) const {
    if (wi.z <= 0) return false;
    place = normals.place_half(wo, wi);
    return true;
  }
  template <typename Eval>
  double density(const Eval &eval, Vec3 wo, double cosine, double phi) const {
    const NormalSpace::Normal h = normals.normal(cosine, phi);
    const float wo_h = dot(wo, h.direction);
    const Vec3 wi = h.direction * (2 * wo_h) - wo;
    if (!(wo_h > 0) || !(wi.z > 0)) return 0;
    return static_cast<double>(eval(wi).pdf) * 4 * static_cast<double>(wo_h) * h.jacobian;
  }
};
/// Stretched normal of refracted directions; reflected ones are not counted. eta: far over near index.
struct RefractingNormals {
  NormalSpace normals;
  double eta;
  Grid grid(int nx, int ny) const { return hemisphere_grid(nx, ny); }
  bool find(Vec3 wo, Vec3 wi, Place &place) const {
    if (wi.z >= 0) return false;
    const float sign = eta > 1 ? -1.0f : 1.0f;
    const float n = static_cast<float>(eta);
    place =
        normals.place(sign * (wo.x + n * wi.x), sign * (wo.y + n * wi.y), sign * (wo.z + n * wi.z));
    return true;
  }
  template <typename Eval>
  double density(const Eval &eval, Vec3 wo, double cosine, double phi) const {
    const NormalSpace::Normal h = normals.normal(cosine, phi);
    const double wo_h = static_cast<double>(dot(wo, h.direction));
    const double cos2 = 1 - (1 - wo_h * wo_h) / (eta * eta);
    if (!(wo_h > 0) || !(cos2 > 0)) return 0;
    const double cos_t = std::sqrt(cos2);
    const Vec3 wi =
        h.direction * static_cast<float>(wo_h / eta - cos_t) - wo * static_cast<float>(1 / eta);
    if (!(wi.z < 0)) return 0;
    const double stretch = wo_h - eta * cos_t;  // dh / dwi, Walter et al. 2007, eq. 17
    return static_cast<double>(eval(wi).pdf) * stretch * stretch / (eta * eta * cos_t) * h.jacobian;
  }
};

// ---- checks -------------------------------------------------------------------------------------

/// Sampled directions follow eval's density on a coarse and a fine grid, and that density integrates to
/// the share of samples that have one: not those that were lost or are deltas (STABILITY: B1, M11).
template <int Kind, typename Space>
void check_sampling(const Seen<Kind> &seen, Vec3 wo, const Space &space, int samples,
                    bool is_resolved = true) {
  Random random(17);
  Histogram coarse(space.grid(10, 20)), fine(space.grid(64, 128));
  for (int i = 0; i < samples; ++i) {
    const BsdfSample s = seen.sample(wo, random);
    Place at;
    const bool counts = s.pdf > 0 && space.find(wo, s.wi, at);
    for (Histogram *histogram : {&coarse, &fine}) {
      if (counts)
        histogram->add(at.cosine, at.phi);
      else
        histogram->add_invalid();
    }
  }
  const auto eval = [&](Vec3 wi) { return seen.eval(wo, wi); };
  const auto density = [&](double cosine, double phi) {
    return space.density(eval, wo, cosine, phi);
  };
  CAPTURE(seen.m.alpha);
  CAPTURE(seen.m.roughness);
  CAPTURE(seen.front);
  CAPTURE(wo.z);
  for (const Histogram *histogram : {&coarse, &fine}) {
    if (histogram == &fine && !is_resolved) continue;
    const Fit fit = chi_square_fit(*histogram, cell_masses(histogram->grid(), density));
    INFO(fit.text());
    CHECK(fit.accepted());
    const double noise = std::sqrt(fit.lost * (1 - fit.lost) / samples);
    CHECK(std::fabs(fit.mass - (1 - fit.lost)) < 1e-3 + 5 * noise);
  }
}

/// Worst relative difference between weight * density and f cos, and between the densities of sample and
/// eval. `condition(wo, wi)` >= 1 says how much worse than rounding it may be: differences are divided
/// by it. Deltas are left out.
template <int Kind, typename Condition>
double worst_difference(const Seen<Kind> &seen, const Condition &condition, int samples = 50000) {
  Random random(1);
  double worst = 0;
  for (int i = 0; i < samples; ++i) {
    const Vec3 wo = i < 9 ? local_directions()[static_cast<std::size_t>(i)] : upper(random);
    const BsdfSample s = seen.sample(wo, random);
    if (!(s.pdf > 0)) continue;
    const BsdfValue v = seen.eval(wo, s.wi);
    for (const double d :
         {relative(v.pdf, s.pdf), relative(v.f_cos.x, s.weight.x * s.pdf),
          relative(v.f_cos.y, s.weight.y * s.pdf), relative(v.f_cos.z, s.weight.z * s.pdf)})
      worst = std::max(worst, d / condition(wo, s.wi));
  }
  return worst;
}
template <int Kind>
double worst_difference(const Seen<Kind> &seen) {
  return worst_difference(seen, [](Vec3, Vec3) { return 1.0; });
}

/// Worst relative difference between f(wo, wi) and f(wi, wo); through the surface, between
/// f(wo, wi) n_o^2 and f(wi, wo) n_i^2 (STABILITY: M10). What is transmitted counts relative to at least
/// 0.01: close to total reflection it is the small difference of numbers near 1.
template <int Kind>
double worst_asymmetry(const Seen<Kind> &seen, int pairs = 100000) {
  Random random(2);
  double worst = 0;
  const float eta2 = static_cast<float>(seen.eta() * seen.eta());
  for (int i = 0; i < pairs; ++i) {
    const Vec3 wo = upper(random), wi = upper(random);
    const float there = seen.eval(wo, wi).f_cos.y / wi.z, back = seen.eval(wi, wo).f_cos.y / wo.z;
    worst = std::max(worst, relative(there, back));
    if (!transmits<Kind>()) continue;
    // Seen from the other side the local frame is upside down.
    const float in = seen.eval(wo, mirrored_below(wi)).f_cos.y / wi.z;
    const float out = seen.from_behind().eval(wi, mirrored_below(wo)).f_cos.y / wo.z;
    worst = std::max(worst, static_cast<double>(std::fabs(in * eta2 - out) / std::max(out, 0.01f)));
  }
  return worst;
}

/// Mean weight of samples: the share of light that is scattered, seen from wo. What was transmitted
/// counts as energy (weight * eta^2), not as radiance.
template <int Kind>
Mean albedo(const Seen<Kind> &seen, Vec3 wo, int samples) {
  Random random(23);
  Mean mean;
  const double eta2 = seen.eta() * seen.eta();
  for (int i = 0; i < samples; ++i) {
    const BsdfSample s = seen.sample(wo, random);
    mean.add(static_cast<double>(s.weight.x) * (s.wi.z < 0 ? eta2 : 1));
  }
  return mean;
}

/// Integral of f cos over the hemisphere above by quadrature. Deltas are not in it.
template <int Kind>
double integrated_albedo(const Seen<Kind> &seen, Vec3 wo) {
  const auto f_cos = [&](double cosine, double phi) {
    return static_cast<double>(seen.eval(wo, direction(cosine, phi)).f_cos.x);
  };
  double sum = 0;
  for (const double part : cell_masses(hemisphere_grid(32, 64), f_cos)) sum += part;
  return sum;
}

/// Samples and values are finite and not negative, directions unit, down to the most grazing wo and at
/// the edges of the unit square (STABILITY: G8, M2).
template <int Kind>
void check_finite(const Seen<Kind> &seen, int samples = 5000) {
  Random random(4);
  CAPTURE(seen.m.alpha);
  CAPTURE(seen.m.ior);
  const auto edge_or = [&](float u) {
    return random.chance(0.1) ? (random.chance(0.5) ? 0.0f : 1 - 0x1p-24f) : u;
  };
  for (const float z : {1.0f, 0.5f, 1e-3f, 1e-5f, 1e-7f}) {
    const Vec3 wo = normalize(vec3(std::sqrt(1 - z * z) * 0.8f, std::sqrt(1 - z * z) * 0.6f, z));
    CAPTURE(z);
    for (int i = 0; i < samples; ++i) {
      const Vec2 u = vec2(edge_or(random.unit()), edge_or(random.unit()));
      const BsdfSample s =
          sample_bsdf<Kind>(seen.scene, seen.m, seen.front, wo, u, edge_or(random.unit()));
      REQUIRE(all_finite(s.weight));
      REQUIRE((is_finite(s.pdf) && s.pdf >= 0.0f));
      REQUIRE((s.weight.x >= 0.0f && s.weight.y >= 0.0f && s.weight.z >= 0.0f));
      if (!is_black(s.weight)) {
        REQUIRE(std::fabs(length(s.wi) - 1) < 1e-6f);
        REQUIRE(s.wi.z != 0.0f);
        REQUIRE((transmits<Kind>() || s.wi.z > 0.0f));
      }
      for (const Vec3 wi : {s.wi, mirrored_below(s.wi), random.direction()}) {
        const BsdfValue v = seen.eval(wo, wi);
        REQUIRE(all_finite(v.f_cos));
        REQUIRE((is_finite(v.pdf) && v.pdf >= 0.0f));
        REQUIRE((v.f_cos.x >= 0.0f && v.f_cos.y >= 0.0f && v.f_cos.z >= 0.0f));
        REQUIRE((v.pdf > 0.0f || is_black(v.f_cos)));  // else light would be missed
      }
    }
  }
}

}  // namespace phalanx::test
