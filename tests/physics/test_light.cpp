// Choosing and sampling lights: densities, irradiances with known values, limits.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../../kernels/physics/rng.h"
#include "../../kernels/physics/shape.h"
#include "../../src/core/parallel.h"
#include "support/lights.h"
#include "support/random.h"
#include "support/statistics.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

/// Where a ray meets a light, if it does: by the shapes' own intersection, planes in double.
bool meets(const Light &light, Vec3 origin, Vec3 direction, Vec3 &position, Vec3 &normal) {
  normal = light.normal;
  if (light.kind == kSphereLight) {
    const Sphere sphere = {light.p, light.radius};
    const ShapeHit hit = intersect_sphere(origin, direction, sphere, 0, PHALANX_FAR);
    if (!(hit.t > 0)) return false;
    normal = normalize(origin + direction * hit.t - light.p);
    position = light.p + normal * light.radius;
    return true;
  }
  const ShapeHit hit =
      intersect_disk(origin, direction, {light.p, light.a, light.b}, 0, PHALANX_FAR);
  position = origin + direction * hit.t;
  if (light.kind == kDiskLight) return hit.t > 0;
  const double t = static_cast<double>(dot(light.p - origin, light.normal)) /
                   static_cast<double>(dot(direction, light.normal));
  if (!(t > 0)) return false;
  position = origin + direction * static_cast<float>(t);
  const Vec3 r = position - light.p, n = cross(light.a, light.b);
  const float u = dot(cross(r, light.b), n) / dot(n, n), v = dot(cross(light.a, r), n) / dot(n, n);
  return u >= 0 && v >= 0 && (light.kind == kTriangleLight ? u + v <= 1 : u <= 1 && v <= 1);
}

/// Irradiance at `origin` on a surface facing `normal`, by sampling the lights with Sobol points.
double irradiance(const SceneView &scene, Vec3 origin, Vec3 normal, int log2_samples) {
  FrameView frame = {};
  frame.sampler = kSobolSampler;
  double sum = 0;
  for (int i = 0; i < 1 << log2_samples; ++i) {
    const LightSample s =
        sample_light(scene, origin, sample_pair(frame, 7, i, PHALANX_PAIR_LIGHT_CHOICE),
                     sample_pair(frame, 7, i, PHALANX_PAIR_LIGHT));
    const float cosine = dot(s.direction, normal);
    if (s.pdf > 0 && cosine > 0)
      sum += static_cast<double>(s.radiance.x) * static_cast<double>(cosine) /
             static_cast<double>(s.pdf);
  }
  return sum / (1 << log2_samples);
}

const Vec3 kUp = {0, 0, 1}, kOrigin = {0, 0, 0};

Light overhead_quad(float size, float height) {  // faces down
  return planar_light(kQuadLight, {-size / 2, -size / 2, height}, {0, size, 0}, {size, 0, 0});
}

}  // namespace

TEST_CASE("light: the density integrates to 1 over directions that meet the light") {
  const Light lights[] = {
      planar_light(kQuadLight, {-0.5f, -0.2f, 1}, {1, 0.1f, 0.2f}, {0.2f, 1.5f, -0.1f}),
      planar_light(kTriangleLight, {-0.5f, -0.2f, 1}, {2, 0.1f, 0.2f}, {0.2f, 1.5f, -0.1f}),
      disk_light({0.1f, 0.2f, 1.5f}, normalize(vec3(0.2f, -0.3f, -1)), 0.8f),
      sphere_light({0, 0.1f, 0.2f}, 0.7f)};
  for (const Light &light : lights)
    for (const Vec3 origin :
         {vec3(0.1f, 0.2f, 0.4f), vec3(0.4f, 0.9f, -0.1f), vec3(0, 1.2f, 1.9f)}) {
      Random random(1);
      Mean mean;
      for (int i = 0; i < num_samples() / 4; ++i) {
        const Vec3 direction = random.direction();
        Vec3 position, normal;
        const bool met = meets(light, origin, direction, position, normal);
        mean.add(met ? 4 * kPi * static_cast<double>(light_pdf(light, origin, position, normal))
                     : 0);
      }
      CAPTURE(light.kind);
      CHECK(mean.mean() == doctest::Approx(1).epsilon(0.05));
      CHECK(mean.p(1) > test::alpha());
    }
}

TEST_CASE("light: a sample carries the density that light_pdf gives at its point") {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const Vec3 p = random.point(2), a = random.direction(), b = random.direction();
    const int kind = random.below(4);
    const Light light = kind == kSphereLight ? sphere_light(p, random.between(0.1f, 2))
                        : kind == kDiskLight ? disk_light(p, a, random.between(0.1f, 2))
                                             : planar_light(static_cast<LightKind>(kind), p, a, b);
    if (!(light.area > 0.01f)) continue;
    const LightScene scene({light});
    const Vec3 origin = random.point(4);
    const LightSample s = sample_light(scene.view, origin, random.square(), random.square());
    if (!(s.pdf > 0)) continue;
    const Vec3 n = kind == kSphereLight ? normalize(s.point - p) : light.normal;
    // Far below the horizon of a plane the distance to it is what rounding leaves.
    if (std::fabs(dot(n, s.direction)) < 1e-3f) continue;
    REQUIRE(relative_error(static_cast<double>(light_pdf(light, origin, s.point, n)),
                           static_cast<double>(s.pdf)) < 2e-3);
    REQUIRE(std::fabs(length(s.direction) - 1) < 1e-6f);
    REQUIRE(length(origin + s.direction * s.distance - s.point) < 4e-6f);
  }
}

