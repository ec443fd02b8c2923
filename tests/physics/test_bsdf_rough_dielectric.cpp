// Rough and tinted glass, thin sheets of glass.
#include <doctest/doctest.h>

#include "support/bsdf_checks.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

Seen<kRoughDielectric> glass(float alpha, int32 front = 1, float ior = 1.5f) {
  return {rough_dielectric(ior, alpha), front};
}
Seen<kRoughDielectric> tinted(float alpha, int32 front = 1) {
  Seen<kRoughDielectric> seen = glass(alpha, front);
  seen.m.specular = {0.9f, 0.5f, 0.25f};
  seen.m.transmittance = {0.3f, 0.6f, 0.8f};
  return seen;
}

auto condition(float alpha) {
  return [=](Vec3 wo, Vec3 wi) {
    const double wo_h = 0.5 * static_cast<double>(length(wo + wi));
    return std::max(1.0, 0.01 / (static_cast<double>(alpha) * std::min(wo_h, 0.1)));
  };
}

}  // namespace

TEST_CASE("rough_dielectric: rough lobes follow their density on both sides") {
  for (const int32 front : {1, 0}) {
    for (const Vec3 wo : local_directions())
      check_sampling(tinted(0.3f, front), wo, AllDirections{}, num_samples());
    for (const std::size_t i : {0u, 4u, 8u})
      check_sampling(glass(1, front), local_directions()[i], AllDirections{}, num_samples());
  }
}

TEST_CASE("rough_dielectric: sharp lobes follow their density in spaces of normals (M1)") {
  for (const float alpha : {1e-3f, 0.03f})
    for (const int32 front : {1, 0})
      for (const std::size_t i : {3u, 6u}) {
        const Vec3 wo = local_directions()[i];
        const Seen<kRoughDielectric> seen = glass(alpha, front);
        const NormalSpace normals = {static_cast<double>(alpha)};
        const bool is_resolved = wo.z * alpha > 9e-6f;
        check_sampling(seen, wo, ReflectingNormals{normals}, num_samples(), is_resolved);
        check_sampling(seen, wo, RefractingNormals{normals, seen.eta()}, num_samples(),
                       alpha > 5e-3f);
      }
}

TEST_CASE("rough_dielectric: weight times density is f cos; f / n^2 is symmetric (M10)") {
  for (const float alpha : {1e-3f, 0.01f, 0.1f, 0.5f, 1.0f})
    for (const int32 front : {1, 0}) {
      CAPTURE(alpha);
      CAPTURE(front);
      CHECK(worst_difference(tinted(alpha, front), condition(alpha)) < 1e-3);
      if (alpha >= 0.1f) CHECK(worst_asymmetry(tinted(alpha, front)) < 1e-3);
      for (const float ior : {1e-3f, 0.7f, 1.001f, 1.5f, 100.0f, 1e4f})
        check_finite(glass(alpha, front, ior), 1000);
    }
}

TEST_CASE("furnace: rough glass never gains energy, and loses nothing while it is smooth (M9)") {
  for (const float alpha : {0.0f, 1e-3f, 0.05f, 0.25f, 0.5f, 1.0f})
    for (const int32 front : {1, 0})
      for (const Vec3 wo : local_directions()) {
        CAPTURE(alpha);
        CAPTURE(front);
        CAPTURE(wo.z);
        const Mean mean = albedo(glass(alpha, front), wo, 50000);
        CHECK(mean.mean() <= 1 + 1e-6 + 3 * mean.standard_error());
        if (alpha == 0) CHECK(mean.mean() == doctest::Approx(1).epsilon(1e-6));
        if (alpha == 1e-3f && wo.z > 0.05f) CHECK(mean.mean() > 0.999);
      }
}

