// Rectangles and triangles sampled by the solid angle that they fill: against quadrature in double, Lambert's
// formula, and their own density; near, grazing, huge, tiny.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/parallel.h"
#include "support/random.h"
#include "support/rich_lights.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

using Double3 = std::array<double, 3>;

double d(float x) { return static_cast<double>(x); }
float f(double x) { return static_cast<float>(x); }
Double3 d(Vec3 v) { return {d(v.x), d(v.y), d(v.z)}; }
double dot64(const Double3 &a, const Double3 &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Double3 cross64(const Double3 &a, const Double3 &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length64(const Double3 &a) { return std::sqrt(dot64(a, a)); }

/// Corners seen from `origin`, unit, in order.
std::vector<Double3> corners(const Light &light, Vec3 origin) {
  std::vector<Double3> result;
  const bool quad = light.kind == kQuadLight;
  for (const auto &[s, t] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    if (s == 1 && t == 1 && !quad) continue;
    Double3 v;
    for (std::size_t c = 0; c < 3; ++c)
      v[c] = d(light.p)[c] + s * d(light.a)[c] + t * d(light.b)[c] - d(origin)[c];
    const double size = length64(v);
    for (double &x : v) x /= size;
    result.push_back(v);
  }
  return result;
}

/// Of one triangle, in double.
double triangle_angle(const Double3 &a, const Double3 &b, const Double3 &c) {
  const double volume = std::fabs(dot64(a, cross64(b, c)));
  return 2 * std::atan2(volume, 1 + dot64(a, b) + dot64(b, c) + dot64(c, a));
}

double exact_solid_angle(const Light &light, Vec3 origin) {
  const std::vector<Double3> v = corners(light, origin);
  double sum = triangle_angle(v[0], v[1], v[2]);
  if (v.size() == 4) sum += triangle_angle(v[0], v[2], v[3]);
  return sum;
}

/// Irradiance of radiance 1 at `origin` on a surface facing `n`, above whose horizon all of the light is:
/// Lambert's formula.
double exact_irradiance(const Light &light, Vec3 origin, Vec3 n) {
  const std::vector<Double3> v = corners(light, origin);
  double sum = 0;
  for (std::size_t i = 0; i < v.size(); ++i) {
    const Double3 &a = v[i], &b = v[(i + 1) % v.size()];
    const Double3 across = cross64(a, b);
    const double size = length64(across), angle = std::atan2(size, dot64(a, b));
    if (size > 0) sum += 0.5 * angle / size * dot64(across, d(n));
  }
  return std::fabs(sum);
}

const Light kRectangle =
    planar_light(kQuadLight, {-0.5f, -0.2f, 1}, {0.8f, 0.6f, 0}, {-0.9f, 1.2f, 0});
const Light kTriangle =
    planar_light(kTriangleLight, {-0.5f, -0.2f, 1}, {2, 0.1f, 0.2f}, {0.2f, 1.5f, -0.1f});
// In front, aside, close to the surface, close to an edge and beyond it, from behind, far.
const Vec3 kViews[] = {{0.3f, 0.2f, -0.5f},   {2, -1, 0.5f},      {0.0f, 0.4f, 0.99f},
                       {-0.6f, -0.2f, 0.98f}, {0.4f, 0.6f, 1.3f}, {5, 3, -80}};

/// Points counted in the parameters of the surface.
void check_points(const Light &light, Vec3 origin) {
  const Scene scene = rich_scene({light});
  const SceneView view = scene.view();
  const bool triangle = light.kind == kTriangleLight;
  Histogram coarse({10, 20, 0, 1, 0, 1}), fine({64, 128, 0, 1, 0, 1});
  Random random(31);
  for (int i = 0; i < num_samples(); ++i) {
    const LightSample s = sample_light_rich(view, origin, random.square(), random.square());
    if (!(s.pdf > 0)) {
      coarse.add_invalid();
      fine.add_invalid();
      continue;
    }
    const Double3 r = d(s.point - light.p), a = d(light.a), b = d(light.b);
    const double aa = dot64(a, a), ab = dot64(a, b), bb = dot64(b, b);
    const double det = aa * bb - ab * ab;
    const double u = (dot64(r, a) * bb - dot64(r, b) * ab) / det;
    const double v = (dot64(r, b) * aa - dot64(r, a) * ab) / det;
    for (Histogram *h : {&coarse, &fine})
      h->add(triangle ? u + v : u, triangle ? (u + v > 0 ? v / (u + v) : 0) : v);
  }
  const Double3 n = cross64(d(light.a), d(light.b));
  const auto density = [&](double x, double y) {
    const double u = triangle ? x * (1 - y) : x, v = triangle ? x * y : y;
    const Vec3 p = light.p + light.a * f(u) + light.b * f(v);
    const Double3 to_light = d(p - origin);
    const double d2 = dot64(to_light, to_light);
    return d(light_pdf_rich(view, view.lights[0], origin, p, light.normal)) *
           std::fabs(dot64(n, to_light)) / (d2 * std::sqrt(d2)) * (triangle ? x : 1);
  };
  for (const Histogram *h : {&coarse, &fine}) {
    const Fit fit = chi_square_fit(*h, cell_masses(h->grid(), density));
    CAPTURE(light.kind);
    CAPTURE(origin.z);
    INFO(fit.text());
    CHECK(fit.accepted());
    CHECK(fit.mass == doctest::Approx(1).epsilon(2e-3));
  }
}

}  // namespace

TEST_CASE("solid angle: rectangles and triangles fill what they fill in double") {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = random.direction() * random.between(0.1f, 3);
    const Vec3 side = normalize(cross(a, random.direction()));
    for (const bool quad : {true, false}) {
      const Light light =
          by_solid_angle(planar_light(quad ? kQuadLight : kTriangleLight, random.point(2), a,
                                      quad ? side * random.between(0.1f, 3) : random.direction()));
      const Vec3 origin = random.point(4);
      const float got = sampled_solid_angle(light, origin);
      if (got == 0) continue;
      CAPTURE(quad);
      REQUIRE(relative_error(d(got), exact_solid_angle(light, origin)) < 1e-3);
    }
  }
}

