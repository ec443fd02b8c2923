// Rough metal, anisotropic and compensated.
#include <doctest/doctest.h>

#include "scene/albedo_tables.h"
#include "support/bsdf_checks.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

/// A white metal with its table.
class Glossy {
 public:
  Glossy(float alpha_x, float alpha_y, bool compensate) {
    seen_.m = glossy_conductor(alpha_x, alpha_y);
    seen_.m.alpha = std::sqrt(alpha_x * alpha_y);
    if (!compensate) return;
    AlbedoTables tables(tables_);
    seen_.m.compensate = 1;
    seen_.m.table =
        alpha_x == alpha_y ? tables.microfacets() : tables.microfacets(alpha_x, alpha_y);
    seen_.scene.tables = tables_.data();
  }
  Seen<kGlossyConductor> coloured(Vec3 f0) const {
    Seen<kGlossyConductor> copy = seen_;
    copy.m.reflectance = f0;
    return copy;
  }
  const Seen<kGlossyConductor> &operator*() const { return seen_; }

 private:
  Seen<kGlossyConductor> seen_ = {};
  std::vector<float> tables_;
};

constexpr float kPairs[][2] = {{1e-3f, 1e-3f}, {0.02f, 0.02f}, {0.3f, 0.3f}, {1, 1},
                               {0.1f, 0.5f},   {0.8f, 0.05f},  {1e-3f, 0.5f}};

/// How much worse than rounding a half vector may be known.
auto condition(float least_alpha) {
  return [=](Vec3 wo, Vec3 wi) {
    const double wo_h = 0.5 * static_cast<double>(length(wo + wi));
    return std::max(1.0, 0.01 / (static_cast<double>(least_alpha) * wo_h));
  };
}

}  // namespace

TEST_CASE("glossy_conductor: rough lobes follow their density in direction space") {
  for (const Vec3 wo : local_directions())
    check_sampling(*Glossy(0.15f, 0.6f, true), wo, UpperDirections{}, num_samples());
  const Glossy metals[] = {{1, 1, true}, {0.7f, 0.2f, false}};
  for (const Glossy &metal : metals)
    for (const std::size_t i : {0u, 4u, 8u})
      check_sampling(*metal, local_directions()[i], UpperDirections{}, num_samples());
}

TEST_CASE("glossy_conductor: sharp lobes follow their density in half-vector space (M1)") {
  for (const auto &[x, y] : {std::pair(1e-3f, 0.1f), std::pair(0.05f, 5e-3f)})
    for (const std::size_t i : {0u, 2u, 4u, 6u, 8u}) {
      const Vec3 wo = local_directions()[i];
      if (wo.z * std::min(x, y) < 2e-6f) continue;  // less than a cell of the coarse grid
      check_sampling(*Glossy(x, y, false), wo, ReflectingNormals{{static_cast<double>(x), y}},
                     num_samples(), wo.z * std::min(x, y) > 9e-6f);
    }
}

TEST_CASE("glossy_conductor: weight times density is f cos; f is symmetric (M10)") {
  for (const auto &[x, y] : kPairs)
    for (const bool compensate : {false, true}) {
      CAPTURE(x);
      CAPTURE(y);
      const Glossy metal(x, y, compensate);
      CHECK(worst_difference(*metal, condition(std::min(x, y))) < 2e-4);
      CHECK(worst_asymmetry(metal.coloured({0.9f, 0.5f, 0.2f})) < 2e-4);
      check_finite(*metal, 2000);
    }
}

TEST_CASE("glossy_conductor: isotropic and not compensated, it is the basic conductor") {
  Random random(9);
  for (const float alpha : {1e-3f, 0.05f, 0.5f, 1.0f}) {
    const Glossy metal(alpha, alpha, false);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 wo = upper(random), wi = upper(random);
      const Vec2 u = random.square();
      const BsdfValue a = (*metal).eval(wo, wi), b = eval_conductor(conductor(alpha), wo, wi);
      REQUIRE(relative(a.f_cos.x, b.f_cos.x) < 1e-4);
      REQUIRE(relative(a.pdf, b.pdf) < 1e-4);
      const BsdfSample s = sample_bsdf<kGlossyConductor>({}, (*metal).m, 1, wo, u, 0.5f);
      const BsdfSample t = sample_conductor(conductor(alpha), wo, u);
      if (!(t.wi.z > 1e-3f) || is_black(t.weight)) continue;
      REQUIRE(length(s.wi - t.wi) < 1e-5f);
      REQUIRE(relative(s.weight.x, t.weight.x) < 1e-3);
    }
  }
}

