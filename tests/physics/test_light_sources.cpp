// Points, spots, luminaires, suns: intensities, densities, and that every kind agrees with itself.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "core/parallel.h"
#include "scene/ies.h"
#include "support/random.h"
#include "support/rich_lights.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

double d(float x) { return static_cast<double>(x); }
const Vec2 kMiddle = {0.5f, 0.5f};

float one_minus_cos(double degrees) {  // of half a disc's diameter
  return static_cast<float>(2 * std::pow(std::sin(degrees / 4 * kPi / 180), 2));
}

}  // namespace

TEST_CASE("point light: intensity over distance squared, from anywhere, in any unit of length") {
  const FlushDenormals flush;
  for (const float scale : {1e-15f, 1e-6f, 1.0f, 1e6f, 1e15f}) {
    const Scene scene = rich_scene({point_light(vec3(1, 2, 3) * scale, 5)});
    const SceneView view = scene.view();
    const Vec3 origin = vec3(1, -1, 7) * scale;
    const LightSample s = sample_light_rich(view, origin, kMiddle, kMiddle);
    CHECK(s.is_delta == 1);
    CHECK(s.pdf == 1.0f);
    CHECK(relative_error(d(s.distance), 5 * d(scale)) < 1e-6);
    CHECK(relative_error(d(s.radiance.x), 5 / (25 * d(scale) * d(scale))) < 1e-6);
    CHECK(length(s.direction - vec3(0, 0.6f, -0.8f)) < 1e-6f);
    // At the light itself there is no direction.
    CHECK(sample_light_rich(view, vec3(1, 2, 3) * scale, kMiddle, kMiddle).pdf == 0.0f);
  }
}

TEST_CASE("spot light: full inside, none outside, a smoothstep of the cosine between") {
  Light light = point_light({0, 0, 0}, 2);
  light.kind = kSpotLight;
  light.normal = {0, -1, 0};
  light.cos_inner = 0.9f;
  light.cos_outer = 0.7f;
  const Scene scene = rich_scene({light});
  const auto at = [&](float cosine) {
    const float sine = square_root(1 - cosine * cosine);
    const Vec3 origin = vec3(sine, -cosine, 0) * 2;
    return sample_light_rich(scene.view(), origin, kMiddle, kMiddle).radiance.x;
  };
  CHECK(at(1.0f) == doctest::Approx(0.5));
  CHECK(at(0.91f) == doctest::Approx(0.5));
  CHECK(at(0.8f) == doctest::Approx(0.25));
  CHECK(at(0.75f) == doctest::Approx(0.5 * (3 * 0.0625 - 2 * 0.015625)).epsilon(1e-4));
  CHECK(at(0.69f) == 0.0f);
  CHECK(at(-1.0f) == 0.0f);
  light.cos_inner = light.cos_outer;
  CHECK(spot_falloff(light, 0.71f) == 1.0f);
  CHECK(spot_falloff(light, 0.69f) == 0.0f);
}

TEST_CASE("profile: the table is read where the file says it, on every axis") {
  IesProfile profile;
  profile.vertical = {0, 45, 90, 180};
  profile.horizontal = {0, 90, 180, 270, 360};
  Random random(1);
  for (int i = 0; i < 20; ++i) profile.candela.push_back(d(random.between(1, 100)));
  for (std::size_t v = 0; v < 4; ++v) profile.candela[16 + v] = profile.candela[v];
  const IesTable table = make_ies_table(profile);
  Scene scene;
  scene.tables.assign(7, -1.0f);
  scene.tables.insert(scene.tables.end(), table.values.begin(), table.values.end());
  LightProfile lamp = {7,         table.num_vertical, table.num_horizontal,
                       {1, 0, 0}, {0, 0, -1},         {0, -1, 0}};
  scene.profiles = {lamp};
  SceneView view = scene.view();
  view.tables = scene.tables.data();
  const double peak = *std::max_element(profile.candela.begin(), profile.candela.end());
  CHECK(table.peak == doctest::Approx(peak));
  for (int i = 0; i < 10000; ++i) {
    const Vec3 w = random.direction();
    const double vertical = std::acos(-d(w.y)) * 180 / kPi;
    double horizontal = std::atan2(-d(w.z), d(w.x)) * 180 / kPi;
    if (horizontal < 0) horizontal += 360;
    // The file is linear between angles that the table has, too: no error but rounding. At the poles, where
    // rows of one direction differ, the longitude has no digits.
    if (vertical < 0.1 || vertical > 179.9) continue;
    REQUIRE(d(profile_intensity(view, 0, w)) * table.peak ==
            doctest::Approx(ies_candela(profile, vertical, horizontal)).epsilon(1e-3));
  }
  for (const Vec3 w : {vec3(0, -1, 0), vec3(0, 1, 0), vec3(1, 0, 0), vec3(1, -0.0f, 0.0f),
                       vec3(1, 0, -1e-30f), vec3(1, 0, 1e-30f)})
    CHECK((profile_intensity(view, 0, w) > 0 && profile_intensity(view, 0, w) <= 1));
}

