// Warps of the unit square: each fills its shape with the density it claims.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../../kernels/physics/warp.h"
#include "support/random.h"
#include "support/statistics.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

/// Fits `place(u)`, a point of the grid's rectangle for a sample of the square, to `density`.
template <typename Place, typename Density>
void check_fit(Grid grid, const Place &place, const Density &density) {
  Random random(42);
  Histogram histogram(grid);
  for (int i = 0; i < num_samples(); ++i) {
    const auto [x, y] = place(random.square());
    histogram.add(x, y);
  }
  const Fit fit = chi_square_fit(histogram, cell_masses(grid, density));
  CAPTURE(grid.nx);
  INFO(fit.text());
  CHECK(fit.accepted());
  CHECK(fit.mass == doctest::Approx(1).epsilon(1e-4));
}

struct Point {
  double x, y;
};
Point cosine_and_azimuth(Vec3 w) {
  return {static_cast<double>(w.z), azimuth(static_cast<double>(w.x), static_cast<double>(w.y))};
}

bool is_unit(Vec3 w) {
  return std::fabs(static_cast<double>(w.x) * static_cast<double>(w.x) +
                   static_cast<double>(w.y) * static_cast<double>(w.y) +
                   static_cast<double>(w.z) * static_cast<double>(w.z) - 1) < 5e-7;
}

/// Calls work(u) for corners, edges and random points of the square.
template <typename Work>
void for_squares(const Work &work) {
  const float most = 1 - 0x1p-24f;
  for (const float x : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, most})
    for (const float y : {0.0f, 0x1p-24f, 0.25f, 0.5f, 0.75f, most}) work(vec2(x, y));
  Random random(9);
  for (int i = 0; i < 100000; ++i) work(random.square());
}

}  // namespace

TEST_CASE("warp: disk is uniform in area") {
  const auto place = [](Vec2 u) {
    const Vec2 d = square_to_disk(u);
    const double x = static_cast<double>(d.x), y = static_cast<double>(d.y);
    return Point{x * x + y * y, azimuth(x, y)};
  };
  const auto density = [](double, double) { return 0.5 / kPi; };
  check_fit(hemisphere_grid(10, 20), place, density);
  check_fit(hemisphere_grid(64, 128), place, density);
}

TEST_CASE("warp: cosine hemisphere has density cos / pi") {
  const auto place = [](Vec2 u) { return cosine_and_azimuth(square_to_cosine_hemisphere(u)); };
  const auto density = [](double z, double) {
    return static_cast<double>(pdf_cosine_hemisphere(static_cast<float>(z)));
  };
  check_fit(hemisphere_grid(10, 20), place, density);
  check_fit(hemisphere_grid(64, 128), place, density);
  CHECK(pdf_cosine_hemisphere(-0.5f) == 0.0f);
}

TEST_CASE("warp: sphere is uniform") {
  const auto place = [](Vec2 u) { return cosine_and_azimuth(square_to_sphere(u)); };
  const auto density = [](double, double) { return static_cast<double>(pdf_sphere()); };
  check_fit(sphere_grid(10, 20), place, density);
  check_fit(sphere_grid(64, 128), place, density);
}

TEST_CASE("warp: cone is uniform in solid angle, down to 1e-5 rad") {
  for (const double angle : {3.14159265358979, 2.0, 1.0, 0.1, 1e-3, 3e-4, 1e-4, 1e-5}) {
    CAPTURE(angle);
    const double half = std::sin(angle / 2), width = 2 * half * half;  // 1 - cos
    // Fraction of the cone's solid angle inside the direction, from the sine: digits for all.
    const auto place = [&](Vec2 u) {
      const Vec3 w = square_to_cone(u, static_cast<float>(width));
      const double x = static_cast<double>(w.x), y = static_cast<double>(w.y);
      const double sin2 = x * x + y * y, root = std::sqrt(std::max(1 - sin2, 0.0));
      const double h = w.z >= 0 ? sin2 / (1 + root) : 1 + root;
      return Point{h / width, azimuth(x, y)};
    };
    const auto density = [&](double, double) {
      return width * static_cast<double>(pdf_cone(static_cast<float>(width)));
    };
    check_fit(hemisphere_grid(10, 20), place, density);
    check_fit(hemisphere_grid(64, 128), place, density);
  }
}