TEST_CASE("glossy_conductor: turned by a quarter, the roughnesses change places") {
  const Glossy metal(0.1f, 0.5f, true), turned(0.5f, 0.1f, true);
  Random random(10);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 wo = upper(random), wi = upper(random);
    const BsdfValue a = (*metal).eval(wo, wi);
    const BsdfValue b = (*turned).eval(vec3(-wo.y, wo.x, wo.z), vec3(-wi.y, wi.x, wi.z));
    REQUIRE(relative(a.f_cos.x, b.f_cos.x) < 1e-3);
    REQUIRE(relative(a.pdf, b.pdf) < 1e-3);
  }
}

TEST_CASE("furnace: a compensated white metal reflects 1 +- 0.5 %, from everywhere (M9)") {
  for (const auto &[x, y] : kPairs) {
    const Glossy metal(x, y, true), single(x, y, false);
    for (const Vec3 wo : local_directions()) {
      CAPTURE(x);
      CAPTURE(y);
      CAPTURE(wo.z);
      const Mean mean = albedo(*metal, wo, 200000);
      CHECK(mean.p(1, 5e-3) > alpha());
      const Mean lossy = albedo(*single, wo, 50000);
      CHECK(lossy.mean() <= 1 + 3 * lossy.standard_error());
    }
  }
}

TEST_CASE("glossy_conductor: compensation adds what colour the bounces leave") {
  const Vec3 f0 = {0.9f, 0.5f, 0.1f};
  const Glossy metal(1, 1, true), single(1, 1, false);
  const Vec3 wo = local_directions()[3];
  Random random(11);
  Vec3 with = {0, 0, 0}, without = {0, 0, 0};
  constexpr int kSamples = 200000;
  for (int i = 0; i < kSamples; ++i) {
    with = with + metal.coloured(f0).sample(wo, random).weight * (1.0f / kSamples);
    without = without + single.coloured(f0).sample(wo, random).weight * (1.0f / kSamples);
  }
  // Never more than all that meets the surface and is absorbed once at least.
  const Vec3 most = fresnel_schlick(0.0f, f0);
  CHECK((with.x > without.x && with.x <= most.x));
  CHECK((with.y > without.y && with.z > without.z));
  // Darker colours regain less: each bounce absorbs again.
  CHECK((with.x - without.x) / without.x > (with.y - without.y) / without.y);
  CHECK((with.y - without.y) / without.y > (with.z - without.z) / without.z);
  // A grey reflectance F at every angle regains F^2 E_avg (1 - E) / (1 - F (1 - E_avg)).
  Seen<kGlossyConductor> grey = *metal, grey_single = *single;
  for (Seen<kGlossyConductor> *seen : {&grey, &grey_single}) {
    seen->m.has_ior = 1;
    seen->m.eta = {1, 1, 1};
    seen->m.k = {1e4f, 1e4f, 1e4f};  // F = 1 at every angle
    seen->m.reflectance = {0.5f, 0.5f, 0.5f};
  }
  const double e = albedo(grey_single, wo, 400000).mean();
  const double average = static_cast<double>(average_albedo(grey.scene, grey.m.table, 1.0f));
  const double expected = e + (1 - e) * 0.25 * average / (1 - 0.5 * (1 - average));
  CHECK(albedo(grey, wo, 400000).mean() == doctest::Approx(expected).epsilon(5e-3));
}

TEST_CASE("average_fresnel: of Schlick-like and of perfect metals") {
  CHECK(average_fresnel(1, 1e4) == doctest::Approx(1).epsilon(1e-3));
  // Gold's red by a sum over angles.
  double sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const float mu = (static_cast<float>(i) + 0.5f) / 10000;
    sum += static_cast<double>(2 * mu * fresnel_conductor(mu, 0.166f, 3.15f)) / 10000;
  }
  CHECK(average_fresnel(0.166, 3.15) == doctest::Approx(sum).epsilon(1e-5));
}