TEST_CASE("directional light: the same from everywhere, met by no ray") {
  const Vec3 n = normalize(vec3(1, 2, -3));
  const Scene scene = rich_scene({directional_light(n, 0, 3)});
  const SceneView view = scene.view();
  Random random(2);
  for (int i = 0; i < 100; ++i) {
    const Vec3 origin = random.point(1e7f);
    const LightSample s = sample_light_rich(view, origin, kMiddle, random.square());
    REQUIRE(s.is_delta == 1);
    REQUIRE(s.pdf == 1.0f);
    REQUIRE(s.radiance.x == 3.0f);
    REQUIRE(s.distance == PHALANX_FAR);
    REQUIRE(length(s.direction - n) == 0.0f);
    // Which side of a surface the light is on is seen from its point, too.
    REQUIRE(length(normalize(s.point - origin) - n) < 1e-4f);
  }
  CHECK(is_black(infinite_radiance(view, vec3(0, 0, 0), n, 0)));
  CHECK(is_black(infinite_radiance(view, vec3(0, 0, 0), n, 0.5f)));
}

TEST_CASE(
    "sun: directions are uniform in the disc and the density is 1 over its solid angle (L3)") {
  for (const double degrees : {0.001, 0.01, 0.533, 10.0, 90.0, 180.0}) {
    const Vec3 n = normalize(vec3(1, 2, -3));
    const float h = one_minus_cos(degrees);
    const Scene scene = rich_scene({directional_light(n, h, 1)});
    const SceneView view = scene.view();
    const Frame frame = make_frame(n);
    Histogram grid({10, 20, 0, 1, 0, 2 * kPi});
    Random random(3);
    for (int i = 0; i < num_samples() / 4; ++i) {
      const LightSample s =
          sample_light_rich(view, vec3(0, 0, 0), random.square(), random.square());
      const Vec3 chord = s.direction - n;  // 1 - cos from the chord, relative to that of the edge
      const double x = 0.5 * d(dot(chord, chord)) / d(h);
      grid.add(x, azimuth(d(dot(chord, frame.s)), d(dot(chord, frame.t))));
      REQUIRE(relative_error(d(s.pdf), 1 / (2 * kPi * d(h))) < 1e-5);
    }
    CAPTURE(degrees);
    // Below a hundredth of a degree, single precision has few directions within the disc.
    if (degrees < 0.01) continue;
    const Fit fit = chi_square_fit(grid, std::vector<double>(200, 1.0 / 200));
    INFO(fit.text());
    if (degrees > 0.1) CHECK(fit.accepted());
  }
}

TEST_CASE("sun: it is met where it is sampled, and both ways add up (L11)") {
  for (const double degrees : {0.533, 10.0, 90.0}) {
    const Vec3 n = {0, 1, 0};
    const float h = one_minus_cos(degrees);
    const Scene scene = rich_scene({directional_light(n, h, 1)});
    const SceneView view = scene.view();
    Random random(4);
    int num_missed = 0;
    for (int i = 0; i < 20000; ++i) {
      const LightSample s = sample_light_rich(view, vec3(1, 2, 3), kMiddle, random.square());
      num_missed += infinite_radiance(view, vec3(0, 0, 0), s.direction, 0).x != 1.0f;
    }
    CHECK(num_missed < 20);  // rounding at the edge
    // Irradiance pi sin^2 by light sampling and by uniform directions, weighted.
    const double half = degrees / 2 * kPi / 180, expected = kPi * std::pow(std::sin(half), 2);
    Mean both;
    for (int i = 0; i < 400000; ++i) {
      const LightSample s = sample_light_rich(view, vec3(1, 2, 3), kMiddle, random.square());
      double sum =
          d(s.direction.y) / d(s.pdf) * d(power_heuristic(s.pdf, s.direction.y * PHALANX_INV_PI));
      const Vec3 w = square_to_cosine_hemisphere(random.square());
      if (w.z > 0)
        sum +=
            kPi *
            d(infinite_radiance(view, vec3(0, 0, 0), vec3(w.x, w.z, w.y), w.z * PHALANX_INV_PI).x);
      both.add(sum);
    }
    CAPTURE(degrees);
    CAPTURE(both.mean() / expected);
    CHECK(both.p(expected, 1e-4 * expected) > alpha());
  }
}

