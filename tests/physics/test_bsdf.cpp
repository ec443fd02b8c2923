// BSDFs: sampling, value and density tell the same story; energy and reciprocity hold.
#include <doctest/doctest.h>

#include "support/bsdf_checks.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

constexpr float kAlphas[] = {1e-3f, 5e-3f, 0.01f, 0.05f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f};

Material gold(float alpha) {
  Material m = conductor(alpha);
  m.has_ior = 1;
  m.eta = {0.166f, 0.42f, 1.35f};
  m.k = {3.15f, 2.37f, 1.88f};
  return m;
}

}  // namespace

TEST_CASE("bsdf: weight times density is f cos, and both agree on the density") {
  CHECK(worst_difference(Seen<kDiffuse>{diffuse(0.7f)}) < 1e-6);
  for (const float alpha : kAlphas) {
    CAPTURE(alpha);
    // A half vector of rounded directions is known to 1e-7 / (wo.h) only, which matters relative to
    // alpha.
    const auto condition = [&](Vec3 wo, Vec3 wi) {
      const double wo_h = 0.5 * static_cast<double>(length(wo + wi));
      return std::max(1.0, 0.01 / (static_cast<double>(alpha) * wo_h));
    };
    CHECK(worst_difference(Seen<kConductor>{gold(alpha)}, condition) < 1e-4);
  }
}

TEST_CASE("bsdf: f(wo, wi) = f(wi, wo) (M10)") {
  CHECK(worst_asymmetry(Seen<kDiffuse>{diffuse(0.5f)}) < 1e-6);
  for (const float alpha : {1e-3f, 0.01f, 0.1f, 0.5f, 1.0f}) {
    CAPTURE(alpha);
    CHECK(worst_asymmetry(Seen<kConductor>{gold(alpha)}) < 1e-4);
    CHECK(worst_asymmetry(Seen<kConductor>{conductor(alpha)}) < 1e-4);
  }
}

TEST_CASE("furnace: white diffuse reflects everything, from everywhere") {
  for (const Vec3 wo : local_directions()) {
    const Mean mean = albedo(Seen<kDiffuse>{diffuse(1)}, wo, 100000);
    CHECK(mean.mean() == 1.0);  // the weight is the albedo itself
    CHECK(integrated_albedo(Seen<kDiffuse>{diffuse(1)}, wo) == doctest::Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("furnace: a white conductor never gains energy, and both integrals agree (M9)") {
  for (const float alpha : kAlphas)
    for (const Vec3 wo : local_directions()) {
      const Mean mean = albedo(Seen<kConductor>{conductor(alpha)}, wo, 100000);
      CAPTURE(alpha);
      CAPTURE(wo.z);
      CHECK(mean.mean() <= 1 + 3 * mean.standard_error());
      if (alpha >= 0.1f)
        CHECK(mean.p(integrated_albedo(Seen<kConductor>{conductor(alpha)}, wo), 2e-4) >
              test::alpha());
    }
}

TEST_CASE("furnace: known losses of single-scattering GGX (M9)") {
  // alpha = 1 seen along the normal: 1 - ln 2.
  const Vec3 up = vec3(0, 0, 1);
  CHECK(integrated_albedo(Seen<kConductor>{conductor(1)}, up) ==
        doctest::Approx(0.306853).epsilon(2e-5));
  CHECK(albedo(Seen<kConductor>{conductor(1)}, up, 1000000).p(0.30685282) > test::alpha());
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
  CHECK(albedo(Seen<kConductor>{smooth}, wo, 100000).mean() ==
        doctest::Approx(expected).epsilon(1e-3));
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
