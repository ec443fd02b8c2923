// The tree of lights: probabilities sum to 1, are those of the choices, and reach every light that shines.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "support/random.h"
#include "support/rich_lights.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

double d(float x) { return static_cast<double>(x); }

/// Lights of every kind that can stand in the tree, spread over a cube of half-width `size`.
std::vector<Light> many_lights(int count, float size, std::uint64_t seed) {
  Random random(seed);
  std::vector<Light> lights;
  for (int i = 0; i < count; ++i) {
    const Vec3 p = random.point(size), a = random.direction(), b = random.direction();
    const float scale = size * std::pow(10.0f, random.between(-4, -1));
    const int kind = random.below(6);
    Light light = kind == kSphereLight ? sphere_light(p, scale)
                  : kind == kDiskLight ? disk_light(p, a, scale)
                  : kind < kPointLight
                      ? planar_light(static_cast<LightKind>(kind), p, a * scale, b * scale)
                      : point_light(p, scale * scale);
    if (kind == kSpotLight) {
      light.kind = kSpotLight;
      light.normal = a;
      light.cos_outer = random.between(-0.5f, 0.999f);
      light.cos_inner = random.between(light.cos_outer, 1);
    }
    light.two_sided = random.below(2);
    lights.push_back(light);
  }
  return lights;
}

