// Fresnel reflectances: known values, limits, and double-precision oracles.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "../../kernels/physics/fresnel.h"
#include "support/random.h"

using namespace phalanx;
using test::Random;

namespace {

/// Fresnel's equations with complex index, straight from the textbook.
double fresnel64(double cos_i, std::complex<double> index) {
  const std::complex<double> sin2_i = 1 - cos_i * cos_i;
  const std::complex<double> cos_t = std::sqrt(1.0 - sin2_i / (index * index));
  const std::complex<double> s = (cos_i - index * cos_t) / (cos_i + index * cos_t);
  const std::complex<double> p = (index * cos_i - cos_t) / (index * cos_i + cos_t);
  return 0.5 * (std::norm(s) + std::norm(p));
}

}  // namespace

TEST_CASE("fresnel: glass at normal incidence, 60 and 75 degrees, and at grazing") {
  CHECK(fresnel_dielectric(1.0f, 1.5f).reflectance == doctest::Approx(0.04f).epsilon(1e-6));
  CHECK(fresnel_dielectric(1.0f, 1 / 1.5f).reflectance == doctest::Approx(0.04f).epsilon(1e-6));
  // STABILITY B4 no. 6: slabs reflect 2r / (1 + r).
  const auto slab = [](double degrees) {
    const float cosine = static_cast<float>(std::cos(degrees * 3.14159265358979 / 180));
    const double r = static_cast<double>(fresnel_dielectric(cosine, 1.5f).reflectance);
    return 2 * r / (1 + r);
  };
  CHECK(slab(0) == doctest::Approx(0.076923).epsilon(1e-5));
  CHECK(slab(60) == doctest::Approx(0.163768).epsilon(1e-5));
  CHECK(slab(75) == doctest::Approx(0.403908).epsilon(1e-5));
  CHECK(fresnel_dielectric(0.0f, 1.5f).reflectance == 1.0f);
  // Brewster's angle: only the perpendicular half is left, ((1 - n^2) / (1 + n^2))^2 / 2.
  const float brewster = 1 / std::sqrt(1 + 1.5f * 1.5f);
  CHECK(fresnel_dielectric(brewster, 1.5f).reflectance ==
        doctest::Approx(0.5 * std::pow(1.25 / 3.25, 2)).epsilon(1e-6));
}

TEST_CASE("fresnel: dielectrics agree with double precision, cosines with Snell's law") {
  Random random(1);
  double worst = 0, worst_snell = 0;
  for (int i = 0; i < 300000; ++i) {
    const float eta = std::exp(random.between(-4, 4)), cos_i = random.unit();
    const Refraction r = fresnel_dielectric(cos_i, eta);
    REQUIRE(r.reflectance >= 0.0f);
    REQUIRE(r.reflectance <= 1.0f);
    const double c = static_cast<double>(cos_i), n = static_cast<double>(eta);
    const double cos2_t = 1 - (1 - c * c) / (n * n);
    if (std::fabs(cos2_t) < 1e-4) continue;  // its root magnifies rounding: the next case
    const double exact = cos2_t < 0 ? 1 : fresnel64(c, n);
    worst = std::max(worst, std::fabs(static_cast<double>(r.reflectance) - exact));
    if (cos2_t > 0)
      // One rounding of cos_i^2 is worth 1 / eta^2 roundings of cos_t^2.
      worst_snell =
          std::max(worst_snell, std::fabs(std::pow(static_cast<double>(r.cos_t), 2) - cos2_t) *
                                    std::min(1.0, n * n));
  }
  CHECK(worst < 1e-4);
  CHECK(worst_snell < 4e-7);
}

TEST_CASE("fresnel: total reflection is exact above the critical angle, continuous below (M5)") {
  const float eta = 1 / 1.5f;
  const double n = static_cast<double>(eta);
  float cos_i = static_cast<float>(std::sqrt(1 - n * n));
  for (int ulp = 0; ulp < 2000; ++ulp) cos_i = std::nextafter(cos_i, 0.0f);
  float before = 1;
  for (int ulp = 0; ulp < 4000; ++ulp, cos_i = std::nextafter(cos_i, 1.0f)) {
    const double c = static_cast<double>(cos_i), cos2_t = 1 - (1 - c * c) / (n * n);
    const Refraction r = fresnel_dielectric(cos_i, eta);
    if (cos2_t < -3e-7) REQUIRE(r.reflectance == 1.0f);
    if (cos2_t < -3e-7) REQUIRE(r.cos_t == 0.0f);
    if (cos2_t > 3e-7) REQUIRE(r.reflectance < 1.0f);
    // One rounding of cos2_t is worth sqrt(2^-23) = 3.5e-4 in cos_t.
    REQUIRE(std::fabs(static_cast<double>(r.cos_t) - std::sqrt(std::max(cos2_t, 0.0))) < 6e-4);
    REQUIRE(std::fabs(r.reflectance - before) < 3e-3f);
    before = r.reflectance;
  }
}

