// Spheres and disks against exact oracles, near and very far. STABILITY S3, G9, B5.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../../kernels/physics/shape.h"
#include "support/random.h"
#include "support/statistics.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

using Real = long double;
Real real(float x) { return static_cast<Real>(x); }

struct Crossings {
  bool met;
  Real first, second;
};
Crossings exact_sphere(Vec3 origin, Vec3 direction, Sphere s) {
  const Real fx = real(origin.x) - real(s.center.x), fy = real(origin.y) - real(s.center.y);
  const Real fz = real(origin.z) - real(s.center.z);
  const Real dx = real(direction.x), dy = real(direction.y), dz = real(direction.z);
  const Real a = dx * dx + dy * dy + dz * dz, t = -(fx * dx + fy * dy + fz * dz) / a;
  const Real px = fx + dx * t, py = fy + dy * t, pz = fz + dz * t;
  const Real rest = real(s.radius) * real(s.radius) - (px * px + py * py + pz * pz);
  if (rest < 0) return {false, 0, 0};
  const Real half = std::sqrt(rest / a);
  return {true, t - half, t + half};
}

/// A unit ray from distance `far` radii at a random point of 1.5 times the sphere's disk.
void aim(Random &random, const Sphere &s, double far, Vec3 &origin, Vec3 &direction) {
  const Frame f = make_frame(random.direction());
  const float offset = 1.5f * std::sqrt(random.unit()) * s.radius, phi = 6.2831853f * random.unit();
  origin = s.center + f.n * (static_cast<float>(far) * s.radius);
  const Vec3 target = s.center + (f.s * std::cos(phi) + f.t * std::sin(phi)) * offset;
  direction = normalize(target - origin);
}

}  // namespace

TEST_CASE("sphere: hit or miss, and distance, agree with an exact oracle from afar (S3)") {
  for (const float radius : {1e-3f, 1.0f, 3e5f})
    for (const double far : {3.0, 100.0, 8e3, 1e4, 2e5, 1e6})
      for (const bool moved : {false, true}) {
        Random random(1);
        int wrong = 0, off = 0;
        double worst = 0;
        const int n = 200000;
        for (int i = 0; i < n; ++i) {
          Sphere s = {{0, 0, 0}, radius};
          Vec3 origin, direction;
          aim(random, s, far, origin, direction);
          if (moved) {  // the sphere instead of the camera
            s.center = neg(origin);
            origin = {0, 0, 0};
          }
          const Crossings exact = exact_sphere(origin, direction, s);
          const ShapeHit hit = intersect_sphere(origin, direction, s, 0, PHALANX_FAR);
          if ((hit.t > 0) != exact.met) {
            ++wrong;
          } else if (exact.met) {
            REQUIRE(hit.far_root == 0);
            const auto error =
                static_cast<double>(std::fabs(real(hit.t) - exact.first) / real(radius));
            worst = std::max(worst, error);
            off += error > 1e-2;
          }
        }
        CAPTURE(radius);
        CAPTURE(far);
        CAPTURE(moved);
        CAPTURE(worst);
        // The line is known to 6e-8 far radii. At the silhouette, one ray in a thousand, that e
        // sideways is worth sqrt(2 e) along it.
        CHECK(worst < 3 * std::sqrt(6e-8 * far) + 6e-8 * far);
        if (far <= 1e4) CHECK(off <= n * 1e-3);
        CHECK(wrong <= n * std::max(1e-4, 1e-8 * far));
      }
}

TEST_CASE("sphere: roots lie on the sphere, from inside and outside, in units of the direction") {
  Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const Sphere s = {random.point(2), random.between(0.1f, 2)};
    const Vec3 origin = random.point(4),
               inside = s.center + random.direction() * (s.radius * random.unit());
    const Vec3 direction = (inside - origin) * std::exp(random.between(-5, 5));
    const Crossings exact = exact_sphere(origin, direction, s);
    const float length_of = length(direction);
    if (!exact.met || !(length_of > 1e-4f)) continue;
    REQUIRE(std::fabs(real(sphere_root(origin, direction, s, 0)) - exact.first) * real(length_of) <
            1e-3L);
    REQUIRE(std::fabs(real(sphere_root(origin, direction, s, 1)) - exact.second) * real(length_of) <
            1e-3L);
    const ShapeHit hit = intersect_sphere(origin, direction, s, 0, PHALANX_FAR);
    const float outside = length(origin - s.center) - s.radius;
    if (std::fabs(outside) < 1e-5f) continue;
    REQUIRE(hit.far_root == (outside < 0 ? 1 : 0));
    REQUIRE(hit.t == sphere_root(origin, direction, s, hit.far_root));
  }
}

TEST_CASE("sphere: only crossings between t_min and t_max count") {
  const Sphere s = {{0, 0, 0}, 1};
  const Vec3 origin = {0, 0, -3}, direction = {0, 0, 1};
  CHECK(intersect_sphere(origin, direction, s, 0, 10).t == 2.0f);
  CHECK(intersect_sphere(origin, direction, s, 0, 10).far_root == 0);
  CHECK(intersect_sphere(origin, direction, s, 0, 1.9f).t < 0);
  CHECK(intersect_sphere(origin, direction, s, 2.5f, 10).t == 4.0f);
  CHECK(intersect_sphere(origin, direction, s, 2.5f, 10).far_root == 1);
  CHECK(intersect_sphere(origin, direction, s, 2.5f, 3.5f).t < 0);
  CHECK(intersect_sphere(origin, neg(direction), s, 0, 10).t < 0);
  CHECK(intersect_sphere(origin, vec3(0, 1, 0), s, 0, 10).t < 0);
}

