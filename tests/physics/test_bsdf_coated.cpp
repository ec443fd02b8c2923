// A dielectric coat over a diffuse base.
#include <doctest/doctest.h>

#include "scene/albedo_tables.h"
#include "support/bsdf_checks.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

class Plastic {
 public:
  Plastic(float albedo, float ior, float alpha) {
    AlbedoTables tables(tables_);
    seen_.m = coated(albedo, ior, alpha);
    seen_.m.table = tables.dielectric(ior);
    seen_.scene.tables = tables_.data();
  }
  const Seen<kCoated> &operator*() const { return seen_; }
  Seen<kCoated> *operator->() { return &seen_; }

 private:
  Seen<kCoated> seen_ = {};
  std::vector<float> tables_;
};

constexpr float kAlphas[] = {0, 1e-3f, 0.02f, 0.1f, 0.4f, 1};

/// 2 int F mu dmu for light that meets glass of index n > 1 (Walsh 1926).
double average_reflectance(double n) {
  const double n2 = n * n, n3 = n2 * n, n4 = n2 * n2;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
         2 * n3 * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
         8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
}

auto condition(float alpha) {
  return [=](Vec3 wo, Vec3 wi) {
    const double wo_h = 0.5 * static_cast<double>(length(wo + wi));
    return alpha > 0 ? std::max(1.0, 0.01 / (static_cast<double>(alpha) * wo_h)) : 1.0;
  };
}

}  // namespace

TEST_CASE("coated: directions follow the density, which integrates to 1 less the delta") {
  for (const Vec3 wo : local_directions())
    check_sampling(*Plastic(0.6f, 1.5f, 0.3f), wo, UpperDirections{}, num_samples());
  for (const float alpha : {0.0f, 1.0f})
    for (const std::size_t i : {1u, 5u, 8u})
      check_sampling(*Plastic(0.6f, 1.5f, alpha), local_directions()[i], UpperDirections{},
                     num_samples());
}

TEST_CASE("coated: sharp lobes follow their density in half-vector space (M1)") {
  for (const std::size_t i : {0u, 3u, 6u})  // grazing, the coat's lobe is smeared by rounding
    check_sampling(*Plastic(0, 1.5f, 5e-3f), local_directions()[i], ReflectingNormals{{5e-3}},
                   num_samples());
}

TEST_CASE("coated: weight times density is f cos; f is symmetric (M10)") {
  for (const float alpha : kAlphas) {
    CAPTURE(alpha);
    const Plastic plastic(0.7f, 1.5f, alpha);
    CHECK(worst_difference(*plastic, condition(alpha)) < 2e-4);
    CHECK(worst_asymmetry(*plastic) < 2e-4);
    for (const float ior : {1.0f, 1.33f, 100.0f, 1e4f})
      check_finite(*Plastic(0.9f, ior, alpha), 1000);
  }
}

TEST_CASE("furnace: a coated white base reflects 1 +- 0.5 %, from everywhere (M9)") {
  for (const float alpha : kAlphas)
    for (const float ior : {1.0f, 1.5f, 2.5f}) {
      const Plastic plastic(1, ior, alpha);
      for (const Vec3 wo : local_directions()) {
        CAPTURE(alpha);
        CAPTURE(ior);
        CAPTURE(wo.z);
        CHECK(albedo(*plastic, wo, 50000).p(1, 5e-3) > test::alpha());
      }
    }
}

