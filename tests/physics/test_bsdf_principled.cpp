// Principled: energy, reciprocity and sampling over the whole range of its parameters.
#include <doctest/doctest.h>

#include "scene/albedo_tables.h"
#include "support/bsdf_checks.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

/// A scene that holds the tables.
SceneView tables() {
  static std::vector<float> floats;
  if (floats.empty()) AlbedoTables(floats).principled();
  SceneView scene = {};
  scene.tables = floats.data();
  return scene;
}

Seen<kPrincipled> principled(float alpha) {
  Material m = material(kPrincipled, 1);
  m.alpha = alpha;
  m.ior = 1.5f;
  m.table = 0;
  m.clearcoat_alpha = 0.01f;
  m.sheen_alpha = 0.25f;
  return {m, 1, tables()};
}

/// Every corner of the parameters, white, for one roughness.
std::vector<Seen<kPrincipled>> corners(float alpha) {
  std::vector<Seen<kPrincipled>> all;
  for (const float metallic : {0.0f, 0.5f, 1.0f})
    for (const float transmission : {0.0f, 0.5f, 1.0f})
      for (const float clearcoat : {0.0f, 1.0f})
        for (const float sheen : {0.0f, 1.0f}) {
          if (metallic == 1 && transmission > 0) continue;  // nothing to transmit
          Seen<kPrincipled> seen = principled(alpha);
          seen.m.metallic = metallic;
          seen.m.transmission = transmission;
          seen.m.clearcoat = clearcoat;
          seen.m.sheen = vec3(sheen, sheen, sheen);
          all.push_back(seen);
        }
  return all;
}

/// Any parameters at all.
Seen<kPrincipled> any_principled(Random &random) {
  const auto unit = [&] {
    return random.chance(0.3) ? static_cast<float>(random.below(2)) : random.unit();
  };
  const auto colour = [&] { return vec3(unit(), unit(), unit()); };
  const auto alpha = [&] { return random.chance(0.2) ? 1e-3f : std::pow(random.unit(), 2.0f); };
  Seen<kPrincipled> seen = principled(alpha());
  Material &m = seen.m;
  m.reflectance = colour();
  m.metallic = unit();
  m.transmission = unit();
  m.specular_level = unit();
  m.specular = colour();
  m.clearcoat = unit();
  m.clearcoat_alpha = alpha();
  m.sheen = random.chance(0.5) ? vec3(0, 0, 0) : colour();
  m.sheen_alpha = alpha();
  m.ior = random.chance(0.1) ? 1.0f : 1 + 2 * random.unit();
  seen.front = random.below(2);
  return seen;
}

std::string text(const Seen<kPrincipled> &seen) {
  const Material &m = seen.m;
  std::string all;
  for (const float x :
       {m.alpha, m.metallic, m.transmission, m.clearcoat, m.clearcoat_alpha, m.sheen.x,
        m.sheen_alpha, m.ior, m.specular_level, m.specular.x, m.reflectance.x})
    all += std::to_string(x) + " ";
  return all + (seen.front != 0 ? "front" : "back");
}

}  // namespace

TEST_CASE("furnace: a white principled material never gains energy (M9)") {
  int num_tests = 0;
  for (const float alpha : {1e-3f, 0.0025f, 0.01f, 0.1f, 0.5f, 1.0f})
    for (Seen<kPrincipled> seen : corners(alpha))
      for (const int32 front : {1, 0}) {
        seen.front = front;
        for (const Vec3 wo : local_directions()) {
          const Mean mean = albedo(seen, wo, 3000);
          INFO(text(seen));
          CAPTURE(wo.z);
          CAPTURE(mean.standard_error());
          CHECK(mean.mean() <= 1 + 3 * mean.standard_error() + 1e-6);
          ++num_tests;
        }
      }
  CHECK(num_tests > 2000);
}

