// The environment map: directions follow their density, densities cover all light, integrals come out.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "support/random.h"
#include "support/rich_lights.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

double d(float x) { return static_cast<double>(x); }

using Pixel = std::function<double(int column, int row)>;

EnvironmentMap grey_map(int width, int height, const Pixel &value, double turns = 0) {
  EnvironmentMap map;
  map.width = width;
  map.height = height;
  map.turns = turns;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      map.texels.insert(map.texels.end(), 3, static_cast<float>(value(column, row)));
  return map;
}

double noise(int column, int row) {
  return d(Random(static_cast<std::uint64_t>(column * 1000 + row)).unit());
}

/// Maps that go wrong easily: even, one bright texel, black rows and columns, wide range, odd sizes.
std::vector<EnvironmentMap> maps() {
  return {
      grey_map(1, 1, [](int, int) { return 2.0; }),
      grey_map(2, 1, [](int x, int) { return x == 0 ? 1.0 : 0.25; }),
      grey_map(8, 4, noise, 0.1),
      grey_map(5, 3, noise, -0.3),
      grey_map(16, 8, [](int x, int y) { return y == 0 || y > 5 || x < 3 ? 0.0 : noise(x, y); }),
      grey_map(
          64, 32, [](int x, int y) { return x == 20 && y == 9 ? 1e10 : 0.0; }, 0.4),
      grey_map(64, 32, [](int x, int y) { return x == 20 && y == 0 ? 1e4 : 1.0; }),
      grey_map(32, 16, [](int x, int y) { return std::pow(10, 8 * noise(x, y) - 4); })};
}

/// Integral of the density over a rectangle of cosines to +y and longitudes (turns from the map's left
/// edge): exact, the density is constant in each texel.
double exact_mass(const SceneView &view, double z0, double z1, double x0, double x1) {
  const int width = view.environment_width, height = view.environment_height;
  double sum = 0;
  for (int row = 0; row < height; ++row) {
    const double upper = std::cos(kPi * row / height), lower = std::cos(kPi * (row + 1) / height);
    const double dz = std::min(z1, upper) - std::max(z0, lower);
    if (dz <= 0) continue;
    for (int column = 0; column < width; ++column) {
      const double dx = std::min(x1, (column + 1.0) / width) - std::max(x0, 1.0 * column / width);
      if (dx > 0) sum += d(texel_pdf(view, column, row)) * dz * dx * 2 * kPi;
    }
  }
  return sum;
}

std::vector<double> exact_masses(const SceneView &view, const Grid &grid) {
  std::vector<double> masses;
  for (int i = 0; i < grid.nx; ++i)
    for (int j = 0; j < grid.ny; ++j)
      masses.push_back(exact_mass(view, -1 + 2.0 * i / grid.nx, -1 + 2.0 * (i + 1) / grid.nx,
                                  1.0 * j / grid.ny, (j + 1.0) / grid.ny));
  return masses;
}

}  // namespace

TEST_CASE("environment map: directions follow the density, which integrates to 1 (L1, L13)") {
  for (EnvironmentMap &map : maps()) {
    const Scene scene = rich_scene({environment_light()}, map);
    const SceneView view = scene.view();
    CAPTURE(map.width);
    CAPTURE(exact_mass(view, -1, 1, 0, 1));
    CHECK(relative_error(exact_mass(view, -1, 1, 0, 1), 1) < 1e-5);
    Histogram coarse({10, 20, -1, 1, 0, 1}), fine({64, 128, -1, 1, 0, 1});
    Random random(5);
    for (int i = 0; i < num_samples(); ++i) {
      const EnvironmentSample s = sample_environment(view, random.square());
      const Vec3 w = to_local(environment_frame(view), s.direction);
      // Longitude in double, from the middle column at -z.
      double x = 0.5 + std::atan2(d(w.x), -d(w.z)) / (2 * kPi);
      if (x >= 1) x -= 1;
      coarse.add(d(w.y), x);
      fine.add(d(w.y), x);
    }
    for (const Histogram *h : {&coarse, &fine}) {
      const Fit fit = chi_square_fit(*h, exact_masses(view, h->grid()));
      INFO(fit.text());
      CHECK(fit.accepted());
    }
  }
}

