// BSDF sampling: directions follow the density, the density integrates to 1 less what is lost.
#include <doctest/doctest.h>

#include "support/bsdf_checks.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

constexpr float kSharp[] = {1e-3f, 5e-3f, 0.01f, 0.05f};
constexpr float kRough[] = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};

template <typename Space>
void check_conductor(float alpha, Vec3 wo, const Space &space) {
  // Rounded directions know their half vector to 3e-8 / wo.z, against cells of alpha / 64.
  check_sampling(Seen<kConductor>{conductor(alpha)}, wo, space, num_samples(),
                 wo.z * alpha > 9e-6f);
}

}  // namespace

TEST_CASE("diffuse: directions follow the density, which integrates to 1") {
  check_sampling(Seen<kDiffuse>{diffuse(1)}, vec3(0, 0, 1), UpperDirections{}, num_samples());
}

TEST_CASE("conductor: rough lobes follow their density in direction space") {
  for (const float alpha : kRough)
    for (const Vec3 wo : local_directions()) check_conductor(alpha, wo, UpperDirections{});
}

TEST_CASE("conductor: sharp lobes follow their density in half-vector space (M1)") {
  for (const float alpha : kSharp)
    for (const Vec3 wo : local_directions()) {
      if (wo.z * alpha < 2e-6f) continue;  // less than a cell of the coarse grid
      check_conductor(alpha, wo, ReflectingNormals{{static_cast<double>(alpha)}});
    }
}

TEST_CASE("bsdf: a delta kind has no density, a scattering kind has one") {
  CHECK(has_density<kDiffuse>());
  CHECK(has_density<kConductor>());
  CHECK_FALSE(has_density<kMirror>());
  CHECK_FALSE(has_density<kDielectric>());
  CHECK_FALSE(has_density<kBlack>());
  const Vec3 w = vec3(0, 0.6f, 0.8f);
  Random random(1);
  CHECK(Seen<kMirror>{mirror(1)}.eval(w, w).pdf == 0.0f);
  CHECK(Seen<kDielectric>{dielectric(1.5f)}.eval(w, w).pdf == 0.0f);
  CHECK(Seen<kBlack>{diffuse(1)}.eval(w, w).pdf == 0.0f);
  CHECK(is_black(Seen<kBlack>{diffuse(1)}.sample(w, random).weight));
}
