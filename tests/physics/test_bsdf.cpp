// BSDFs: sampling, value and density tell the same story; energy and reciprocity hold.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../../kernels/physics/bsdf.h"
#include "support/local_directions.h"
#include "support/materials.h"
#include "support/random.h"
#include "support/statistics.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

constexpr float kAlphas[] = {1e-3f, 5e-3f, 0.01f, 0.05f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f};

Vec3 upper(Random &random, float least = 1e-3f) {
  Vec3 w = random.direction();
  w.z = std::max(std::fabs(w.z), least);
  return normalize(w);
}

Material gold(float alpha) {
  Material m = conductor(alpha);
  m.has_ior = 1;
  m.eta = {0.166f, 0.42f, 1.35f};
  m.k = {3.15f, 2.37f, 1.88f};
  return m;
}

/// Mean weight of sampled directions: the albedo seen from wo.
template <int Kind>
Mean albedo(const Material &m, Vec3 wo, int samples) {
  Random random(23);
  Mean mean;
  for (int i = 0; i < samples; ++i)
    mean.add(
        static_cast<double>(sample_bsdf<Kind>(m, 1, wo, random.square(), random.unit()).weight.x));
  return mean;
}

/// Integral of f cos by quadrature.
template <int Kind>
double integrated_albedo(const Material &m, Vec3 wo) {
  const auto f_cos = [&](double cosine, double phi) {
    const double sine = std::sqrt(1 - cosine * cosine);
    const Vec3 wi = vec3(static_cast<float>(sine * std::cos(phi)),
                         static_cast<float>(sine * std::sin(phi)), static_cast<float>(cosine));
    return static_cast<double>(eval_bsdf<Kind>(m, wo, wi).f_cos.x);
  };
  double sum = 0;
  for (const double part : cell_masses(hemisphere_grid(32, 64), f_cos)) sum += part;
  return sum;
}

double relative(float a, float b) {
  if (b == 0.0f) return std::fabs(static_cast<double>(a));
  return relative_error(static_cast<double>(a), static_cast<double>(b));
}

}  // namespace

TEST_CASE("bsdf: weight times density is f cos, and both agree on the density") {
  // Worst relative difference. A half vector of rounded directions is known to 1e-7 / (wo.h) only,
  // which matters relative to alpha: differences are divided by that condition, at least 1.
  const auto worst_difference = []<int Kind>(const Material &m) {
    Random random(1);
    double worst = 0;
    for (int i = 0; i < 50000; ++i) {
      const Vec3 wo = i < 9 ? local_directions()[static_cast<std::size_t>(i)] : upper(random);
      const BsdfSample s = sample_bsdf<Kind>(m, 1, wo, random.square(), random.unit());
      if (!(s.pdf > 0)) continue;
      const BsdfValue v = eval_bsdf<Kind>(m, wo, s.wi);
      const double wo_h = 0.5 * static_cast<double>(length(wo + s.wi));
      const double condition =
          Kind == kConductor ? std::max(1.0, 0.01 / (static_cast<double>(m.alpha) * wo_h)) : 1.0;
      for (const double d :
           {relative(v.pdf, s.pdf), relative(v.f_cos.x, s.weight.x * s.pdf),
            relative(v.f_cos.y, s.weight.y * s.pdf), relative(v.f_cos.z, s.weight.z * s.pdf)})
        worst = std::max(worst, d / condition);
    }
    return worst;
  };
  CHECK(worst_difference.operator()<kDiffuse>(diffuse(0.7f)) < 1e-6);
  for (const float alpha : kAlphas) {
    CAPTURE(alpha);
    CHECK(worst_difference.operator()<kConductor>(gold(alpha)) < 1e-4);
  }
}

TEST_CASE("bsdf: f(wo, wi) = f(wi, wo) (M10)") {
  Random random(2);
  const auto check = [&]<int Kind>(const Material &m) {
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
      const Vec3 wo = upper(random), wi = upper(random);
      const float f = eval_bsdf<Kind>(m, wo, wi).f_cos.y / wi.z;
      const float g = eval_bsdf<Kind>(m, wi, wo).f_cos.y / wo.z;
      worst = std::max(worst, relative(f, g));
    }
    return worst;
  };
  CHECK(check.operator()<kDiffuse>(diffuse(0.5f)) < 1e-6);
  for (const float alpha : {1e-3f, 0.01f, 0.1f, 0.5f, 1.0f}) {
    CAPTURE(alpha);
    CHECK(check.operator()<kConductor>(gold(alpha)) < 1e-4);
    CHECK(check.operator()<kConductor>(conductor(alpha)) < 1e-4);
  }
}