TEST_CASE(
    "environment map: samples agree with lookups of their direction, also at seam and poles") {
  for (EnvironmentMap &map : maps()) {
    const Scene scene = rich_scene({environment_light()}, map);
    const SceneView view = scene.view();
    Random random(6);
    int num_off = 0;
    for (int i = 0; i < 100000; ++i) {
      Vec2 u = random.square();
      if (random.chance(0.1)) u.x = random.chance(0.5) ? 0 : 1 - 0x1p-24f;
      if (random.chance(0.1)) u.y = random.chance(0.5) ? 0 : 1 - 0x1p-24f;
      const EnvironmentSample s = sample_environment(view, u);
      REQUIRE(s.pdf > 0);
      REQUIRE(std::fabs(length(s.direction) - 1) < 1e-6f);
      const Vec2 uv = environment_uv(to_local(environment_frame(view), s.direction));
      REQUIRE(std::fabs(uv.y - s.uv.y) < 1e-6f);
      // On the border between two texels, rounding may tell them apart differently.
      num_off += relative_error(d(environment_pdf(view, uv)), d(s.pdf)) > 1e-5;
    }
    CAPTURE(map.width);
    CHECK(num_off < 100000 / 100 * 25);  // a tenth each was put on the border
  }
  const Scene scene = rich_scene({environment_light()}, maps()[2]);
  const SceneView view = scene.view();
  for (const Vec3 w :
       {vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(-0.0f, 0, 1), vec3(1e-30f, 1, 0)}) {
    const Vec2 uv = environment_uv(w);
    CHECK((uv.x >= 0 && uv.x <= 1 && uv.y >= 0 && uv.y <= 1));
    CHECK(is_finite(environment_pdf(view, uv)));
    CHECK(all_finite(environment_radiance(view, uv)));
  }
}

TEST_CASE("environment map: where there is light there is density (L4)") {
  for (EnvironmentMap &map : maps()) {
    const Scene scene = rich_scene({environment_light()}, map);
    const SceneView view = scene.view();
    Random random(7);
    for (int i = 0; i < 100000; ++i) {
      const Vec2 uv = environment_uv(random.direction());
      if (environment_radiance(view, uv).x > 0) REQUIRE(environment_pdf(view, uv) > 0);
    }
  }
  Scene scene;
  CHECK(set_environment_map(grey_map(8, 4, [](int, int) { return 0.0; }), scene) == 0);
  CHECK(scene.environment_width == 0);
}

TEST_CASE("environment map: sampled, met and both with weights give the same integral") {
  for (EnvironmentMap &map : maps()) {
    const Scene scene = rich_scene({environment_light()}, map);
    const SceneView view = scene.view();
    const Vec3 n = normalize(vec3(0.3f, 0.8f, -0.5f)), origin = {1, 2, 3};
    const Frame frame = make_frame(n);
    // Irradiance on a surface facing n, by the midpoint rule in double.
    double expected = 0;
    constexpr int kRows = 1024;
    for (int i = 0; i < kRows; ++i)
      for (int j = 0; j < 2 * kRows; ++j) {
        const double theta = kPi * (i + 0.5) / kRows, phi = kPi * (j + 0.5) / kRows;
        const Vec3 w = vec3(static_cast<float>(std::sin(theta) * std::cos(phi)),
                            static_cast<float>(std::cos(theta)),
                            static_cast<float>(std::sin(theta) * std::sin(phi)));
        const double cosine = d(dot(w, n));
        if (cosine <= 0) continue;
        const Vec2 uv = environment_uv(to_local(environment_frame(view), w));
        expected += d(environment_radiance(view, uv).x) * cosine * std::sin(theta) * (kPi / kRows) *
                    (kPi / kRows);
      }
    Mean sampled, both;
    Random random(8);
    for (int i = 0; i < 400000; ++i) {
      const LightSample s = sample_light_rich(view, origin, random.square(), random.square());
      const float cosine = dot(s.direction, n), pdf_bsdf = cosine * PHALANX_INV_PI;
      const double value = cosine > 0 ? d(s.radiance.x) * d(cosine) / d(s.pdf) : 0;
      sampled.add(value);
      double sum = cosine > 0 ? value * d(power_heuristic(s.pdf, pdf_bsdf)) : 0;
      const Vec3 local = square_to_cosine_hemisphere(random.square());
      const float pdf = local.z * PHALANX_INV_PI;
      if (pdf > 0) sum += kPi * d(infinite_radiance(view, origin, to_world(frame, local), pdf).x);
      both.add(sum);
    }
    CAPTURE(map.width);
    CAPTURE(expected);
    CAPTURE(sampled.mean() / expected);
    CAPTURE(both.mean() / expected);
    CHECK(sampled.p(expected, 1e-3 * expected) > alpha());
    CHECK(both.p(expected, 1e-3 * expected) > alpha());
    // Drawn in proportion to the light, weights of samples stay bounded: 4 is the worst of a lone texel.
    if (map.width > 1) CHECK(std::sqrt(sampled.variance()) < 3 * expected);
  }
}

