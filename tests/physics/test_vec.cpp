// Vectors, frames and affine maps.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "../../kernels/physics/vec.h"
#include "../../src/core/parallel.h"
#include "support/random.h"

using namespace phalanx;
using test::Random;

namespace {

/// Largest deviation of a frame from orthonormal and right-handed with third axis n.
double frame_error(Vec3 n) {
  const Frame f = make_frame(n);
  const Vec3 handed = cross(f.s, f.t) - n;
  const float errors[] = {dot(f.s, f.s) - 1, dot(f.t, f.t) - 1, dot(f.s, f.t), dot(f.s, f.n),
                          dot(f.t, f.n),     handed.x,          handed.y,      handed.z};
  double worst = 0;
  for (const float e : errors) worst = std::max(worst, static_cast<double>(std::fabs(e)));
  return f.n.x == n.x && f.n.y == n.y && f.n.z == n.z ? worst : 1.0;
}

double length64(Vec3 v) {
  return std::hypot(static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z));
}

}  // namespace

TEST_CASE("make_frame: orthonormal to 1e-6 in every direction") {
  Random random(1);
  double worst = 0;
  for (int i = 0; i < 1000000; ++i) worst = std::max(worst, frame_error(random.direction()));
  CHECK(worst < 1e-6);
}

TEST_CASE("make_frame: no loss near the poles and at the change of sign") {
  Random random(2);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const double sine = std::pow(10.0, -12 * random.fine()),
                 phi = 6.283185307179586 * random.fine();
    const double cosine = std::sqrt(1 - sine * sine);
    for (const double z : {cosine, -cosine})
      worst = std::max(
          worst, frame_error({static_cast<float>(sine * std::cos(phi)),
                              static_cast<float>(sine * std::sin(phi)), static_cast<float>(z)}));
    const float tiny = static_cast<float>(random.chance(0.5) ? -sine : sine);
    worst = std::max(worst, frame_error({static_cast<float>(std::cos(phi)),
                                         static_cast<float>(std::sin(phi)), tiny * 1e-6f}));
  }
  for (const Vec3 n : {vec3(0, 0, 1), vec3(0, 0, -1), vec3(1, 0, 0.0f), vec3(1, 0, -0.0f),
                       vec3(0, -1, 0.0f), vec3(-1, 0, -0.0f)})
    worst = std::max(worst, frame_error(n));
  CHECK(worst < 1e-6);
}

TEST_CASE("make_frame: to_world undoes to_local") {
  Random random(3);
  double worst = 0;
  for (int i = 0; i < 100000; ++i) {
    const Frame f = make_frame(random.direction());
    const Vec3 v = random.direction();
    worst = std::max(worst, length64(to_world(f, to_local(f, v)) - v));
    worst = std::max(worst, static_cast<double>(std::fabs(to_local(f, v).z - dot(v, f.n))));
  }
  CHECK(worst < 1e-6);
}

TEST_CASE("safe_normalize: keeps length and direction from 1e-30 to 1e38, with denormals flushed") {
  const FlushDenormals flush;
  Random random(4);
  double worst = 0;
  for (int i = 0; i < 200000; ++i) {
    const float size = static_cast<float>(std::pow(10.0, -30 + 68 * random.fine()));
    const Vec3 d = random.direction();
    const Vec3 n = safe_normalize(d * size, vec3(0, 0, 0));
    worst = std::max({worst, std::fabs(length64(n) - 1), length64(n - d)});
  }
  CHECK(worst < 1e-6);
}

TEST_CASE("safe_normalize: falls back where there is no direction") {
  const Vec3 fallback = vec3(0, 1, 0);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const auto falls_back = [&](Vec3 v) { return safe_normalize(v, fallback).y == 1.0f; };
  CHECK(falls_back(vec3(0, 0, 0)));
  CHECK(falls_back(vec3(-0.0f, 0, -0.0f)));
  CHECK(falls_back(vec3(inf, 0, 0)));
  CHECK(falls_back(vec3(1, -inf, 0)));
  CHECK(falls_back(vec3(nan, nan, nan)));
}

