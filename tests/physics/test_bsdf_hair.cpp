// Hair: the lobes are normalised and sampled as they say; without absorption nothing is lost.
#include <doctest/doctest.h>

#include "support/bsdf_checks.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

constexpr float kRoughnesses[] = {0, 0.1f, 0.3f, 0.6f, 1};

Seen<kHair> hair(float longitudinal, float azimuthal, float absorption = 0) {
  Material m = material(kHair, 0);
  m.roughness = longitudinal;
  m.alpha = azimuthal;
  m.ior = 1.55f;
  m.tilt = 0.0349f;  // 2 degrees
  m.transmittance = vec3(absorption, absorption, absorption);
  return {m};
}

/// Integral of f cos over all directions.
double whole_albedo(const Seen<kHair> &seen, Vec3 wo) {
  const auto f_cos = [&](double cosine, double phi) {
    return static_cast<double>(seen.eval(wo, direction(cosine, phi)).f_cos.x);
  };
  double sum = 0;
  for (const double part : cell_masses(sphere_grid(32, 64), f_cos)) sum += part;
  return sum;
}

/// The model written down as in the papers, in double precision, with functions of the library.
double reference_f_cos(const Material &m, Vec3 wo, Vec3 wi) {
  const auto wide = [](float x) { return static_cast<double>(x); };
  const double b = wide(m.roughness), n = wide(m.alpha), eta = wide(m.ior),
               tilt = std::asin(wide(m.tilt));
  const double v = std::pow(0.726 * b + 0.812 * b * b + 3.7 * std::pow(b, 20), 2);
  const double s = std::sqrt(kPi / 8) * (0.265 * n + 1.194 * n * n + 5.372 * std::pow(n, 22));
  const double theta_o = std::asin(wide(wo.x)), theta_i = std::asin(wide(wi.x));
  const double phi_o = std::atan2(wide(wo.y), wide(wo.z)),
               phi_i = std::atan2(wide(wi.y), wide(wi.z));
  const double h = std::sin(phi_o);
  const double eta_p = std::sqrt(eta * eta - std::pow(std::sin(theta_o), 2)) / std::cos(theta_o);
  const double gamma_o = std::asin(h), gamma_t = std::asin(h / eta_p);
  const double cos_t = std::sqrt(1 - std::pow(std::sin(theta_o) / eta, 2));
  const double t = std::exp(-wide(m.transmittance.x) * 2 * std::cos(gamma_t) / cos_t);
  const Refraction fresnel = fresnel_dielectric(wo.z, m.ior);
  const double f = wide(fresnel.reflectance);
  const double a[] = {f, (1 - f) * (1 - f) * t, (1 - f) * (1 - f) * t * t * f,
                      (1 - f) * (1 - f) * t * t * t * f * f / (1 - t * f)};
  const double variances[] = {v, v / 4, 4 * v, 4 * v};
  const double tilts[] = {-2 * tilt, tilt, 4 * tilt, 0};
  double sum = 0;
  for (int p = 0; p < 4; ++p) {
    const double o = theta_o + tilts[p], w = variances[p];
    const double longitudinal =
        std::exp(-std::sin(theta_i) * std::sin(o) / w) *
        std::cyl_bessel_i(0, std::fabs(std::cos(theta_i) * std::cos(o)) / w) /
        (2 * w * std::sinh(1 / w));
    const double x =
        std::remainder(phi_i - phi_o - (2 * p * gamma_t - 2 * gamma_o + p * kPi), 2 * kPi);
    const auto distribution = [s](double at) { return 1 / (1 + std::exp(-at / s)); };
    const double logistic =
        std::exp(-std::fabs(x) / s) / (s * std::pow(1 + std::exp(-std::fabs(x) / s), 2));
    const double azimuthal =
        p == 3 ? 1 / (2 * kPi) : logistic / (distribution(kPi) - distribution(-kPi));
    sum += a[p] * longitudinal * azimuthal;
  }
  return sum;
}

/// The direction with most light among those around `centre`.
Vec3 brightest(const Seen<kHair> &seen, Vec3 wo, Vec3 centre, float reach) {
  Random random(6);
  Vec3 best = centre;
  float most = 0;
  for (int i = 0; i < 40000; ++i) {
    const Vec3 wi = normalize(centre + random.direction() * (reach * random.unit()));
    const float f = seen.eval(wo, wi).f_cos.x;
    if (f > most) best = wi;
    most = std::max(most, f);
  }
  return best;
}

}  // namespace