TEST_CASE("rough_dielectric: alpha below 1e-3 is the smooth dielectric, with tints") {
  Random random(3);
  for (const float alpha : {0.0f, 0.9e-3f})
    for (const int32 front : {1, 0})
      for (const Vec3 wo : local_directions()) {
        const Seen<kRoughDielectric> seen = glass(alpha, front);
        for (int i = 0; i < 100; ++i) {
          const float u = random.unit();
          const BsdfSample s = sample_rough_dielectric(seen.m, front, wo, random.square(), u);
          const BsdfSample t = sample_dielectric(dielectric(1.5f), front, wo, u);
          CHECK(s.pdf == 0.0f);
          CHECK(length(s.wi - t.wi) < 1e-6f);
          CHECK(relative(s.weight.x, t.weight.x) < 1e-6);
          CHECK(seen.eval(wo, s.wi).pdf == 0.0f);
        }
        // Tints scale each lobe: the weight holds the probability of having chosen it.
        const float r = fresnel_dielectric(wo.z, static_cast<float>(seen.eta())).reflectance;
        const Mean mean = albedo(tinted(alpha, front), wo, 100000);
        const double expected = 0.9 * static_cast<double>(r) + 0.3 * static_cast<double>(1 - r);
        CHECK(mean.p(expected, 1e-6) > test::alpha());
      }
}

TEST_CASE("rough_dielectric: total reflection is exact (M5)") {
  Random random(5);
  const float critical = std::sqrt(1 - 1 / 2.25f);  // cosine inside
  const Vec3 inside = direction(static_cast<double>(critical) * 0.999, 1);
  for (int i = 0; i < 1000; ++i) {
    const BsdfSample s = glass(0, 0).sample(inside, random);
    CHECK(s.wi.z > 0);
    CHECK(s.weight.x == 1.0f);
  }
  Seen<kRoughDielectric> absorbing = glass(0, 0);
  absorbing.m.specular = {0, 0, 0};
  CHECK(is_black(absorbing.sample(inside, random).weight));
}

TEST_CASE("rough_dielectric: an index within 1e-4 of 1 lets light pass unchanged (M3)") {
  Random random(6);
  for (const float ior : {1.0f, 1 + 1e-7f, 1 / (1 + 1e-7f), 1.00009f})
    for (const float alpha : {0.0f, 0.5f})
      for (const Vec3 wo : local_directions()) {
        const BsdfSample s = glass(alpha, 1, ior).sample(wo, random);
        CHECK((s.wi.x == -wo.x && s.wi.y == -wo.y && s.wi.z == -wo.z));
        CHECK((s.weight.x == 1.0f && s.pdf == 0.0f));
        CHECK(glass(alpha, 1, ior).eval(wo, s.wi).pdf == 0.0f);
      }
}

TEST_CASE("thin_dielectric: both surfaces of a slab, from both sides (B4-6)") {
  struct Slab {
    double degrees, reflectance;
  };
  for (const Slab slab : {Slab{0, 0.076923}, Slab{60, 0.163768}, Slab{75, 0.403908}})
    for (const int32 front : {1, 0}) {
      const Seen<kThinDielectric> sheet = {thin_dielectric(1.5f), front};
      const Vec3 wo = direction(std::cos(slab.degrees * kPi / 180), 2);
      Random random(7);
      Mean reflected;
      for (int i = 0; i < 200000; ++i) {
        const BsdfSample s = sheet.sample(wo, random);
        REQUIRE(s.weight.x == doctest::Approx(1).epsilon(1e-6));
        REQUIRE(s.pdf == 0.0f);
        REQUIRE(std::fabs(s.wi.z) == wo.z);
        if (s.wi.z < 0) REQUIRE(s.wi.x == -wo.x);
        reflected.add(s.wi.z > 0);
      }
      CHECK(reflected.p(slab.reflectance) > alpha());
    }
  Seen<kThinDielectric> red = {thin_dielectric(1.5f)};
  red.m.transmittance = {1, 0, 0};
  red.m.specular = {0.5f, 0.5f, 0.5f};
  CHECK(albedo(red, vec3(0, 0, 1), 100000).p(0.5 * 0.076923 + 0.923077, 1e-6) > alpha());
  for (const float ior : {1e-3f, 0.7f, 1.0f, 1e4f})
    check_finite(Seen<kThinDielectric>{thin_dielectric(ior)});
}
