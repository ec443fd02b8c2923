// The GGX distribution and its visible normals.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../../kernels/physics/microfacet.h"
#include "support/local_directions.h"
#include "support/normal_space.h"
#include "support/random.h"
#include "support/statistics.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

constexpr float kAlphas[] = {1e-3f, 5e-3f, 0.01f, 0.05f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f};

/// GGX in double: D of a normal given as its tangent relative to alpha, squared.
double ggx_d64(double r2, double alpha) {
  const double cos2 = 1 / (1 + alpha * alpha * r2);
  return 1 / (kPi * alpha * alpha * cos2 * cos2 * (1 + r2) * (1 + r2));
}

}  // namespace

TEST_CASE("ggx: D agrees with double precision down to alpha = 1e-4 (M1)") {
  Random random(1);
  for (const float alpha : {1e-4f, 1e-3f, 1e-2f, 0.1f, 1.0f}) {
    double worst = 0;
    for (int i = 0; i < 20000; ++i) {
      const double a = static_cast<double>(alpha), c = 0.9999 * random.fine(), r2 = c / (1 - c);
      const double t = a * std::sqrt(r2), z = 1 / std::sqrt(1 + t * t),
                   phi = 2 * kPi * random.fine();
      const Vec3 m = vec3(static_cast<float>(t * z * std::cos(phi)),
                          static_cast<float>(t * z * std::sin(phi)), static_cast<float>(z));
      const double exact = ggx_d64(r2, a);
      worst = std::max(worst, std::fabs(static_cast<double>(ggx_d(m, alpha)) / exact - 1));
    }
    CAPTURE(alpha);
    CHECK(worst < 2e-6);
  }
  CHECK(ggx_d(vec3(0, 0, 1), 1e-4f) == doctest::Approx(1e8 / kPi).epsilon(1e-6));
}

TEST_CASE("ggx: projected area of the normals is 1") {
  for (const float alpha : kAlphas) {
    const auto projected = [&](double cosine, double phi) {
      const NormalSpace::Normal m = NormalSpace{static_cast<double>(alpha)}.normal(cosine, phi);
      return static_cast<double>(ggx_d(m.direction, alpha)) * m.z * m.jacobian;
    };
    const double area = integrate(projected, 0, 1, 0, 2 * kPi, 1e-6, 10);
    CAPTURE(alpha);
    CHECK(area == doctest::Approx(1).epsilon(1e-4));
  }
}

TEST_CASE("ggx: visible area of the normals is the projected area of wo") {
  // Integral of G1(wo) max(wo.m, 0) D(m) = wo.z: pdf_ggx_visible integrates to 1.
  for (const float alpha : kAlphas)
    for (const Vec3 wo : local_directions()) {
      const auto density = [&](double cosine, double phi) {
        const NormalSpace::Normal m = NormalSpace{static_cast<double>(alpha)}.normal(cosine, phi);
        return static_cast<double>(pdf_ggx_visible(wo, m.direction, alpha)) * m.jacobian;
      };
      double mass = 0;
      for (const double part : cell_masses(hemisphere_grid(10, 20), density)) mass += part;
      CAPTURE(alpha);
      CAPTURE(wo.z);
      CHECK(mass == doctest::Approx(1).epsilon(1e-3));
    }
}

TEST_CASE("ggx: visible normals follow their density") {
  for (const float alpha : kAlphas)
    for (const Vec3 wo : local_directions()) {
      const NormalSpace space{static_cast<double>(alpha)};
      Random random(5);
      Histogram coarse(hemisphere_grid(10, 20)), fine(hemisphere_grid(64, 128));
      for (int i = 0; i < num_samples() / 2; ++i) {
        const Vec3 m = sample_ggx_visible(wo, alpha, random.square());
        const NormalSpace::Place at = space.place(m);
        coarse.add(at.cosine, at.phi);
        fine.add(at.cosine, at.phi);
      }
      const auto density = [&](double cosine, double phi) {
        const NormalSpace::Normal m = space.normal(cosine, phi);
        return static_cast<double>(pdf_ggx_visible(wo, m.direction, alpha)) * m.jacobian;
      };
      CAPTURE(alpha);
      CAPTURE(wo.z);
      for (const Histogram *histogram : {&coarse, &fine}) {
        const Fit fit = chi_square_fit(*histogram, cell_masses(histogram->grid(), density));
        INFO(fit.text());
        CHECK(fit.accepted());
      }
    }
}

TEST_CASE("ggx: visible normals are unit, above the horizon and on the side of wo") {
  Random random(6);
  for (const float alpha : kAlphas)
    for (const float z : {1.0f, 0.5f, 1e-3f, 1e-7f}) {
      const Vec3 wo = normalize(vec3(std::sqrt(1 - z * z), 0, z));
      for (int i = 0; i < 20000; ++i) {
        const Vec2 u =
            i < 4 ? vec2(i & 1 ? 1 - 0x1p-24f : 0, i & 2 ? 1 - 0x1p-24f : 0) : random.square();
        const Vec3 m = sample_ggx_visible(wo, alpha, u);
        REQUIRE(all_finite(m));
        REQUIRE(m.z >= 0.0f);
        REQUIRE(std::fabs(length_squared(m) - 1) < 1e-6f);
        REQUIRE(dot(wo, m) > -2e-6f);
      }
    }
}

TEST_CASE("ggx: masking is in (0,1], symmetric, and G2 <= G1") {
  Random random(7);
  for (int i = 0; i < 200000; ++i) {
    const float alpha = std::pow(10.0f, random.between(-3, 0));
    Vec3 a = random.direction(), b = random.direction();
    a.z = std::max(std::fabs(a.z), 1e-7f);
    b.z = std::max(std::fabs(b.z), 1e-7f);
    const float g1 = ggx_g1(a, alpha), g2 = ggx_g2(a, b, alpha);
    REQUIRE(ggx_lambda(a, alpha) >= 0.0f);
    REQUIRE((g1 > 0.0f && g1 <= 1.0f));
    REQUIRE((g2 > 0.0f && g2 <= g1));
    REQUIRE(g2 == doctest::Approx(ggx_g2(b, a, alpha)).epsilon(1e-6));
  }
  CHECK(ggx_g1(vec3(0, 0, 1), 1.0f) == 1.0f);
  // alpha = 1 at 60 degrees: Lambda = (sqrt(1 + tan^2) - 1) / 2 = 1/2.
  CHECK(ggx_lambda(vec3(std::sqrt(0.75f), 0, 0.5f), 1.0f) == doctest::Approx(0.5).epsilon(1e-6));
}
