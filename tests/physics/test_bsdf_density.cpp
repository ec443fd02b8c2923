// BSDF sampling: directions follow the density, the density integrates to 1 less what is lost.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../../kernels/physics/bsdf.h"
#include "support/local_directions.h"
#include "support/materials.h"
#include "support/normal_space.h"
#include "support/random.h"
#include "support/statistics.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

constexpr float kSharp[] = {1e-3f, 5e-3f, 0.01f, 0.05f};
constexpr float kRough[] = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};

/// Where a sampled direction counts, and the density there.
struct DirectionSpace {  // cosine and azimuth of wi itself
  NormalSpace::Place place(Vec3, Vec3 wi) const {
    return {static_cast<double>(wi.z),
            azimuth(static_cast<double>(wi.x), static_cast<double>(wi.y))};
  }
  template <typename Eval>
  double density(const Eval &eval, Vec3, double cosine, double phi) const {
    const double sine = std::sqrt(1 - cosine * cosine);
    return static_cast<double>(
        eval(vec3(static_cast<float>(sine * std::cos(phi)),
                  static_cast<float>(sine * std::sin(phi)), static_cast<float>(cosine)))
            .pdf);
  }
};
struct HalfVectorSpace {  // the stretched half vector: for lobes sharper than the cells
  NormalSpace normals;
  NormalSpace::Place place(Vec3 wo, Vec3 wi) const { return normals.place_half(wo, wi); }
  template <typename Eval>
  double density(const Eval &eval, Vec3 wo, double cosine, double phi) const {
    const NormalSpace::Normal h = normals.normal(cosine, phi);
    const float wo_h = dot(wo, h.direction);
    const Vec3 wi = h.direction * (2 * wo_h) - wo;
    if (!(wo_h > 0) || !(wi.z > 0)) return 0;
    return static_cast<double>(eval(wi).pdf) * 4 * static_cast<double>(wo_h) * h.jacobian;
  }
};

template <int Kind, typename Space>
void check_sampling(const Material &m, Vec3 wo, const Space &space, int samples) {
  const auto eval = [&](Vec3 wi) { return eval_bsdf<Kind>(m, wo, wi); };
  Random random(17);
  Histogram coarse(hemisphere_grid(10, 20)), fine(hemisphere_grid(64, 128));
  for (int i = 0; i < samples; ++i) {
    const BsdfSample s = sample_bsdf<Kind>(m, 1, wo, random.square(), random.unit());
    for (Histogram *histogram : {&coarse, &fine}) {
      if (s.pdf > 0) {
        const NormalSpace::Place at = space.place(wo, s.wi);
        histogram->add(at.cosine, at.phi);
      } else {
        histogram->add_invalid();
      }
    }
  }
  const auto density = [&](double cosine, double phi) {
    return space.density(eval, wo, cosine, phi);
  };
  CAPTURE(m.alpha);
  CAPTURE(wo.z);
  // Rounded directions know their half vector to 3e-8 / wo.z, against cells of alpha / 64.
  const bool resolved = Kind != kConductor || wo.z * m.alpha > 9e-6f;
  for (const Histogram *histogram : {&coarse, &fine}) {
    if (histogram == &fine && !resolved) continue;
    const Fit fit = chi_square_fit(*histogram, cell_masses(histogram->grid(), density));
    INFO(fit.text());
    CHECK(fit.accepted());
    // M11: the integral of the density is the share of valid samples.
    const double noise = std::sqrt(fit.lost * (1 - fit.lost) / samples);
    CHECK(std::fabs(fit.mass - (1 - fit.lost)) < 1e-3 + 5 * noise);
  }
}

}  // namespace

TEST_CASE("diffuse: directions follow the density, which integrates to 1") {
  check_sampling<kDiffuse>(diffuse(1), vec3(0, 0, 1), DirectionSpace{}, num_samples());
}

TEST_CASE("conductor: rough lobes follow their density in direction space") {
  for (const float alpha : kRough)
    for (const Vec3 wo : local_directions())
      check_sampling<kConductor>(conductor(alpha), wo, DirectionSpace{}, num_samples());
}

TEST_CASE("conductor: sharp lobes follow their density in half-vector space (M1)") {
  for (const float alpha : kSharp)
    for (const Vec3 wo : local_directions()) {
      if (wo.z * alpha < 2e-6f) continue;  // less than a cell of the coarse grid
      check_sampling<kConductor>(conductor(alpha), wo,
                                 HalfVectorSpace{{static_cast<double>(alpha)}}, num_samples());
    }
}

TEST_CASE("bsdf: a delta kind has no density, a scattering kind has one") {
  CHECK(has_density<kDiffuse>());
  CHECK(has_density<kConductor>());
  CHECK_FALSE(has_density<kMirror>());
  CHECK_FALSE(has_density<kDielectric>());
  CHECK_FALSE(has_density<kBlack>());
  const Vec3 w = vec3(0, 0.6f, 0.8f);
  CHECK(eval_bsdf<kMirror>(mirror(1), w, w).pdf == 0.0f);
  CHECK(eval_bsdf<kDielectric>(dielectric(1.5f), w, w).pdf == 0.0f);
  CHECK(eval_bsdf<kBlack>(diffuse(1), w, w).pdf == 0.0f);
  CHECK(is_black(sample_bsdf<kBlack>(diffuse(1), 1, w, vec2(0.3f, 0.3f), 0.5f).weight));
}
