// Sampled points of every kind of light follow light_pdf, from wherever the light is seen.
//
// Points count in the parameters of the light's surface, (u, v), where the density per solid angle
// becomes one per parameter area by the geometry alone: pdf * cos / d^2 * |d position / d(u,v)|.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "support/lights.h"
#include "support/random.h"
#include "support/statistics.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

double d(float x) { return static_cast<double>(x); }
double dot64(Vec3 a, Vec3 b) { return d(a.x) * d(b.x) + d(a.y) * d(b.y) + d(a.z) * d(b.z); }
float f(double x) { return static_cast<float>(x); }

/// A point of a light: its parameters, and how much surface they stand for.
struct SurfacePoint {
  Vec3 position, normal;
  double area;  // of the surface per unit area of the parameters
};

struct PlanarSpace {  // quads (u, v), triangles (u + v, v / (u + v)), disks (r^2, phi)
  Light light;
  Grid grid(int nx, int ny) const {
    return light.kind == kDiskLight ? hemisphere_grid(nx, ny) : Grid{nx, ny, 0, 1, 0, 1};
  }
  void count(Histogram &histogram, Vec3 position) const {
    const Vec3 r = position - light.p;
    const double aa = dot64(light.a, light.a), ab = dot64(light.a, light.b);
    const double bb = dot64(light.b, light.b), ra = dot64(r, light.a), rb = dot64(r, light.b);
    const double det = aa * bb - ab * ab;
    const double u = (ra * bb - rb * ab) / det, v = (rb * aa - ra * ab) / det;
    if (light.kind == kDiskLight)
      histogram.add(u * u + v * v, azimuth(u, v));
    else if (light.kind == kTriangleLight)
      histogram.add(u + v, u + v > 0 ? v / (u + v) : 0);
    else
      histogram.add(u, v);
  }
  SurfacePoint at(double x, double y) const {
    double u = x, v = y, area = std::sqrt(dot64(cross(light.a, light.b), cross(light.a, light.b)));
    if (light.kind == kDiskLight) {
      u = std::sqrt(x) * std::cos(y), v = std::sqrt(x) * std::sin(y);
      area *= 0.5;
    } else if (light.kind == kTriangleLight) {
      u = x * (1 - y), v = x * y;
      area *= x;
    }
    return {light.p + light.a * f(u) + light.b * f(v), light.normal, area};
  }
};

struct SphereSpace {  // cosine and azimuth around `axis`, from cosine `least` up
  Light light;
  Frame frame;
  double least;
  Grid grid(int nx, int ny) const { return {nx, ny, least, 1, 0, 2 * kPi}; }
  void count(Histogram &histogram, Vec3 position) const {
    const Vec3 n = to_local(frame, (position - light.p) * (1 / light.radius));
    histogram.add(d(n.z), azimuth(d(n.x), d(n.y)));
  }
  SurfacePoint at(double z, double phi) const {
    const double r = std::sqrt(std::max(1 - z * z, 0.0));
    const Vec3 n = to_world(frame, vec3(f(r * std::cos(phi)), f(r * std::sin(phi)), f(z)));
    return {light.p + n * light.radius, n, d(light.radius) * d(light.radius)};
  }
};

template <typename Space>
void check_sampling(const Light &light, Vec3 origin, const Space &space) {
  const LightScene scene({light});
  Random random(31);
  Histogram coarse(space.grid(10, 20)), fine(space.grid(64, 128));
  for (int i = 0; i < num_samples(); ++i) {
    const LightSample s = sample_light(scene.view, origin, random.square(), random.square());
    for (Histogram *histogram : {&coarse, &fine}) {
      if (s.pdf > 0)
        space.count(*histogram, s.point);
      else
        histogram->add_invalid();
    }
  }
  const auto density = [&](double x, double y) {
    const SurfacePoint p = space.at(x, y);
    const Vec3 to_light = p.position - origin;
    const double d2 = dot64(to_light, to_light);
    return d(light_pdf(light, origin, p.position, p.normal)) *
           std::fabs(dot64(p.normal, to_light)) / (d2 * std::sqrt(d2)) * p.area;
  };
  CAPTURE(light.kind);
  CAPTURE(length(light.p - origin));
  for (const Histogram *histogram : {&coarse, &fine}) {
    const Fit fit = chi_square_fit(*histogram, cell_masses(histogram->grid(), density));
    INFO(fit.text());
    CHECK(fit.accepted());
    CHECK(fit.mass == doctest::Approx(1).epsilon(1e-3));
  }
}

const Vec3 kViews[] = {{0.3f, 0.2f, -3}, {4, -1, 0.5f}, {0.25f, 0.4f, 0.9f}, {50, 20, -80}};

}  // namespace

TEST_CASE("quad light: points follow light_pdf, which integrates to 1") {
  const Light light =
      planar_light(kQuadLight, {-0.5f, -0.2f, 1}, {1, 0.1f, 0.2f}, {0.2f, 1.5f, -0.1f});
  for (const Vec3 origin : kViews) check_sampling(light, origin, PlanarSpace{light});
}

TEST_CASE("triangle light: points follow light_pdf, which integrates to 1") {
  const Light light =
      planar_light(kTriangleLight, {-0.5f, -0.2f, 1}, {2, 0.1f, 0.2f}, {0.2f, 1.5f, -0.1f});
  for (const Vec3 origin : kViews) check_sampling(light, origin, PlanarSpace{light});
}

TEST_CASE("disk light: points follow light_pdf, which integrates to 1") {
  const Light light = disk_light({0.1f, 0.2f, 1.5f}, normalize(vec3(0.2f, -0.3f, -1)), 0.8f);
  for (const Vec3 origin : kViews) check_sampling(light, origin, PlanarSpace{light});
}

TEST_CASE("sphere light: from outside, points fill the cap in sight by light_pdf (L3)") {
  for (const double ratio : {0.999, 0.9, 0.5, 0.1, 1e-2, 1e-4}) {  // R / d
    const Light light = sphere_light({0.2f, -0.4f, 0.3f}, 0.7f);
    const Vec3 away = normalize(vec3(0.3f, 0.5f, -0.8f));
    const Vec3 origin = light.p + away * f(d(light.radius) / ratio);
    const double true_ratio =
        d(light.radius) / std::sqrt(dot64(origin - light.p, origin - light.p));
    check_sampling(light, origin, SphereSpace{light, make_frame(away), true_ratio});
  }
}

TEST_CASE("sphere light: from within, points fill the whole sphere by light_pdf (G9)") {
  const Light light = sphere_light({0.2f, -0.4f, 0.3f}, 0.7f);
  for (const float r : {0.0f, 0.2f, 0.5f, 0.69f}) {
    const Vec3 away = normalize(vec3(0.3f, 0.5f, -0.8f));
    check_sampling(light, light.p + away * r, SphereSpace{light, make_frame(away), -1});
  }
}