/// Does the light send anything to p?
bool shines(const SceneView &view, const Light &light, Vec3 p, Random &random) {
  for (int i = 0; i < 8; ++i) {
    const LightSample s = light.kind < kPointLight ? sample_surface(view, light, p, random.square())
                                                   : sample_point(view, light, p);
    if (s.pdf > 0 && !is_black(s.radiance)) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("light tree: every light is at the end of its path, once") {
  for (const int count : {1, 2, 3, 64, 1000, 20000}) {
    std::vector<Light> lights = many_lights(count, 1, 3);
    const std::vector<LightNode> nodes =
        build_light_tree(lights, std::vector<double>(lights.size(), 2.0));
    REQUIRE(nodes.size() == 2 * lights.size() - 1);
    for (std::size_t i = 0; i < lights.size(); ++i) {
      int32 first = nodes[0].first;
      REQUIRE(lights[i].path_depth <= 31);
      for (int32 level = 0; level < lights[i].path_depth; ++level) {
        REQUIRE(first >= 0);
        first = nodes[static_cast<std::size_t>(first + ((lights[i].path >> level) & 1))].first;
      }
      REQUIRE(-1 - first == static_cast<int32>(i));
    }
    CHECK(d(nodes[0].power) == doctest::Approx(1));
  }
}

TEST_CASE(
    "light tree: lights in one place, in a row, in ever finer clusters keep within 31 levels") {
  for (const int shape : {0, 1, 2}) {
    std::vector<Light> lights;
    for (int i = 0; i < 3000; ++i) {
      const float x = shape == 0   ? 0.0f
                      : shape == 1 ? static_cast<float>(i)
                                   : std::ldexp(1.0f, -(i % 120));
      lights.push_back(point_light({x, 0, 0}, 1));
    }
    std::vector<double> powers;
    for (int i = 0; i < 3000; ++i) powers.push_back(shape == 2 ? std::ldexp(1.0, -(i % 90)) : 1.0);
    build_light_tree(lights, powers);
    int32 deepest = 0;
    for (const Light &light : lights) deepest = std::max(deepest, light.path_depth);
    CAPTURE(shape);
    CHECK(deepest <= 31);
    if (shape < 2) CHECK(deepest <= 20);
  }
}

TEST_CASE(
    "light tree: at any point the probabilities sum to 1, and none is 0 where light arrives") {
  const FlushDenormals flush;
  for (const float size : {1e-12f, 1.0f, 1e12f})
    for (const int count : {2, 5, 100, 1000}) {
      Scene scene = rich_scene(many_lights(count, size, 4), {}, true);
      const SceneView view = scene.view();
      Random random(5);
      for (int k = 0; k < 50; ++k) {
        const Vec3 p = random.point(size * std::pow(10.0f, random.between(-2, 2)));
        double sum = 0;
        for (const Light &light : scene.lights) {
          const float pdf = choice_pdf(view, light, p);
          REQUIRE(is_finite(pdf));
          sum += d(pdf);
          if (!(pdf > 0)) REQUIRE(!shines(view, light, p, random));
        }
        CAPTURE(size);
        CAPTURE(count);
        REQUIRE(sum == doctest::Approx(1).epsilon(1e-5));
      }
    }
}

TEST_CASE("light tree: lights are chosen as often as their probability says") {
  const Scene scene = rich_scene(many_lights(200, 1, 6), {}, true);
  const SceneView view = scene.view();
  Random random(7);
  for (const Vec3 p : {vec3(0, 0, 0), vec3(0.9f, -0.8f, 0.7f), vec3(30, 1, -5)}) {
    Histogram counts({200, 1, 0, 200, 0, 1});
    for (int i = 0; i < num_samples(); ++i) {
      const ChosenLight c = choose_light_rich(view, p, random.square());
      REQUIRE((c.light >= 0 && c.light < view.num_lights));
      if (i < 1000)
        REQUIRE(c.pdf == choice_pdf(view, scene.lights[static_cast<std::size_t>(c.light)], p));
      counts.add(c.light + 0.5, 0.5);
    }
    std::vector<double> expected;
    for (const Light &light : scene.lights) expected.push_back(d(choice_pdf(view, light, p)));
    const Fit fit = chi_square_fit(counts, expected);
    INFO(fit.text());
    CHECK(fit.accepted());
  }
}

TEST_CASE("light tree: rare lights are found by the bits of the second number") {
  // 100 000 lights: no number of 24 bits reaches them all with the right probability.
  std::vector<Light> lights;
  for (int i = 0; i < 100000; ++i) lights.push_back(point_light({0, 0, 0}, 1));
  const Scene scene = rich_scene(lights, {}, true);
  const SceneView view = scene.view();
  std::vector<int> counts(lights.size());
  Random random(8);
  for (int i = 0; i < 2000000; ++i)
    ++counts[static_cast<std::size_t>(
        choose_light_rich(view, vec3(5, 0, 0), random.square()).light)];
  Histogram groups({500, 1, 0, 500, 0, 1});
  for (std::size_t i = 0; i < counts.size(); ++i)
    for (int k = 0; k < counts[i]; ++k) groups.add(static_cast<double>(i % 500) + 0.5, 0.5);
  std::vector<double> expected(500);
  for (std::size_t i = 0; i < lights.size(); ++i)
    expected[i % 500] += d(choice_pdf(view, scene.lights[i], vec3(5, 0, 0)));
  const Fit fit = chi_square_fit(groups, expected);
  INFO(fit.text());
  CHECK(fit.accepted());
}

TEST_CASE("light tree: with many lights the variance is a fraction of that by power") {
  // Lamps over a hall: a receiver is lit by those above it.
  Random random(9);
  std::vector<Light> lights;
  for (int i = 0; i < 1000; ++i)
    lights.push_back(planar_light(kQuadLight, {random.between(-50, 50), random.between(-50, 50), 3},
                                  {0, 0.2f, 0}, {0.2f, 0, 0}));
  Mean spread[2];
  double mean[2] = {0, 0};
  for (const int tree : {0, 1}) {
    const Scene scene = rich_scene(lights, {}, tree == 1);
    const SceneView view = scene.view();
    Random samples(10);
    for (int k = 0; k < 20; ++k) {
      const Vec3 p = {samples.between(-45, 45), samples.between(-45, 45), 0};
      Mean light;
      for (int i = 0; i < 20000; ++i) {
        const LightSample s = sample_light_rich(view, p, samples.square(), samples.square());
        light.add(s.pdf > 0 ? d(s.radiance.x) * d(std::max(s.direction.z, 0.0f)) / d(s.pdf) : 0);
      }
      spread[tree].add(light.variance());
      mean[tree] += light.mean();
    }
  }
  MESSAGE("variance by power over variance by the tree: " << spread[0].mean() / spread[1].mean());
  CHECK(relative_error(mean[1], mean[0]) < 0.05);
  CHECK(spread[1].mean() < 0.05 * spread[0].mean());
}