TEST_CASE("fresnel: an index of 1 reflects nothing (M3)") {
  for (const float eta : {1.0f, std::nextafter(1.0f, 2.0f), std::nextafter(1.0f, 0.0f)})
    for (const float cos_i : {1.0f, 0.5f, 0.1f}) {
      const Refraction r = fresnel_dielectric(cos_i, eta);
      CHECK(r.reflectance <= 1e-8f);
      CHECK(r.cos_t == doctest::Approx(cos_i).epsilon(1e-5));
    }
  CHECK(fresnel_dielectric(1.0f, std::nextafter(1.0f, 2.0f)).reflectance <= 1e-14f);
}

TEST_CASE("fresnel: extreme indices stay in [0,1] (M4)") {
  for (const float eta : {1e-5f, 1e-4f, 1e-3f, 1e-2f, 100.0f, 1e4f, 1e5f})
    for (int i = 0; i <= 1000; ++i) {
      const Refraction r = fresnel_dielectric(static_cast<float>(i) * 1e-3f, eta);
      REQUIRE(r.reflectance >= 0.0f);
      REQUIRE(r.reflectance <= 1.0f);
      REQUIRE(r.cos_t >= 0.0f);
      REQUIRE(r.cos_t <= 1.0f);
    }
  CHECK(fresnel_dielectric(1.0f, 100.0f).reflectance ==
        doctest::Approx(std::pow(99.0 / 101, 2)).epsilon(1e-6));
  for (const float eta : {1e-4f, 0.01f, 1.0f, 1e5f})
    for (const float k : {0.0f, 1e-4f, 1.0f, 1e4f, 1e5f})
      for (int i = 0; i <= 1000; ++i) {
        const float r = fresnel_conductor(static_cast<float>(i) * 1e-3f, eta, k);
        REQUIRE(r >= 0.0f);
        REQUIRE(r <= 1.0f);
      }
  CHECK(fresnel_conductor(1.0f, 1.0f, 1e4f) == doctest::Approx(0.99999996).epsilon(2e-7));
  CHECK(fresnel_conductor(1.0f, 0.01f, 1e4f) == doctest::Approx(1).epsilon(2e-7));
}

TEST_CASE("fresnel: conductors agree with complex arithmetic") {
  Random random(2);
  double worst = 0;
  for (int i = 0; i < 300000; ++i) {
    const float eta = std::exp(random.between(-3, 2)), k = std::exp(random.between(-3, 2.5f));
    const float cos_i = random.unit();
    worst =
        std::max(worst, std::fabs(static_cast<double>(fresnel_conductor(cos_i, eta, k)) -
                                  fresnel64(static_cast<double>(cos_i),
                                            {static_cast<double>(eta), static_cast<double>(k)})));
  }
  CHECK(worst < 1e-4);
  // Gold at 650 nm: n = 0.166, k = 3.15.
  CHECK(fresnel_conductor(1.0f, 0.166f, 3.15f) == doctest::Approx(0.9410).epsilon(1e-3));
}

TEST_CASE("fresnel: conductor without absorption is a dielectric") {
  for (int i = 1; i <= 1000; ++i) {
    const float cos_i = static_cast<float>(i) * 1e-3f;
    CHECK(fresnel_conductor(cos_i, 1.5f, 0.0f) ==
          doctest::Approx(fresnel_dielectric(cos_i, 1.5f).reflectance).epsilon(2e-5));
  }
}

TEST_CASE("fresnel: Schlick goes from f0 to white") {
  const Vec3 f0 = vec3(0.04f, 0.5f, 1.0f);
  const Vec3 normal = fresnel_schlick(1.0f, f0), grazing = fresnel_schlick(0.0f, f0);
  CHECK((normal.x == f0.x && normal.y == f0.y && normal.z == f0.z));
  CHECK((grazing.x == 1.0f && grazing.y == 1.0f && grazing.z == 1.0f));
  CHECK(fresnel_schlick(0.5f, f0).x == doctest::Approx(0.04 + 0.96 / 32).epsilon(1e-6));
  CHECK(fresnel_schlick(1.0001f, f0).x == f0.x);
}