TEST_CASE("furnace: white diffuse reflects everything, from everywhere") {
  for (const Vec3 wo : local_directions()) {
    const Mean mean = albedo<kDiffuse>(diffuse(1), wo, 100000);
    CHECK(mean.mean() == 1.0);  // the weight is the albedo itself
    CHECK(integrated_albedo<kDiffuse>(diffuse(1), wo) == doctest::Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("furnace: a white conductor never gains energy, and both integrals agree (M9)") {
  for (const float alpha : kAlphas)
    for (const Vec3 wo : local_directions()) {
      const Mean mean = albedo<kConductor>(conductor(alpha), wo, 100000);
      CAPTURE(alpha);
      CAPTURE(wo.z);
      CHECK(mean.mean() <= 1 + 3 * mean.standard_error());
      if (alpha >= 0.1f)
        CHECK(mean.p(integrated_albedo<kConductor>(conductor(alpha), wo), 2e-4) > test::alpha());
    }
}

TEST_CASE("furnace: known losses of single-scattering GGX (M9)") {
  // alpha = 1 seen along the normal: 1 - ln 2.
  const Vec3 up = vec3(0, 0, 1);
  CHECK(integrated_albedo<kConductor>(conductor(1), up) == doctest::Approx(0.306853).epsilon(2e-5));
  CHECK(albedo<kConductor>(conductor(1), up, 1000000).p(0.30685282) > test::alpha());
  // Averages over a white environment.
  const float alphas[] = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};
  const double losses[] = {0.028, 0.118, 0.300, 0.464, 0.590};
  Random random(3);
  for (int i = 0; i < 5; ++i) {
    Mean mean;
    for (int n = 0; n < 400000; ++n) {
      const Vec3 wo = square_to_cosine_hemisphere(random.square());
      if (!(wo.z > 0)) continue;
      mean.add(1 - static_cast<double>(
                       sample_conductor(conductor(alphas[i]), wo, random.square()).weight.x));
    }
    CAPTURE(alphas[i]);
    CHECK(mean.mean() == doctest::Approx(losses[i]).epsilon(0.02));
  }
}

TEST_CASE("conductor: weights are finite and at most the Fresnel term, however grazing (M2)") {
  Random random(4);
  for (const float alpha : kAlphas)
    for (const float z : {1.0f, 1e-3f, 1e-5f, 1e-7f}) {
      const Vec3 wo = normalize(vec3(std::sqrt(1 - z * z), 0, z));
      for (int i = 0; i < 20000; ++i) {
        const BsdfSample s = sample_conductor(conductor(alpha), wo, random.square());
        REQUIRE(all_finite(s.weight));
        REQUIRE(is_finite(s.pdf));
        REQUIRE((s.weight.x >= 0.0f && s.weight.x <= 1.0f));
        REQUIRE(std::fabs(length(s.wi) - 1) < 1e-6f);
        const BsdfValue v = eval_conductor(conductor(alpha), wo, s.wi);
        REQUIRE(all_finite(v.f_cos));
        REQUIRE(is_finite(v.pdf));
      }
    }
}

TEST_CASE("conductor: nothing below the horizon, and the smooth limit is a mirror") {
  const Vec3 wo = normalize(vec3(0.3f, -0.4f, 0.7f));
  CHECK(eval_conductor(gold(0.5f), wo, vec3(0, 0.6f, -0.8f)).pdf == 0.0f);
  CHECK(eval_conductor(gold(0.5f), wo, vec3(1, 0, 0)).pdf == 0.0f);
  Material smooth = material(kConductor, 0.5f);
  smooth.alpha = 1e-3f;
  const float expected = sample_mirror(material(kMirror, 0.5f), wo).weight.x;
  CHECK(albedo<kConductor>(smooth, wo, 100000).mean() == doctest::Approx(expected).epsilon(1e-3));
}

TEST_CASE("conductor: Fresnel by index where given, else by colour") {
  CHECK(conductor_fresnel(gold(0.5f), 1.0f).x == fresnel_conductor(1.0f, 0.166f, 3.15f));
  CHECK(conductor_fresnel(gold(0.5f), 0.3f).z == fresnel_conductor(0.3f, 1.35f, 1.88f));
  CHECK(conductor_fresnel(material(kConductor, 0.25f), 1.0f).y == 0.25f);
}

TEST_CASE("mirror: reflects about the normal with Schlick's weight") {
  const Vec3 wo = normalize(vec3(0.1f, -0.5f, 0.6f));
  const BsdfSample s = sample_mirror(mirror(0.9f), wo);
  CHECK((s.wi.x == -wo.x && s.wi.y == -wo.y && s.wi.z == wo.z));
  CHECK(s.pdf == 0.0f);
  CHECK(s.weight.x == fresnel_schlick(wo.z, vec3(0.9f, 0.9f, 0.9f)).x);
}

TEST_CASE("diffuse: u on the edge of the square is a zero sample or a valid one (G8)") {
  const float most = 1 - 0x1p-24f;
  for (const float x : {0.0f, 0.5f, most})
    for (const float y : {0.0f, 0.5f, most}) {
      const BsdfSample s = sample_diffuse(diffuse(1), vec2(x, y));
      CHECK((s.pdf > 0 || is_black(s.weight)));
      CHECK((s.wi.z > 0 || is_black(s.weight)));
    }
  CHECK(eval_diffuse(diffuse(1), vec3(0, 0, -1)).pdf == 0.0f);
}

TEST_CASE("diffuse: throughput of 10^4 white bounces stays 1 (M6)") {
  Random random(5);
  float throughput = 1;
  for (int i = 0; i < 10000; ++i) {
    const BsdfSample s = sample_diffuse(diffuse(1), random.square());
    if (s.pdf > 0) throughput = throughput * s.weight.x;
  }
  CHECK(throughput == 1.0f);
}