TEST_CASE("solid angle: points of rectangles and triangles follow their density") {
  for (const Light &light : {kRectangle, kTriangle})
    for (const Vec3 origin : kViews) check_points(by_solid_angle(light), origin);
}

TEST_CASE("solid angle: a sample carries the density of its point") {
  Random random(2);
  for (const Light &light : {by_solid_angle(kRectangle), by_solid_angle(kTriangle)}) {
    const Scene scene = rich_scene({light});
    const SceneView view = scene.view();
    for (int i = 0; i < 50000; ++i) {
      const Vec3 origin = random.point(4);
      const LightSample s = sample_light_rich(view, origin, random.square(), random.square());
      if (!(s.pdf > 0)) continue;
      REQUIRE(s.is_delta == 0);
      const float pdf = light_pdf_rich(view, view.lights[0], origin, s.point, light.normal);
      if (std::fabs(dot(s.direction, light.normal)) < 1e-3f) continue;
      REQUIRE(relative_error(d(pdf), d(s.pdf)) < 2e-3);
    }
  }
}

TEST_CASE("solid angle: irradiance is Lambert's, near, far, grazing, at any scale (L7, S1)") {
  const FlushDenormals flush;
  struct Case {
    const char *name;
    double size, height, aside;  // of the light; of the receiver below it; sideways
  };
  const Case cases[] = {{"unit", 1, 1, 0},      {"near", 1, 1e-2, 0},    {"touching", 1, 1e-4, 0.1},
                        {"huge", 1e4, 1, 0},    {"grazing", 1, 1e-2, 2}, {"edge", 1, 1e-3, 0.5},
                        {"tiny", 1e-4, 1, 0.3}, {"far", 1, 1000, 10}};
  for (const Case &c : cases)
    for (const double scale : {1e-12, 1.0, 1e9})
      for (const LightKind kind : {kQuadLight, kTriangleLight}) {
        const float s = f(c.size * scale);
        const Vec3 corner = {f((c.aside - c.size / 2) * scale), -s / 2, f(c.height * scale)};
        const Light light = by_solid_angle(planar_light(kind, corner, {0, s, 0}, {s, 0, 0}));
        const Scene scene = rich_scene({light});
        const SceneView view = scene.view();
        const Vec3 origin = {0, 0, 0}, n = {0, 0, 1};
        Random random(3);
        Mean mean;
        for (int i = 0; i < 100000; ++i) {
          const LightSample sample =
              sample_light_rich(view, origin, random.square(), random.square());
          mean.add(sample.pdf > 0 ? d(sample.radiance.x) * d(std::max(sample.direction.z, 0.0f)) /
                                        d(sample.pdf)
                                  : 0);
        }
        const double expected = exact_irradiance(light, origin, n);
        CAPTURE(std::string(c.name));
        CAPTURE(scale);
        CAPTURE(kind == kQuadLight);
        CAPTURE(mean.mean() / expected);
        CHECK(mean.p(expected, 1e-3 * expected) > alpha());
        // What it is for: no spikes. By area, the relative deviation is beyond 10 when touching.
        if (c.size / c.height < 1e3 && sampled_solid_angle(light, origin) > 0)
          CHECK(std::sqrt(mean.variance()) < 1.5 * expected);
      }
}