TEST_CASE("environment map: one texel is a constant environment") {
  const Scene scene = rich_scene({environment_light()}, maps()[0]);
  const SceneView view = scene.view();
  Random random(9);
  for (int i = 0; i < 1000; ++i) {
    const LightSample s =
        sample_light_rich(view, random.point(1e6f), random.square(), random.square());
    REQUIRE(s.radiance.x == doctest::Approx(2));
    REQUIRE(d(s.pdf) == doctest::Approx(1 / (4 * kPi)));
    REQUIRE(s.is_delta == 0);
    REQUIRE(s.distance == PHALANX_FAR);
    REQUIRE(infinite_radiance(view, random.point(1), random.direction(), 0).x ==
            doctest::Approx(2));
  }
}

TEST_CASE("environment map: up is the first row, the middle column at -z, columns run towards +x") {
  const auto look = [](Vec3 w, double turns) {
    const EnvironmentMap map = grey_map(
        4, 3, [](int x, int y) { return 10 * y + x; }, turns);
    const Scene scene = rich_scene({environment_light()}, map);
    return infinite_radiance(scene.view(), vec3(0, 0, 0), w, 0).x;
  };
  CHECK(look({0, 1, 0}, 0) < 5);                        // row 0
  CHECK(look({0, -1, 0}, 0) > 18);                      // row 2
  CHECK(look({0, 0, -1}, 0) == doctest::Approx(11.5));  // between columns 1 and 2
  CHECK(look({1, 0, 0}, 0) == doctest::Approx(12.5));   // between 2 and 3
  CHECK(look({-1, 0, 0}, 0) == doctest::Approx(10.5));  // between 0 and 1
  // A quarter counter-clockwise from above: what was at -z is at -x.
  CHECK(look({-1, 0, 0}, 0.25) == doctest::Approx(11.5));
  CHECK(look({0, 0, -1}, 0.25) == doctest::Approx(12.5));
}

TEST_CASE("environment map: places within an interval keep their digits among a million (L1)") {
  const int32 count = 1 << 20;
  std::vector<double> cdf(static_cast<std::size_t>(count) + 1);
  for (int32 i = 0; i <= count; ++i) cdf[static_cast<std::size_t>(i)] = d(static_cast<float>(i)) / count;
  // Off the grid of single precision, where its rounding would show.
  for (int32 i = 1; i < count; ++i) cdf[static_cast<std::size_t>(i)] += 3e-9;
  Random random(8);
  for (int i = 0; i < 20000; ++i) {
    const float u = random.unit();
    const Interval at = find_interval(cdf.data(), 0, count, u);
    const double from = cdf[static_cast<std::size_t>(at.index)], to = cdf[static_cast<std::size_t>(at.index) + 1];
    REQUIRE(from <= d(u));
    REQUIRE(d(u) < to);
    REQUIRE(std::fabs(d(at.offset) - (d(u) - from) / (to - from)) < 1e-6);
  }
}