TEST_CASE("sphere: from its centre and from its surface (G9)") {
  Random random(3);
  for (int i = 0; i < 20000; ++i) {
    const Sphere s = {random.point(1), random.between(0.1f, 2)};
    const Vec3 n = random.direction(), w = random.direction();
    const ShapeHit centre = intersect_sphere(s.center, w, s, 0, PHALANX_FAR);
    REQUIRE(std::fabs(centre.t - s.radius) < 1e-5f);
    REQUIRE(centre.far_root == 1);
    if (std::fabs(dot(n, w)) < 0.05f) continue;
    const Vec3 origin = s.center + n * s.radius;
    const float chord = -2 * dot(n, w) * s.radius;
    const ShapeHit hit = intersect_sphere(origin, w, s, 1e-3f * s.radius, PHALANX_FAR);
    REQUIRE((hit.t > 0) == (chord > 0));
    if (chord > 0) REQUIRE(std::fabs(hit.t - chord) < 1e-4f);
  }
}

TEST_CASE("sphere: tiny, huge and tangent spheres stay finite (G10)") {
  for (const float radius : {1e-20f, 1e-15f, 1e15f, 1e18f})
    for (const float off : {0.0f, 0.5f, 1.0f, 1.0000001f}) {
      const Sphere s = {{0, 0, 0}, radius};
      const Vec3 origin = {off * radius, 0, -3 * radius};
      const ShapeHit hit = intersect_sphere(origin, vec3(0, 0, 1), s, 0, PHALANX_FAR);
      CHECK(is_finite(hit.t));
      CHECK(is_finite(sphere_root(origin, vec3(0, 0, 1), s, 0)));
      CHECK(is_finite(sphere_root(origin, vec3(0, 0, 1), s, 1)));
    }
}

TEST_CASE("disk: agrees with a double-precision oracle") {
  Random random(4);
  int hits = 0, wrong = 0;
  for (int i = 0; i < 200000; ++i) {
    const Frame f = make_frame(random.direction());
    const float radius = random.between(0.1f, 2);
    const Disk disk = {random.point(1), f.s * radius, f.t * radius};
    const Vec3 origin = random.point(4),
               direction = normalize(disk.center + random.point(2) - origin);
    const ShapeHit hit = intersect_disk(origin, direction, disk, 0, PHALANX_FAR);
    const auto dot64 = [](Vec3 a, Vec3 b) {
      return static_cast<double>(a.x) * static_cast<double>(b.x) +
             static_cast<double>(a.y) * static_cast<double>(b.y) +
             static_cast<double>(a.z) * static_cast<double>(b.z);
    };
    const double slope = dot64(direction, f.n);
    if (std::fabs(slope) < 0.01) continue;
    const double t = (dot64(disk.center, f.n) - dot64(origin, f.n)) / slope;
    const auto along = [&](Vec3 axis) {
      return (dot64(origin, axis) + t * dot64(direction, axis) - dot64(disk.center, axis)) /
             static_cast<double>(radius);
    };
    const double r = std::hypot(along(f.s), along(f.t));
    if (std::fabs(r - 1) < 1e-3 || std::fabs(t) < 1e-3) continue;
    const bool met = t > 0 && r < 1;
    wrong += met != (hit.t > 0);
    if (!met || !(hit.t > 0)) continue;
    ++hits;
    REQUIRE(std::fabs(static_cast<double>(hit.t) - t) < 1e-3);
    REQUIRE(hit.far_root == 0);
    const Vec2 xy = disk_coordinates(origin + direction * hit.t, disk);
    REQUIRE(std::fabs(static_cast<double>(xy.x) - along(f.s)) < 1e-3);
    REQUIRE(std::fabs(static_cast<double>(xy.y) - along(f.t)) < 1e-3);
  }
  CHECK(wrong == 0);
  CHECK(hits > 10000);
}

TEST_CASE("disk: parallel rays, bounds of t, and the rim") {
  const Disk disk = {{0, 0, 2}, {3, 0, 0}, {0, 3, 0}};
  CHECK(intersect_disk(vec3(0, 0, 0), vec3(0, 0, 1), disk, 0, 10).t == 2.0f);
  CHECK(intersect_disk(vec3(0, 0, 0), vec3(0, 0, 2), disk, 0, 10).t == 1.0f);
  CHECK(intersect_disk(vec3(0, 0, 0), vec3(0, 0, 1), disk, 0, 2).t < 0);
  CHECK(intersect_disk(vec3(0, 0, 0), vec3(0, 0, 1), disk, 2, 10).t < 0);
  CHECK(intersect_disk(vec3(0, 0, 0), vec3(0, 0, -1), disk, 0, 10).t < 0);
  CHECK(intersect_disk(vec3(0, 0, 0), vec3(1, 0, 0), disk, 0, 10).t < 0);
  CHECK(intersect_disk(vec3(0, 0, 2), vec3(1, 0, 0), disk, 0, 10).t < 0);
  CHECK(intersect_disk(vec3(2.999f, 0, 0), vec3(0, 0, 1), disk, 0, 10).t == 2.0f);
  CHECK(intersect_disk(vec3(3.001f, 0, 0), vec3(0, 0, 1), disk, 0, 10).t < 0);
  CHECK(disk_plane_distance(vec3(0, 0, 0), vec3(1, 0, 0), disk) == 0.0f);
  const Vec2 xy = disk_coordinates(vec3(1.5f, -3, 7), disk);
  CHECK((xy.x == 0.5f && xy.y == -1.0f));
}