TEST_CASE("furnace: the albedo by quadrature is at most 1, whatever the parameters") {
  Random random(31);
  for (int i = 0; i < 12; ++i) {
    Seen<kPrincipled> seen = any_principled(random);
    seen.m.reflectance = vec3(1, 1, 1);
    seen.m.transmission = 0;
    seen.m.alpha = std::max(seen.m.alpha, 0.1f);
    seen.m.clearcoat_alpha = std::max(seen.m.clearcoat_alpha, 0.1f);
    for (const Vec3 wo : local_directions()) {
      INFO(text(seen));
      CAPTURE(wo.z);
      CHECK(integrated_albedo(seen, wo) <= 1.0001);
    }
  }
}

TEST_CASE("furnace: plastic and metal lose hardly anything, however rough") {
  for (const float alpha : {1e-3f, 0.01f, 0.1f, 0.5f, 1.0f})
    for (const float metallic : {0.0f, 0.5f, 1.0f})
      for (const Vec3 wo : local_directions()) {
        Seen<kPrincipled> seen = principled(alpha);
        seen.m.metallic = metallic;
        const Mean mean = albedo(seen, wo, 20000);
        CAPTURE(alpha);
        CAPTURE(metallic);
        CAPTURE(wo.z);
        CHECK(mean.mean() > 0.985 - 3 * mean.standard_error());
      }
}

TEST_CASE("principled: reciprocal, refraction too (M10)") {
  Random random(32);
  for (int i = 0; i < 40; ++i) {
    Seen<kPrincipled> seen = any_principled(random);
    seen.m.alpha = std::max(seen.m.alpha, 0.05f);
    seen.m.clearcoat_alpha = std::max(seen.m.clearcoat_alpha, 0.05f);
    seen.m.ior = std::max(seen.m.ior, 1.2f);  // half vectors of refraction are short below
    INFO(text(seen));
    CHECK(worst_asymmetry(seen, 2000) < 1e-2);
  }
}

TEST_CASE("principled: sample and eval agree") {
  Random random(33);
  for (int i = 0; i < 60; ++i) {
    const Seen<kPrincipled> seen = any_principled(random);
    // A half vector of rounded directions is known to 1e-7 / |wo + eta wi|, against lobes of width alpha.
    const float alpha = std::min(seen.m.alpha, seen.m.clearcoat_alpha);
    const float eta = static_cast<float>(seen.eta());
    const auto condition = [&](Vec3 wo, Vec3 wi) {
      const float size = length(wo + wi * (wi.z > 0 ? 1.0f : eta));
      return 1 + 1e-2 / static_cast<double>(alpha * size * size);
    };
    INFO(text(seen));
    CHECK(worst_difference(seen, condition, 3000) < 1e-3);
  }
}

TEST_CASE("principled: directions follow the density, which integrates to 1 less what is lost") {
  Seen<kPrincipled> plastic = principled(0.3f), everything = principled(0.25f);
  plastic.m.clearcoat = 0.7f;
  plastic.m.clearcoat_alpha = 0.15f;
  plastic.m.reflectance = vec3(0.5f, 0.3f, 0.2f);
  everything.m.metallic = 0.3f;
  everything.m.transmission = 0.6f;
  everything.m.clearcoat = 0.5f;
  everything.m.clearcoat_alpha = 0.5f;
  everything.m.sheen = vec3(0.5f, 0.8f, 0.3f);
  for (const Vec3 wo : local_directions())
    check_sampling(everything, wo, AllDirections{}, num_samples());
  for (const std::size_t i : {0u, 4u, 8u})
    check_sampling(plastic, local_directions()[i], UpperDirections{}, num_samples());
  check_sampling(everything.from_behind(), local_directions()[3], AllDirections{}, num_samples());
}