TEST_CASE("light: irradiances with closed forms (B4 no. 3 and 4)") {
  {
    const LightScene disk({disk_light({0, 0, 1}, {0, 0, -1}, 1)});
    CHECK(irradiance(disk.view, kOrigin, kUp, 16) == doctest::Approx(1.570796).epsilon(1e-4));
  }
  {
    const LightScene quad({overhead_quad(2, 1)});
    CHECK(irradiance(quad.view, kOrigin, kUp, 16) == doctest::Approx(1.74083950).epsilon(1e-4));
  }
  {  // Two triangles make the quad.
    const Light q = overhead_quad(2, 1);
    const LightScene halves({planar_light(kTriangleLight, q.p, q.a, q.b),
                             planar_light(kTriangleLight, q.p + q.a + q.b, neg(q.a), neg(q.b))});
    CHECK(irradiance(halves.view, kOrigin, kUp, 16) == doctest::Approx(1.74083950).epsilon(1e-3));
  }
}

TEST_CASE("sphere light: E = pi L (R/d)^2 cos, down to R/d = 1e-4 (L3)") {
  const Vec3 w = normalize(vec3(0.48f, -0.36f, 0.8f));
  for (const float ratio : {0.5f, 0.1f, 1e-2f, 1e-3f, 1e-4f}) {
    const LightScene sphere({sphere_light(w * 3, 3 * ratio)});
    const double expected =
        kPi * std::pow(static_cast<double>(ratio), 2) * static_cast<double>(w.z);
    CAPTURE(ratio);
    CHECK(relative_error(irradiance(sphere.view, kOrigin, kUp, 14), expected) < 1e-3);
  }
}

TEST_CASE("sphere light: inside, the irradiance is pi L anywhere (G9)") {
  for (const float r : {0.0f, 0.3f, 0.9f}) {
    const LightScene sphere({[] {
      Light light = sphere_light({1, 2, 3}, 1);
      light.two_sided = 1;
      return light;
    }()});
    const Vec3 normal = normalize(vec3(0.3f, -0.5f, 0.7f));
    const double e = irradiance(sphere.view, vec3(1 + r, 2, 3), normal, 16);
    CAPTURE(r);
    CHECK(e == doctest::Approx(kPi).epsilon(5e-3));
  }
}

TEST_CASE("light: backs are black, two-sided lights are not (L10)") {
  Light light = overhead_quad(2, -1);  // below, facing down: its back is seen
  Random random(3);
  for (const int two_sided : {0, 1}) {
    light.two_sided = two_sided;
    const LightScene scene({light});
    for (int i = 0; i < 1000; ++i) {
      const LightSample s = sample_light(scene.view, kOrigin, random.square(), random.square());
      REQUIRE(is_black(s.radiance) == (two_sided == 0));
    }
  }
  Light inside = sphere_light({0, 0, 0}, 1);
  const LightScene one_sided({inside});
  CHECK(is_black(
      sample_light(one_sided.view, vec3(0.1f, 0, 0), vec2(0.5f, 0.5f), vec2(0.3f, 0.3f)).radiance));
}

TEST_CASE("light: exactly in the plane of the light nothing arrives, and nothing is NaN (L10)") {
  const LightScene scene({overhead_quad(2, 0)});
  Random random(4);
  for (int i = 0; i < 10000; ++i) {
    const LightSample s = sample_light(scene.view, vec3(5, 1, 0), random.square(), random.square());
    REQUIRE(s.pdf == 0.0f);
  }
  CHECK(light_pdf(overhead_quad(2, 0), vec3(5, 1, 0), vec3(0.5f, 0, 0), vec3(0, 0, -1)) == 0.0f);
}

TEST_CASE("light: grazing and touching receivers get finite samples (L7, G8)") {
  const FlushDenormals flush;
  Random random(5);
  for (const float height : {1.0f, 1e-3f, 1e-6f, 1e-12f, 1e-19f, 1e-30f})
    for (const bool sphere : {false, true}) {
      const LightScene scene(
          {sphere ? sphere_light({0, 0, height + 1}, 1) : overhead_quad(2, height)});
      for (int i = 0; i < 20000; ++i) {
        const LightSample s = sample_light(scene.view, kOrigin, random.square(), random.square());
        REQUIRE(is_finite(s.pdf));
        REQUIRE(s.pdf >= 0.0f);
        if (s.pdf > 0) REQUIRE(all_finite(s.direction));
        if (s.pdf > 0) REQUIRE(is_finite(s.distance));
      }
    }
}