TEST_CASE("safe_normalize: any finite vector, denormal or near the largest float") {
  for (const bool flushed : {false, true}) {
    std::unique_ptr<FlushDenormals> flush;
    if (flushed) flush = std::make_unique<FlushDenormals>();
    for (const float size : {1e-45f, 1e-40f, 1.1e-38f, 1.2e-38f, 1e38f, 3.4e38f})
      for (const Vec3 d : {vec3(1, 0, 0), vec3(0.6f, 0, -0.8f), vec3(-1, 1, 1)}) {
        CAPTURE(size);
        CAPTURE(flushed);
        const Vec3 n = safe_normalize(d * size, vec3(0, 0, 1));
        CHECK(length64(n) == doctest::Approx(1).epsilon(1e-6));
      }
  }
}

TEST_CASE("vec: products, lengths, colours") {
  const Vec3 a = vec3(1, 2, 3), b = vec3(-4, 5, 6);
  CHECK(dot(a, b) == 24);
  CHECK(dot(cross(a, b), a) == 0);
  CHECK(cross(vec3(1, 0, 0), vec3(0, 1, 0)).z == 1);
  CHECK((a + b).y == 7);
  CHECK((a - b).x == 5);
  CHECK((a * b).z == 18);
  CHECK((a * 2.0f).z == 6);
  CHECK(neg(a).x == -1);
  CHECK(length_squared(a) == 14);
  CHECK(length(vec3(3, 4, 12)) == 13);
  CHECK(length64(normalize(b)) == doctest::Approx(1).epsilon(1e-7));
  CHECK(abs3(b).x == 4);
  CHECK(max3(a, b).x == 1);
  CHECK(max3(a, b).z == 6);
  CHECK(max_component(b) == 6);
  CHECK(vec2(1, 2).y == 2);
  CHECK(is_black(vec3(0, -0.0f, 0)));
  CHECK_FALSE(is_black(vec3(0, 0, 1e-30f)));
  CHECK(all_finite(a));
  CHECK_FALSE(all_finite(vec3(0, std::numeric_limits<float>::infinity(), 0)));
  CHECK_FALSE(all_finite(vec3(0, 0, std::numeric_limits<float>::quiet_NaN())));
  CHECK(luminance(vec3(1, 1, 1)) == doctest::Approx(1));
  CHECK(luminance(vec3(0, 1, 0)) > luminance(vec3(1, 0, 0)));
}

TEST_CASE("affine: points, vectors, normals and error boxes") {
  const Affine m = {2, 0, 0, 10, 0, 0, -3, 20, 0, 4, 0, 30};
  const Vec3 p = transform_point(m, vec3(1, 2, 3));
  CHECK((p.x == 12 && p.y == 11 && p.z == 38));
  const Vec3 v = transform_vector(m, vec3(1, 2, 3));
  CHECK((v.x == 2 && v.y == -9 && v.z == 8));
  // Rows of the inverse times a normal: it stays perpendicular to the mapped tangents.
  const Affine inverse = {0.5f, 0, 0, 0, 0, 0, 0.25f, 0, 0, -1.0f / 3, 0, 0};
  const Vec3 n = vec3(1, 1, 1), tangent = vec3(1, -1, 0), bitangent = vec3(0, 1, -1);
  const Vec3 mapped = transform_transposed(inverse, n);
  CHECK(dot(mapped, transform_vector(m, tangent)) == doctest::Approx(0));
  CHECK(dot(mapped, transform_vector(m, bitangent)) == doctest::Approx(0));
  const Vec3 box = transform_abs(m, vec3(1, 2, 3));
  CHECK((box.x == 12 && box.y == 29 && box.z == 38));
}

TEST_CASE("rays that ray queries do not take are told apart (G14)") {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  const Vec3 o = vec3(1, -2, 3), d = vec3(0, 1, 0);
  CHECK(is_traceable(o, d));
  CHECK(is_traceable(vec3(-1.8e18f, 0, 1.8e18f), d));
  for (const float bad : {nan, inf, -inf, 2e18f, -3e38f})
    for (const Vec3 from : {vec3(bad, 0, 0), vec3(0, bad, 0), vec3(0, 0, bad)}) CHECK_FALSE(is_traceable(from, d));
  for (const float bad : {nan, inf, -inf})
    for (const Vec3 to : {vec3(bad, 0, 0), vec3(0, bad, 0), vec3(0, 0, bad)}) CHECK_FALSE(is_traceable(o, to));
}
