// Rough diffuse surfaces: energy-preserving Oren-Nayar.
#include <doctest/doctest.h>

#include "support/bsdf_checks.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

constexpr float kRoughnesses[] = {0, 1e-3f, 0.25f, 0.5f, 1};

Seen<kRoughDiffuse> surface(float albedo, float roughness) {
  return {rough_diffuse(albedo, roughness)};
}

/// Albedo of FON by quadrature, in double, from its definition.
double fon_albedo(double mu, double r) {
  const double a = 1 / (1 + (0.5 - 2 / (3 * kPi)) * r), so = std::sqrt(1 - mu * mu);
  const auto f_cos = [&](double cosine, double phi) {
    const double s = so * std::sqrt(1 - cosine * cosine) * std::cos(phi);
    return cosine / kPi * a * (1 + r * (s > 0 ? s / std::max(mu, cosine) : s));
  };
  return integrate(f_cos, 0, 1, 0, 2 * kPi, 1e-7, 20);
}

}  // namespace

TEST_CASE("rough_diffuse: the loss of single scattering is that of its albedo") {
  for (const float mu : {1.0f, 0.9f, 0.5f, 0.1f, 0.01f})
    for (const double r : {0.3, 1.0}) {
      const double a = 1 / (1 + (0.5 - 2 / (3 * kPi)) * r);
      CHECK(1 - a * r * static_cast<double>(fon_loss(mu)) ==
            doctest::Approx(fon_albedo(static_cast<double>(mu), r)).epsilon(1e-5));
    }
  CHECK(fon_loss(0.0f) < 1e-6f);
  CHECK(fon_loss(1.0f) == doctest::Approx(PHALANX_FON_1));
}

TEST_CASE("rough_diffuse: directions follow the density, which integrates to 1") {
  check_sampling(surface(0.8f, 0.5f), local_directions()[4], UpperDirections{}, num_samples());
}

TEST_CASE("rough_diffuse: weight times density is f cos; f is symmetric (M10)") {
  for (const float roughness : kRoughnesses) {
    CHECK(worst_difference(surface(0.7f, roughness)) < 1e-6);
    CHECK(worst_asymmetry(surface(0.7f, roughness)) < 1e-5);
    check_finite(surface(1, roughness));
  }
}

TEST_CASE("furnace: white rough diffuse reflects everything, from everywhere (M9)") {
  for (const float roughness : kRoughnesses)
    for (const Vec3 wo : local_directions()) {
      CAPTURE(roughness);
      CAPTURE(wo.z);
      const double exact = integrated_albedo(surface(1, roughness), wo);
      CHECK(exact == doctest::Approx(1).epsilon(3e-5));
      CHECK(albedo(surface(1, roughness), wo, 100000).p(1, 1e-4) > alpha());
    }
}

TEST_CASE("rough_diffuse: smooth is Lambert; grey loses what multiple scattering absorbs") {
  const Vec3 wo = local_directions()[3], wi = local_directions()[5];
  CHECK(surface(0.4f, 0).eval(wo, wi).f_cos.x ==
        doctest::Approx(eval_diffuse(diffuse(0.4f), wi).f_cos.x).epsilon(1e-6));
  const double dark = integrated_albedo(surface(0.4f, 1), wo);
  const double single = 0.4 * fon_albedo(static_cast<double>(wo.z), 1);
  CHECK(dark > single);
  CHECK(dark < 0.4);
}