TEST_CASE(
    "solid angle: with multiple importance sampling the two ways add up to Lambert's formula") {
  for (const Light &plain : {kRectangle, kTriangle})
    for (const Vec3 origin : {vec3(0.3f, 0.2f, -0.5f), vec3(0.0f, 0.4f, 0.9f)}) {
      const Light light = by_solid_angle(plain);
      const Scene scene = rich_scene({light});
      const SceneView view = scene.view();
      const Vec3 n = {0, 0, 1};
      Random random(4);
      Mean mean;
      for (int i = 0; i < 400000; ++i) {
        double sum = 0;
        const LightSample s = sample_light_rich(view, origin, random.square(), random.square());
        if (s.pdf > 0 && s.direction.z > 0)
          sum += d(s.direction.z) / d(s.pdf) *
                 d(power_heuristic(s.pdf, s.direction.z * PHALANX_INV_PI));
        const Vec3 w = square_to_cosine_hemisphere(random.square());
        const float t = dot(light.p - origin, light.normal) / dot(w, light.normal);
        const Vec3 p = origin + w * t, r = p - light.p, across = cross(light.a, light.b);
        const float u = dot(cross(r, light.b), across) / dot(across, across);
        const float v = dot(cross(light.a, r), across) / dot(across, across);
        const bool inside =
            u >= 0 && v >= 0 && (light.kind == kQuadLight ? u <= 1 && v <= 1 : u + v <= 1);
        const float pdf_bsdf = w.z * PHALANX_INV_PI;
        if (t > 0 && inside && pdf_bsdf > 0)
          sum += kPi * d(power_heuristic(pdf_bsdf, light_pdf_rich(view, view.lights[0], origin, p,
                                                                  light.normal)));
        mean.add(sum);
      }
      // Facing away, the light would be black: both are seen from below, and shine on both sides here.
      CAPTURE(mean.mean());
      CHECK(mean.p(exact_irradiance(light, origin, n)) > alpha());
    }
}

TEST_CASE("solid angle: in the plane, at corners, inside the light nothing is NaN") {
  const FlushDenormals flush;
  Random random(5);
  for (const Light &plain : {kRectangle, kTriangle}) {
    const Light light = by_solid_angle(plain);
    const Scene scene = rich_scene({light});
    const SceneView view = scene.view();
    std::vector<Vec3> origins = {light.p,
                                 light.p + light.a,
                                 light.p + light.b,
                                 light.p + light.a * 0.5f,
                                 light.p + light.a * 0.3f + light.b * 0.3f,
                                 light.p - light.a,
                                 light.p + light.a * 1e6f};
    for (const float h : {1e-3f, 1e-6f, 1e-12f, 1e-25f, 1e-38f})
      origins.push_back(light.p + light.a * 0.25f + light.b * 0.25f - light.normal * h);
    for (const Vec3 origin : origins)
      for (int i = 0; i < 2000; ++i) {
        const Vec2 u =
            i < 4 ? vec2(i & 1 ? 1 - 0x1p-24f : 0, i & 2 ? 1 - 0x1p-24f : 0) : random.square();
        const LightSample s = sample_light_rich(view, origin, random.square(), u);
        REQUIRE(is_finite(s.pdf));
        REQUIRE(s.pdf >= 0.0f);
        if (!(s.pdf > 0)) continue;
        REQUIRE(all_finite(s.direction));
        const Vec3 r = s.point - light.p;
        REQUIRE(length(r) <= length(light.a) + length(light.b));
      }
  }
}
