// Phong and Blinn-Phong: samples follow the density, the value is reflectance times density.
#include <doctest/doctest.h>

#include "support/bsdf_checks.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

constexpr float kExponents[] = {0, 1, 10, 200, 1e4f, 1e6f};

template <int Kind>
Seen<Kind> lobe(float exponent, float reflectance = 1) {
  Material m = material(static_cast<MaterialKind>(Kind), reflectance);
  m.exponent = exponent;
  return {m};
}

/// Half vectors of Blinn-Phong resemble those of GGX of this roughness.
double like_alpha(float exponent) { return std::sqrt(2 / (static_cast<double>(exponent) + 2)); }

}  // namespace

TEST_CASE("phong: directions follow the density, which integrates to 1 less what is lost") {
  for (const float exponent : {10.0f, 200.0f})
    for (const Vec3 wo : local_directions())
      check_sampling(lobe<kPhong>(exponent), wo, UpperDirections{}, num_samples());
}

TEST_CASE("blinn-phong: half vectors follow the density, which integrates to 1 less what is lost") {
  const auto check = [](float exponent, Vec3 wo) {
    const double alpha = like_alpha(exponent);
    check_sampling(lobe<kBlinnPhong>(exponent), wo, ReflectingNormals{{alpha}}, num_samples(),
                   static_cast<double>(wo.z) * alpha > 9e-6);
  };
  for (const Vec3 wo : local_directions()) check(10, wo);
  for (const std::size_t i : {0u, 4u, 8u}) check(1e4f, local_directions()[i]);
}

TEST_CASE("phong: sharp lobes keep their width") {
  // (n + 1) ln(1 / cos) is distributed exponentially, with mean and deviation 1.
  for (const float exponent : {200.0f, 1e4f, 1e6f}) {
    const Seen<kPhong> phong = lobe<kPhong>(exponent);
    const Vec3 wo = normalize(vec3(0.3f, -0.2f, 0.8f));
    Random random(5);
    Mean mean, square;
    for (int i = 0; i < 200000; ++i) {
      const Vec3 wi = phong.sample(wo, random).wi;
      const double x = static_cast<double>(wi.x + wo.x), y = static_cast<double>(wi.y + wo.y),
                   z = static_cast<double>(wi.z - wo.z);
      const double t =
          -(static_cast<double>(exponent) + 1) * std::log1p(-0.5 * (x * x + y * y + z * z));
      mean.add(t);
      square.add(t * t);
    }
    CAPTURE(exponent);
    CHECK(mean.p(1, 1e-3) > alpha());
    CHECK(square.p(2, 4e-3) > alpha());
  }
}

TEST_CASE("phong, blinn-phong: the weight is the reflectance, and sample and eval agree") {
  for (const float exponent : kExponents) {
    CAPTURE(exponent);
    // Rounded directions know the distance to the lobe's axis to 1e-7, against a width of 1 / sqrt(n).
    const double rounding = 1e-6 * std::sqrt(static_cast<double>(exponent) + 1);
    CHECK(worst_difference(lobe<kPhong>(exponent, 0.7f)) < 20 * rounding);
    const auto grazing = [](Vec3 wo, Vec3 wi) {
      return std::max(1.0, 0.1 / static_cast<double>(length_squared(wo + wi)));
    };
    CHECK(worst_difference(lobe<kBlinnPhong>(exponent, 0.7f), grazing) < 20 * rounding);
  }
}

TEST_CASE("phong, blinn-phong: never more light than the reflectance, all of it along the normal") {
  for (const float exponent : kExponents)
    for (const Vec3 wo : local_directions()) {
      CHECK(albedo(lobe<kPhong>(exponent, 0.5f), wo, 20000).mean() <= 0.5);
      CHECK(albedo(lobe<kBlinnPhong>(exponent, 0.5f), wo, 20000).mean() <= 0.5);
    }
  CHECK(albedo(lobe<kPhong>(3), vec3(0, 0, 1), 20000).mean() == 1.0);
}

TEST_CASE("phong, blinn-phong: finite everywhere, nothing below the horizon") {
  for (const float exponent : kExponents) {
    check_finite(lobe<kPhong>(exponent));
    check_finite(lobe<kBlinnPhong>(exponent));
  }
  const Vec3 w = vec3(0.6f, 0, 0.8f);
  CHECK(lobe<kPhong>(1).eval(w, mirrored_below(w)).pdf == 0.0f);
  CHECK(lobe<kBlinnPhong>(1).eval(w, mirrored_below(w)).pdf == 0.0f);
}