TEST_CASE("warp: one_minus_cos_from_sin2 keeps its digits for narrow cones (L3)") {
  for (double sine = 1; sine > 1e-18; sine *= 0.7) {
    const float sin2 = static_cast<float>(sine * sine);
    const double s2 = static_cast<double>(sin2);
    const double exact = s2 / (1 + std::sqrt(1 - s2));
    CHECK(relative_error(static_cast<double>(one_minus_cos_from_sin2(sin2)), exact) < 3e-7);
    CHECK(is_finite(pdf_cone(one_minus_cos_from_sin2(sin2))));
  }
  CHECK(one_minus_cos_from_sin2(1.0f) == 1.0f);
}

TEST_CASE("warp: triangle is uniform in area") {
  // (s, t) = (b1 + b2, b2 / (b1 + b2)) maps the triangle to a square, with density 2 s.
  const auto place = [](Vec2 u) {
    const Vec2 b = square_to_triangle(u);
    const double s = static_cast<double>(b.x) + static_cast<double>(b.y);
    return Point{s, s > 0 ? static_cast<double>(b.y) / s : 0};
  };
  const auto density = [](double s, double) { return 2 * s; };
  check_fit({10, 20, 0, 1, 0, 1}, place, density);
  check_fit({64, 128, 0, 1, 0, 1}, place, density);
}

TEST_CASE("warp: corners and edges of the square stay inside the shapes") {
  for_squares([](Vec2 u) {
    const Vec2 d = square_to_disk(u);
    REQUIRE(d.x * d.x + d.y * d.y <= 1.0f + 2e-7f);
    REQUIRE(is_unit(square_to_sphere(u)));
    const Vec3 w = square_to_cosine_hemisphere(u);
    REQUIRE(w.z >= 0.0f);
    REQUIRE(is_unit(w));
    for (const float width : {2.0f, 1.0f, 1e-3f, 1e-8f, 1e-12f}) {
      const Vec3 c = square_to_cone(u, width);
      REQUIRE(is_unit(c));
      REQUIRE(1.0f - c.z <= width + 1.2e-7f);
    }
    const Vec2 b = square_to_triangle(u);
    REQUIRE(b.x >= 0.0f);
    REQUIRE(b.y >= 0.0f);
    REQUIRE(b.x + b.y <= 1.0f);
  });
  const Vec2 middle = square_to_disk(vec2(0.5f, 0.5f));
  CHECK((middle.x == 0.0f && middle.y == 0.0f));
}

TEST_CASE("warp: diagonals of the square stay diagonals of the disk, axes axes") {
  for (int i = 1; i <= 64; ++i) {
    const float half = static_cast<float>(i) / 128;
    for (const float side : {-1.0f, 1.0f}) {
      const Vec2 corner = square_to_disk(vec2(0.5f + half, 0.5f + side * half));
      CHECK(corner.x == doctest::Approx(side * corner.y).epsilon(1e-6));
      CHECK(std::hypot(corner.x, corner.y) == doctest::Approx(2 * half).epsilon(1e-6));
      CHECK(square_to_disk(vec2(0.5f + side * half, 0.5f)).y == 0.0f);
      CHECK(std::fabs(square_to_disk(vec2(0.5f, 0.5f + side * half)).x) < 1e-7f);
    }
  }
}

TEST_CASE("warp: disk of a stratified square is area-preserving cell by cell") {
  // Jacobian by central differences in double-sized steps: |d(x,y)/d(u,v)| = pi.
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const float h = 0x1p-7f;
    const Vec2 u = vec2(random.between(h, 1 - h), random.between(h, 1 - h));
    const float a = 2 * u.x - 1, b = 2 * u.y - 1;
    if (std::fabs(std::fabs(a) - std::fabs(b)) < 4 * h ||
        std::max(std::fabs(a), std::fabs(b)) < 0.1f)
      continue;  // the map has a crease on the diagonals
    const Vec2 px = square_to_disk(vec2(u.x + h, u.y)), mx = square_to_disk(vec2(u.x - h, u.y));
    const Vec2 py = square_to_disk(vec2(u.x, u.y + h)), my = square_to_disk(vec2(u.x, u.y - h));
    const float det = ((px.x - mx.x) * (py.y - my.y) - (px.y - mx.y) * (py.x - my.x)) / (4 * h * h);
    CHECK(static_cast<double>(std::fabs(det)) == doctest::Approx(kPi).epsilon(0.03));
  }
}
