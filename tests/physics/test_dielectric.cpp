// Smooth dielectrics: energy, Snell's law, total reflection, extreme indices.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../../kernels/physics/bsdf.h"
#include "support/materials.h"
#include "support/random.h"
#include "support/statistics.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

constexpr float kMost = 1 - 0x1p-24f;

Vec3 at_angle(double sine, double phi) {
  return {static_cast<float>(sine * std::cos(phi)), static_cast<float>(sine * std::sin(phi)),
          static_cast<float>(std::sqrt(std::max(1 - sine * sine, 0.0)))};
}
float index_ratio(float ior, int front) { return front != 0 ? ior : 1 / ior; }

}  // namespace

TEST_CASE("dielectric: the lobe is chosen with the Fresnel probability") {
  for (const int front : {0, 1})
    for (const double sine : {0.0, 0.3, 0.6, 0.9, 0.999}) {
      const Vec3 wo = at_angle(sine, 1.0);
      const float r = fresnel_dielectric(wo.z, index_ratio(1.5f, front)).reflectance;
      Random random(1);
      Mean reflected;
      for (int i = 0; i < 200000; ++i)
        reflected.add(sample_dielectric(dielectric(1.5f), front, wo, random.unit()).wi.z > 0);
      if (r < 1)
        CHECK(reflected.p(static_cast<double>(r)) > test::alpha());
      else
        CHECK(reflected.mean() == 1);
    }
}

TEST_CASE("dielectric: R + T = 1 for energy; radiance carries 1 / eta^2 into the far side") {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const int front = random.below(2);
    const float ior = std::exp(random.between(-1, 1)), eta = index_ratio(ior, front);
    const Vec3 wo = at_angle(random.fine(), 6 * random.fine());
    if (std::fabs(ior - 1) < 1e-4f || !(wo.z > 0)) continue;
    const BsdfSample reflected = sample_dielectric(dielectric(ior), front, wo, 0.0f);
    if (reflected.wi.z > 0) {
      REQUIRE(reflected.weight.x == 1.0f);
      REQUIRE((reflected.wi.x == -wo.x && reflected.wi.y == -wo.y && reflected.wi.z == wo.z));
    }
    const BsdfSample passed = sample_dielectric(dielectric(ior), front, wo, kMost);
    REQUIRE(passed.pdf == 0.0f);
    if (passed.wi.z < 0) REQUIRE(passed.weight.x * eta * eta == doctest::Approx(1).epsilon(1e-6));
    if (passed.wi.z > 0) REQUIRE(fresnel_dielectric(wo.z, eta).reflectance >= kMost);
  }
}

TEST_CASE("dielectric: the factors in and out of a slab cancel") {
  const Vec3 wo = at_angle(0.7, 2);
  const BsdfSample into = sample_dielectric(dielectric(1.5f), 1, wo, kMost);
  const BsdfSample out =
      sample_dielectric(dielectric(1.5f), 0, vec3(-into.wi.x, -into.wi.y, -into.wi.z), kMost);
  CHECK(into.weight.x * out.weight.x == doctest::Approx(1).epsilon(1e-6));
  CHECK(out.wi.x == doctest::Approx(-wo.x).epsilon(1e-6));
  CHECK(out.wi.y == doctest::Approx(-wo.y).epsilon(1e-6));
  CHECK(out.wi.z == doctest::Approx(-wo.z).epsilon(1e-6));
}

TEST_CASE("dielectric: refraction obeys Snell's law, stays in the plane and has unit length") {
  Random random(3);
  double worst_sine = 0, worst_length = 0, worst_plane = 0;
  for (int i = 0; i < 200000; ++i) {
    const int front = random.below(2);
    const float ior = std::exp(random.between(-1, 1));
    const Vec3 wo = at_angle(random.fine(), 6 * random.fine());
    if (std::fabs(ior - 1) < 1e-4f || !(wo.z > 0)) continue;
    const BsdfSample s = sample_dielectric(dielectric(ior), front, wo, kMost);
    worst_length = std::max(worst_length, std::fabs(static_cast<double>(length(s.wi)) - 1));
    if (s.wi.z > 0) continue;
    const double eta = static_cast<double>(index_ratio(ior, front));
    const double sine_i = std::hypot(static_cast<double>(wo.x), static_cast<double>(wo.y));
    const double sine_t = std::hypot(static_cast<double>(s.wi.x), static_cast<double>(s.wi.y));
    worst_sine = std::max(worst_sine, std::fabs(sine_i - eta * sine_t));
    worst_plane =
        std::max(worst_plane, static_cast<double>(std::fabs(s.wi.x * wo.y - s.wi.y * wo.x)));
  }
  CHECK(worst_length < 1e-6);
  CHECK(worst_sine < 2e-6);
  CHECK(worst_plane < 1e-6);
}

TEST_CASE("dielectric: total reflection begins at the critical angle (M5)") {
  const double critical = 1 / 1.5;
  for (const double off : {1e-5, 1e-6, 3e-7}) {
    const Vec3 above = at_angle(critical * (1 + off), 0.4);
    CHECK(sample_dielectric(dielectric(1.5f), 0, above, kMost).wi.z > 0);
  }
  for (int step = -300; step < 300; ++step)
    for (const float u : {0.0f, 0.5f, kMost}) {
      const Vec3 wo = at_angle(critical * (1 + step * 3e-8), 0.4);
      const BsdfSample s = sample_dielectric(dielectric(1.5f), 0, wo, u);
      REQUIRE(all_finite(s.wi));
      REQUIRE(all_finite(s.weight));
      REQUIRE(std::fabs(length(s.wi) - 1) < 1e-6f);
    }
}

TEST_CASE("dielectric: an index within 1e-4 of 1 is not there (M3)") {
  const Vec3 wo = at_angle(0.8, 1);
  for (const float ior : {1.0f, 1.0000001f, 1 / 1.0000001f, 1.00009f})
    for (const int front : {0, 1})
      for (const float u : {0.0f, 0.5f, kMost}) {
        const BsdfSample s = sample_dielectric(dielectric(ior), front, wo, u);
        CHECK((s.wi.x == -wo.x && s.wi.y == -wo.y && s.wi.z == -wo.z));
        CHECK(s.weight.x == 1.0f);
        CHECK(s.pdf == 0.0f);
      }
  // Just outside that range light goes on nearly straight, and everything is finite.
  const BsdfSample s = sample_dielectric(dielectric(1.0002f), 1, wo, 0.5f);
  CHECK(s.wi.z == doctest::Approx(-wo.z).epsilon(1e-3));
}

TEST_CASE("dielectric: extreme indices and grazing directions stay finite (M4)") {
  for (const float ior : {1e-3f, 0.01f, 100.0f, 1e4f, 1e5f})
    for (const int front : {0, 1})
      for (const double cosine : {1.0, 0.5, 1e-3, 1e-7})
        for (const float u : {0.0f, 0.5f, kMost}) {
          Vec3 wo = at_angle(std::sqrt(1 - cosine * cosine), 1);
          wo.z = static_cast<float>(cosine);
          const BsdfSample s = sample_dielectric(dielectric(ior), front, wo, u);
          CHECK(all_finite(s.wi));
          CHECK(all_finite(s.weight));
          CHECK(std::fabs(length(s.wi) - 1) < 1e-6f);
          CHECK(s.wi.z != 0.0f);
        }
}