TEST_CASE("rich lights: plain area lights are sampled as in light.h, bit for bit") {
  Random random(5);
  std::vector<Light> lights = {
      planar_light(kQuadLight, {-0.5f, -0.2f, 1}, {1, 0.1f, 0.2f}, {0.2f, 1.5f, -0.1f}),
      planar_light(kTriangleLight, {-0.5f, -0.2f, 1}, {2, 0.1f, 0.2f}, {0.2f, 1.5f, -0.1f}),
      disk_light({0.1f, 0.2f, 1.5f}, normalize(vec3(0.2f, -0.3f, -1)), 0.8f),
      sphere_light({0, 0.1f, 0.2f}, 0.7f)};
  for (Light &light : lights) light.error = 1e-3f;
  lights[1].two_sided = 1;
  const Scene scene = rich_scene(lights);
  const SceneView view = scene.view();
  for (int i = 0; i < 20000; ++i) {
    const Vec3 origin = random.point(3);
    const Vec2 u_choice = random.square(), u = random.square();
    const LightSample plain = sample_light(view, origin, u_choice, u);
    const LightSample rich = sample_light_rich(view, origin, u_choice, u);
    if (!(plain.pdf > 0)) {
      REQUIRE(!(rich.pdf > 0));
      continue;
    }
    REQUIRE(relative_error(d(rich.pdf), d(plain.pdf)) < 1e-6);
    REQUIRE(length(rich.direction - plain.direction) == 0.0f);
    REQUIRE(rich.distance == plain.distance);
    REQUIRE(rich.radiance.x == plain.radiance.x);
    REQUIRE(rich.is_delta == 0);
  }
}

TEST_CASE("rich lights: a list of all kinds gives each its share, by a table and by a tree") {
  std::vector<Light> lights = {planar_light(kQuadLight, {-1, -1, 2}, {0, 2, 0}, {2, 0, 0}),
                               sphere_light({3, 0, 1}, 0.5f),
                               point_light({0, 1, 1}, 2),
                               directional_light({0, 0, 1}, 0, 1),
                               directional_light(normalize(vec3(1, 0, 1)), 0.1f, 1),
                               environment_light()};
  EnvironmentMap map;
  map.width = map.height = 1;
  map.texels = {1, 1, 1};
  for (const bool tree : {false, true}) {
    const Scene scene = rich_scene(lights, map, tree);
    const SceneView view = scene.view();
    Random random(6);
    // Light that falls on the origin from above: the sum of what each does alone, times its pdf.
    Mean got;
    double expected = 0;
    const Vec3 origin = {0, 0, 0};
    for (const Light &light : lights) {
      const Scene alone = rich_scene({light}, map);
      const SceneView one = alone.view();
      Mean mean;
      for (int i = 0; i < 400000; ++i) {
        const LightSample s = sample_light_rich(one, origin, random.square(), random.square());
        mean.add(s.pdf > 0 && s.direction.z > 0 ? d(s.radiance.x) * d(s.direction.z) / d(s.pdf)
                                                : 0);
      }
      expected += mean.mean();
    }
    for (int i = 0; i < 2000000; ++i) {
      const LightSample s = sample_light_rich(view, origin, random.square(), random.square());
      got.add(s.pdf > 0 && s.direction.z > 0 ? d(s.radiance.x) * d(s.direction.z) / d(s.pdf) : 0);
    }
    CAPTURE(tree);
    CHECK(got.p(expected, 5e-3 * expected) > alpha());
  }
}