TEST_CASE("light: irradiance does not depend on the unit of length (S1)") {
  const FlushDenormals flush;
  const auto expect = [](float scale, bool sphere) {
    const LightScene scene(
        {sphere ? sphere_light({0, 0, 2 * scale}, scale) : overhead_quad(2 * scale, scale)});
    return irradiance(scene.view, kOrigin, kUp, 12);
  };
  const double quad = expect(1, false), sphere = expect(1, true);
  for (const float scale : {1e-16f, 1e-12f, 1e-6f, 1e-3f, 1e3f, 1e6f, 1e9f, 1e12f, 1e14f, 1e18f}) {
    CAPTURE(scale);
    CHECK(expect(scale, false) == doctest::Approx(quad).epsilon(1e-4));
    CHECK(expect(scale, true) == doctest::Approx(sphere).epsilon(1e-4));
  }
}

TEST_CASE("light: a far light keeps its brightness") {
  const FlushDenormals flush;
  for (const double distance : {1e3, 1e6, 1e9, 1e12, 1e13, 1e15}) {
    const float h = static_cast<float>(distance), size = static_cast<float>(distance / 100);
    const LightScene scene({overhead_quad(size, h)});
    CAPTURE(distance);
    CHECK(relative_error(irradiance(scene.view, kOrigin, kUp, 10), 1e-4) < 1e-3);
  }
}

TEST_CASE("light: the error bound moves samples towards the receiver") {
  Light light = overhead_quad(2, 1);
  light.error = 0.125f;
  const LightScene below({light});
  const Vec2 u = vec2(0.25f, 0.75f);
  const LightSample s = sample_light(below.view, kOrigin, u, u);
  CHECK(s.point.z == 1);
  CHECK((s.direction * s.distance).z == doctest::Approx(0.875));
  light.two_sided = 1;
  const LightScene above({light});
  const LightSample from_above = sample_light(above.view, vec3(0, 0, 5), u, u);
  CHECK(5 + (from_above.direction * from_above.distance).z == doctest::Approx(1.125));
}

TEST_CASE("light: choice follows select_pdf") {
  for (const std::vector<double> &weights : {std::vector<double>{1},
                                             {1, 1},
                                             {3, 1},
                                             {1, 2, 3, 4, 5},
                                             {0, 1, 0, 5},
                                             {1e-3, 1, 1e-6, 7, 7}}) {
    std::vector<Light> lights(weights.size(), overhead_quad(2, 1));
    const LightScene scene(lights, weights);
    std::vector<Mean> chosen(weights.size());
    Random random(6);
    for (int i = 0; i < 200000; ++i) {
      const int32 light = choose_light(scene.view, random.square());
      REQUIRE((light >= 0 && light < scene.view.num_lights));
      for (std::size_t j = 0; j < chosen.size(); ++j) chosen[j].add(light == static_cast<int32>(j));
    }
    double sum = 0;
    for (std::size_t j = 0; j < chosen.size(); ++j) {
      const double pdf = static_cast<double>(scene.view.lights[j].select_pdf);
      sum += pdf;
      CAPTURE(j);
      if (pdf == 0)
        CHECK(chosen[j].mean() == 0);
      else if (pdf < 1e-4)
        CHECK(chosen[j].mean() < 1e-4);
      else if (pdf < 1)
        CHECK(chosen[j].p(pdf) > test::alpha());
      else
        CHECK(chosen[j].mean() == 1);
    }
    CHECK(sum == doctest::Approx(1));
  }
}

TEST_CASE("light: one strong light among 10^5 weak ones (L8)") {
  std::vector<double> weights(100001, 1e-8);
  weights[777] = 1;
  const LightScene scene(std::vector<Light>(weights.size(), overhead_quad(2, 1)), weights);
  Random random(7);
  Mean strong;
  for (int i = 0; i < 1000000; ++i) strong.add(choose_light(scene.view, random.square()) == 777);
  CHECK(strong.p(1 / 1.001) > test::alpha());
}

TEST_CASE("light: the corner of the square of choices is a light, too") {
  const float most = 1 - 0x1p-24f;
  for (const std::size_t n : {1u, 2u, 3u, 1000u, 100000u}) {
    const LightScene scene(std::vector<Light>(n, overhead_quad(2, 1)));
    for (const float x : {0.0f, most})
      for (const float y : {0.0f, most}) {
        const int32 i = choose_light(scene.view, vec2(x, y));
        CHECK((i >= 0 && i < scene.view.num_lights));
      }
  }
}

TEST_CASE("sphere light: of a few ulps across, it shows its front to everyone outside (L3)") {
  const float radius = 1e-6f;
  Light light = sphere_light({1, 2, 0}, radius);
  light.emission = {1e12f, 1e12f, 1e12f};
  const LightScene sphere({light});
  Random random(77);
  int dark = 0;
  for (int i = 0; i < 10000; ++i)
    dark += is_black(sample_light(sphere.view, vec3(0, 0, 0), random.square(), random.square()).radiance);
  CHECK(dark == 0);
  // And its back, black, to those within.
  const LightScene large({sphere_light({0, 0, 0}, 1)});
  for (int i = 0; i < 100; ++i)
    CHECK(is_black(sample_light(large.view, random.direction() * 0.9f, random.square(), random.square()).radiance));
}