TEST_CASE("hair: the Bessel function") {
  for (double x = 0; x < 1000; x = x * 1.05 + 0.01) {
    // e^-x I0(x) overflows on its way beyond 700; its series does not.
    const double expected = x < 600 ? std::exp(-x) * std::cyl_bessel_i(0, x)
                                    : (1 + 1 / (8 * x)) / std::sqrt(2 * kPi * x);
    CHECK(relative_error(static_cast<double>(scaled_bessel_i0(static_cast<float>(x))), expected) <
          1e-6);
  }
}

TEST_CASE("hair: longitudinal and azimuthal lobes integrate to 1") {
  for (const float roughness : kRoughnesses) {
    CAPTURE(roughness);
    for (const float factor : {0.25f, 1.0f, 4.0f})
      for (const double theta : {0.0, 0.7, -1.4, 1.57}) {
        const float s = static_cast<float>(std::sin(theta)),
                    c = static_cast<float>(std::cos(theta));
        const auto lobe = [&](double at) {
          const double cosine = std::cos(at);
          return cosine * static_cast<double>(hair_longitudinal(static_cast<float>(std::sin(at)),
                                                                static_cast<float>(cosine), s, c,
                                                                factor * hair_variance(roughness)));
        };
        double sum = 0;
        for (int i = 0; i < 512; ++i)
          sum += integrate(lobe, (i / 512.0 - 0.5) * kPi, ((i + 1) / 512.0 - 0.5) * kPi, 1e-9, 8);
        CHECK(sum == doctest::Approx(1).epsilon(1e-5));
      }
    const auto lobe = [&](double turns) {
      return 2 * kPi *
             static_cast<double>(
                 hair_azimuthal(static_cast<float>(turns), hair_logistic_scale(roughness)));
    };
    double sum = 0;
    for (int i = 0; i < 512; ++i) sum += integrate(lobe, i / 512.0, (i + 1) / 512.0, 1e-9, 8);
    CHECK(sum == doctest::Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("hair: samples of each lobe follow it, however sharp") {
  Random random(7);
  constexpr int kCells = 100, kDraws = 400000;
  for (const float roughness : kRoughnesses) {
    CAPTURE(roughness);
    // Longitudinal: position on the sphere along the lobe's axis, (1 - cos) / variance, is exponential
    // (cut at the sphere's end), so its distribution function is uniform.
    for (const float sin_o : {0.0f, 0.6f, -0.999f}) {
      const float cos_o = std::sqrt(1 - sin_o * sin_o), v = hair_variance(roughness);
      Histogram across({kCells, 1, -1, 1, 0, 1});
      for (int i = 0; i < kDraws; ++i) {
        const Vec2 u = random.square();
        const Vec2 theta = sample_hair_longitudinal(sin_o, cos_o, v, u.x, u.y);
        across.add(static_cast<double>(theta.x), 0.5);
        REQUIRE(std::fabs(theta.x * theta.x + theta.y * theta.y - 1) < 1e-5f);
      }
      const auto density = [&](double s, double) {
        const double c = std::sqrt(std::max(1 - s * s, 0.0));
        return static_cast<double>(
            hair_longitudinal(static_cast<float>(s), static_cast<float>(c), sin_o, cos_o, v));
      };
      std::vector<double> masses(kCells);
      for (int i = 0; i < kCells; ++i)
        for (int j = 0; j < 40; ++j) {
          const double a = -1 + 2 * (i + j / 40.0) / kCells, b = a + 2.0 / (40 * kCells);
          masses[static_cast<std::size_t>(i)] +=
              integrate([&](double s) { return density(s, 0); }, a, b, 1e-8, 8);
        }
      const Fit fit = chi_square_fit(across, masses);
      INFO(fit.text());
      CHECK(fit.accepted());
    }
    // Azimuthal: logistic, so that ln(p / (1 - p)) of the distribution function is x / scale.
    const float scale = hair_logistic_scale(roughness);
    const double cut = 1 / (1 + std::exp(0.5 / static_cast<double>(scale)));
    Histogram even({kCells, 1, 0, 1, 0, 1});
    for (int i = 0; i < kDraws; ++i) {
      const double x = static_cast<double>(sample_hair_azimuthal(random.unit(), scale));
      const double p = 1 / (1 + std::exp(-x / static_cast<double>(scale)));
      even.add((p - cut) / (1 - 2 * cut), 0.5);
    }
    const Fit fit = chi_square_fit(even, std::vector<double>(kCells, 1.0 / kCells));
    INFO(fit.text());
    CHECK(fit.accepted());
  }
}

TEST_CASE("hair: directions follow the density, which integrates to 1") {
  for (const Vec3 wo : local_directions())
    check_sampling(hair(0.3f, 0.3f), wo, AllDirections{}, num_samples());
  for (const Seen<kHair> &seen : {hair(0.6f, 0.25f, 0.5f), hair(1, 1, 2)})
    for (const std::size_t i : {0u, 4u, 8u})
      check_sampling(seen, local_directions()[i], AllDirections{}, num_samples());
}

TEST_CASE("hair: the value is that of the papers") {
  Random random(9);
  for (const float longitudinal : {0.25f, 0.5f, 1.0f})
    for (const float azimuthal : {0.2f, 0.6f, 1.0f})
      for (const float absorption : {0.0f, 0.8f})
        for (int i = 0; i < 300; ++i) {
          const Seen<kHair> seen = hair(longitudinal, azimuthal, absorption);
          const Vec3 wo = upper(random, 0.05f), wi = random.direction();
          const double expected = reference_f_cos(seen.m, wo, wi);
          CAPTURE(longitudinal);
          CAPTURE(azimuthal);
          CHECK(static_cast<double>(seen.eval(wo, wi).f_cos.x) ==
                doctest::Approx(expected).epsilon(1e-4).scale(1e-3));
        }
}

TEST_CASE("hair: sample and eval agree") {
  for (const float longitudinal : kRoughnesses)
    for (const float azimuthal : kRoughnesses) {
      CAPTURE(longitudinal);
      CAPTURE(azimuthal);
      // Far out in the tails of sharp lobes the rounding of a direction counts a hundredfold.
      const double least = static_cast<double>(std::min(longitudinal, azimuthal));
      CHECK(worst_difference(hair(longitudinal, azimuthal, 0.7f)) < (least < 0.3 ? 1e-2 : 1e-4));
    }
}

TEST_CASE("furnace: hair that absorbs nothing scatters everything, with weights of 1") {
  Random random(8);
  for (const float longitudinal : kRoughnesses)
    for (const float azimuthal : kRoughnesses)
      for (const Vec3 wo : local_directions())
        for (int i = 0; i < 1000; ++i) {
          const BsdfSample s = hair(longitudinal, azimuthal).sample(wo, random);
          REQUIRE(std::fabs(s.weight.x - 1) < 1e-5f);
        }
  for (const float roughness : {0.3f, 0.6f, 1.0f})
    for (const Vec3 wo : local_directions())
      CHECK(whole_albedo(hair(roughness, roughness), wo) == doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("hair: absorbs as much by its samples as by its value") {
  for (const float absorption : {0.1f, 1.0f, 30.0f})
    for (const Vec3 wo : local_directions()) {
      const Seen<kHair> seen = hair(0.5f, 0.4f, absorption);
      const Mean mean = albedo(seen, wo, 50000);
      CHECK(mean.mean() < 1);
      CHECK(mean.p(whole_albedo(seen, wo), 5e-4) > alpha());
    }
}

TEST_CASE("hair: reflects about the normal, and without refraction lets light straight through") {
  const Vec3 wo = normalize(vec3(0.3f, 0.4f, 0.8f));
  Seen<kHair> seen = hair(0.05f, 0.05f, 100);  // nothing gets through
  seen.m.tilt = 0;
  const Vec3 mirrored = vec3(-wo.x, -wo.y, wo.z);
  CHECK(dot(brightest(seen, wo, mirrored, 0.3f), mirrored) > 0.9999f);
  seen = hair(0.05f, 0.05f);
  seen.m.tilt = 0;
  seen.m.ior = 1;
  CHECK(dot(brightest(seen, wo, neg(wo), 0.3f), neg(wo)) > 0.9999f);
}

TEST_CASE("hair: the scales turn the highlight towards the tip") {
  Seen<kHair> seen = hair(0.05f, 0.05f, 100);
  seen.m.tilt = 0.1f;
  const Vec3 wi = brightest(seen, vec3(0, 0, 1), vec3(0.2f, 0, 1), 0.3f);
  CHECK(wi.x == doctest::Approx(std::sin(2 * std::asin(0.1))).epsilon(0.02));
}

TEST_CASE("hair: finite everywhere") {
  for (const float roughness : kRoughnesses)
    for (const float absorption : {0.0f, 1.0f, 1e3f, 1e30f})
      for (const float ior : {1.0f, 1.55f, 3.0f}) {
        Seen<kHair> seen = hair(roughness, roughness, absorption);
        seen.m.ior = ior;
        check_finite(seen, 300);
      }
}