TEST_CASE("principled: sharp lobes follow their density in half-vector space (M1)") {
  Seen<kPrincipled> metal = principled(1e-3f), glass = principled(5e-3f);
  metal.m.metallic = 1;
  glass.m.transmission = 1;
  for (const std::size_t i : {0u, 3u, 5u}) {
    const Vec3 wo = local_directions()[i];
    check_sampling(metal, wo, ReflectingNormals{{1e-3}}, num_samples());
    check_sampling(glass, wo, RefractingNormals{{5e-3}, 1.5}, num_samples());
    check_sampling(glass.from_behind(), wo, RefractingNormals{{5e-3}, 1 / 1.5}, num_samples());
  }
}

TEST_CASE("principled: samples bring what the value says") {
  Random random(34);
  for (int i = 0; i < 5; ++i) {
    Seen<kPrincipled> seen = any_principled(random);
    seen.m.transmission = 0;
    seen.m.alpha = std::max(seen.m.alpha, 0.15f);
    seen.m.clearcoat_alpha = std::max(seen.m.clearcoat_alpha, 0.15f);
    for (const Vec3 wo : local_directions()) {
      INFO(text(seen));
      CAPTURE(wo.z);
      CHECK(albedo(seen, wo, 30000).p(integrated_albedo(seen, wo), 5e-4) > alpha());
    }
  }
}

TEST_CASE("principled: lobes are sampled by what they bring: weights stay near 1") {
  Random random(35);
  for (int i = 0; i < 100; ++i) {
    const Seen<kPrincipled> seen = any_principled(random);
    Mean square;
    for (int j = 0; j < 5000; ++j) {
      const BsdfSample s = seen.sample(upper(random), random);
      const double radiance = s.wi.z < 0 ? seen.eta() * seen.eta() : 1;
      square.add(std::pow(static_cast<double>(max_component(s.weight)) * radiance, 2));
    }
    INFO(text(seen));
    CHECK(square.mean() < 2);
  }
}

TEST_CASE("principled: finite everywhere") {
  Random random(36);
  for (int i = 0; i < 300; ++i) check_finite(any_principled(random), 50);
}

TEST_CASE("principled: its corners are the materials they claim to be") {
  const Vec3 wo = normalize(vec3(0.3f, 0.1f, 0.7f)), wi = normalize(vec3(-0.2f, 0.4f, 0.5f));
  // Metal is GGX with Schlick's reflectance, and what it scatters more than once.
  Seen<kPrincipled> metal = principled(0.01f);
  metal.m.metallic = 1;
  metal.m.reflectance = vec3(0.9f, 0.6f, 0.3f);
  Material gold = conductor(0.01f);
  gold.reflectance = metal.m.reflectance;
  const Vec3 mirrored = vec3(-wo.x, -wo.y, wo.z);
  CHECK(metal.eval(wo, mirrored).f_cos.y ==
        doctest::Approx(Seen<kConductor>{gold}.eval(wo, mirrored).f_cos.y).epsilon(1e-3));
  // Without specular there is only diffuse.
  Seen<kPrincipled> matte = principled(0.5f);
  matte.m.specular_level = 0;
  CHECK(matte.eval(wo, wi).f_cos.x == doctest::Approx(wi.z * PHALANX_INV_PI).epsilon(1e-5));
  // Glass is the rough dielectric.
  Seen<kPrincipled> glass = principled(0.2f);
  glass.m.transmission = 1;
  Material dielectric = material(kRoughDielectric, 0);
  dielectric.alpha = 0.2f;
  dielectric.ior = 1.5f;
  for (const int32 front : {1, 0})
    for (const Vec3 to : {wi, mirrored_below(wi)}) {
      glass.front = front;
      const float expected = Seen<kRoughDielectric>{dielectric, front}.eval(wo, to).f_cos.x;
      CHECK(glass.eval(wo, to).f_cos.x == doctest::Approx(expected).epsilon(1e-4));
    }
  // An index of 1 lets light straight through.
  glass.m.ior = 1;
  glass.m.specular_level = 0;
  Random random(37);
  const BsdfSample s = glass.sample(wo, random);
  CHECK((s.wi.x == -wo.x && s.wi.z == -wo.z && s.pdf == 0.0f));
  CHECK(s.weight.x == doctest::Approx(1));
}