TEST_CASE("coated: the smooth coat is a delta, and its base that of nonlinear plastic") {
  Plastic plastic(0.6f, 1.5f, 0);
  const Vec3 wo = local_directions()[4], wi = local_directions()[2];
  const double inside = 1 - (1 - average_reflectance(1.5)) / 2.25;
  CHECK(inside == doctest::Approx(0.5963).epsilon(1e-3));
  const double enters = 1 - static_cast<double>(fresnel_dielectric(wo.z, 1.5f).reflectance);
  const double leaves = 1 - static_cast<double>(fresnel_dielectric(wi.z, 1.5f).reflectance);
  const double f = 0.6 * enters * leaves / (2.25 * kPi * (1 - 0.6 * inside));
  CHECK((*plastic).eval(wo, wi).f_cos.x ==
        doctest::Approx(f * static_cast<double>(wi.z)).epsilon(1e-4));
  // The mirror direction holds the delta; eval has the base only.
  Random random(8);
  const Vec3 mirrored = vec3(-wo.x, -wo.y, wo.z);
  Mean delta;
  for (int i = 0; i < 100000; ++i) {
    const BsdfSample s = (*plastic).sample(wo, random);
    if (s.pdf == 0.0f) REQUIRE(length(s.wi - mirrored) == 0.0f);
    delta.add(s.pdf == 0.0f ? static_cast<double>(s.weight.x) : 0);
  }
  CHECK(delta.p(1 - enters, 1e-6) > test::alpha());
  // Tints: of the coat only.
  plastic->m.specular = {0, 0, 0};
  const Mean base = albedo(*plastic, wo, 100000);
  CHECK(base.p(integrated_albedo(*plastic, wo), 1e-5) > test::alpha());
  CHECK((*plastic).eval(wo, wi).f_cos.x ==
        doctest::Approx(f * static_cast<double>(wi.z)).epsilon(1e-4));
}

TEST_CASE("coated: without a step of the index it is Lambert; under alpha 1e-3 it turns smooth") {
  const Vec3 wo = local_directions()[3], wi = local_directions()[5];
  for (const float alpha : kAlphas)
    CHECK((*Plastic(0.3f, 1, alpha)).eval(wo, wi).f_cos.x ==
          doctest::Approx(eval_diffuse(diffuse(0.3f), wi).f_cos.x).epsilon(1e-5));
  const Plastic smooth(0.3f, 1.5f, 0.99e-3f), rough(0.3f, 1.5f, 1e-3f);
  for (const Vec3 w : local_directions()) {
    CAPTURE(w.z);
    if (w.z < 0.01f) continue;  // there even this roughness shows
    CHECK(albedo(*smooth, w, 200000).mean() ==
          doctest::Approx(albedo(*rough, w, 200000).mean()).epsilon(5e-3));
  }
}

TEST_CASE("albedo table: average reflectance of smooth glass in closed form") {
  for (const float ior : {1.1f, 1.5f, 2.0f, 4.0f}) {
    const Plastic plastic(1, ior, 0);
    CHECK(static_cast<double>(average_albedo((*plastic).scene, (*plastic).m.table, 0)) ==
          doctest::Approx(average_reflectance(static_cast<double>(ior))).epsilon(1e-4));
  }
}

TEST_CASE("albedo table: lookups are albedos by quadrature, between the columns, too") {
  std::vector<float> floats;
  AlbedoTables tables(floats);
  const std::int32_t white = tables.microfacets(), streaks = tables.microfacets(0.1f, 0.6f);
  CHECK(tables.microfacets() == white);  // made once
  SceneView scene = {};
  scene.tables = floats.data();
  for (const float alpha : {0.013f, 0.1f, 0.33f, 1.0f})
    for (const double mu : {0.97, 0.61, 0.23, 0.07}) {
      CAPTURE(alpha);
      CAPTURE(mu);
      Random random(12);
      Mean round, streaked;
      for (int i = 0; i < 200000; ++i) {
        const Vec2 u = random.square();
        round.add(
            static_cast<double>(sample_conductor(conductor(alpha), direction(mu, 0), u).weight.x));
        streaked.add(
            static_cast<double>(sample_glossy_conductor(scene, glossy_conductor(0.1f, 0.6f),
                                                        direction(mu, 0.8), u, 0.5f)
                                    .weight.x));
      }
      const float m = static_cast<float>(mu);
      CHECK(round.p(static_cast<double>(directional_albedo(scene, white, std::sqrt(alpha), m)),
                    2.5e-3) > test::alpha());
      const float row = glossy_row(vec2(0.1f, 0.6f), direction(mu, 0.8));
      CHECK(streaked.p(static_cast<double>(directional_albedo(scene, streaks, row, m)), 2.5e-3) >
            test::alpha());
    }
}
