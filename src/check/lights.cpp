// Lights: tiny, huge, near, far, many, hidden and none.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../kernels/physics/light_rich.h"
#include "../film/film.h"
#include "case.h"
#include "groups.h"
#include "random.h"
#include "statistics.h"
#include "temporary.h"

namespace phalanx::check {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

SceneText floor() {
  SceneText scene;
  scene.shapes = {level("grey", 1, 0)};
  return scene;
}

std::string map_light(const std::string &file) {
  return fmt::format(R"({{"type": "environment", "file": "{}"}})", file);
}

/// Irradiance of a horizontal plane by one texel of radiance 1, which bilinear interpolation spreads over its
/// neighbours: the integral of its tent.
double texel_irradiance(int width, int height, int row) {
  double sum = 0;
  const int steps = 400;
  for (int i = 0; i < steps; ++i) {
    const double y = -1 + (i + 0.5) * 2 / steps, theta = (row + 0.5 + y) / height * kPi;
    sum += (1 - std::fabs(y)) * std::cos(theta) * std::sin(theta) * 2 / steps * kPi / height;
  }
  return sum * 2 * kPi / width;  // across, the tent's integral is one texel
}

void one_hot_texel(Case &c) {
  const TemporaryFolder folder;
  const int width = c.count(1024, 4096), height = width / 2, row = height / 4;
  const float hot = 8589934592.0f;  // 2^33
  const std::string file = folder.picture("hot.hdr", width, height, [&](int x, int y) { return x == 0 && y == row ? hot : 0.0f; });
  SceneText scene = floor();
  scene.lights = {map_light(file)};
  c.radiance(fmt::format("diffuse 0.5 under {} x {} pixels, one of 2^33", width, height), scene, 32768,
             0.5 / kPi * static_cast<double>(hot) * texel_irradiance(width, height, row), 5e-4);
}

void a_sun_in_the_map(Case &c) {
  const TemporaryFolder folder;
  const std::string file = folder.picture("sun.hdr", 512, 256, [](int x, int y) {
    return std::hypot(x - 200, y - 60) < 2 ? 1e10f : 0.5f;
  });
  SceneText scene = floor();
  scene.width = scene.height = 16;
  scene.camera = camera({0, 2, 3}, {0, 0.3, 0}, 40, {0, 1, 0});
  scene.materials = {material("glass", "dielectric", R"("ior": 1.5)"),
                     material("metal", "conductor", R"("reflectance": 0.9, "alpha": 0.05)")};
  scene.lights = {map_light(file)};
  scene.shapes = {level("grey", 3, 0), sphere("glass", {-0.6, 0.5, 0}, 0.5), sphere("metal", {0.6, 0.5, 0}, 0.5)};
  c.bounded_radiance("glass, metal and a floor under a sun of 1e10: mean", scene, 256, 1, 1e8);

  Film film({0, 0, 1, 1}, false);
  InvalidSamples invalid;
  const int count = 1 << 20;
  std::vector<float> block(3 * 64);
  for (int first = 0; first < count; first += 64) {
    std::fill(block.begin(), block.end(), 1.0f);
    if (first == 0) block[0] = block[1] = block[2] = 1e10f;
    film.add_samples(0, 0, block.data(), 64, first, invalid);
  }
  const double expected = (1e10 + count - 1) / count;
  c.near("mean of one sample of 1e10 and 2^20 - 1 of 1", static_cast<double>(film.mean(0).y), expected, 1e-6 * expected);
}

void tiny_lights(Case &c) {
  double worst = 0;
  for (double sine = 1e-6; sine < 0.9; sine *= 1.3) {
    const auto s2 = static_cast<float>(sine * sine);
    const auto exact = static_cast<double>(1 - sqrtl(1 - static_cast<long double>(s2)));
    worst = std::fmax(worst, relative_error(static_cast<double>(one_minus_cos_from_sin2(s2)), sine < 1e-4 ? static_cast<double>(s2) / 2 : exact));
  }
  c.at_most("relative error of 1 - cos from 1e-6 to 1 rad", worst, 3e-7);
  for (const double half_angle : {1e-3, 3e-4, 1e-4, 1e-5}) {
    SceneText scene = floor();
    scene.lights = {sun({1, -2, 0}, 3, 2 * half_angle * 180 / kPi)};
    c.radiance(fmt::format("sun of half angle {:g}", half_angle), scene, 4096, 0.5 * 3 / kPi * 2 / std::sqrt(5.0), 1e-4);
  }
  for (const double radius : {1e-2, 1e-4, 1e-6}) {
    SceneText scene = floor();
    const double emission = 1 / (radius * radius);
    scene.materials = {emitter("bulb", emission)};
    scene.shapes.push_back(sphere("bulb", {1, 2, 0}, radius));
    c.radiance(fmt::format("sphere light of radius {:g} at sqrt(5) m", radius), scene, 4096, 0.5 / 5 * 2 / std::sqrt(5.0), 1e-4);
  }
}

void lights_that_are_dark(Case &c) {
  const TemporaryFolder folder;
  SceneText scene = floor();
  c.exact_radiance("no lights", scene, 0);
  scene.materials = {emitter("off", 0), emitter("faint", 1e-30)};
  scene.shapes = {level("grey", 1, 0), level("off", 1, 1, true)};
  c.exact_radiance("a lamp that is off", scene, 0);
  scene.lights = {map_light(folder.picture("black.hdr", 8, 4, [](int, int) { return 0.0f; }))};
  c.exact_radiance("and a black map", scene, 0);
  scene.shapes.push_back(level("lamp", 1, 0.9, true));
  c.radiance("and a lamp that shines", scene, 65536, 0.5 / kPi * rectangle_irradiance(-1, 1, -1, 1, 0.9));
  scene.lights = {R"({"type": "point", "position": [0, 0.5, 0], "intensity": 0})", R"({"type": "environment", "radiance": 0})"};
  c.radiance("beside a dark point and a dark sky", scene, 65536, 0.5 / kPi * rectangle_irradiance(-1, 1, -1, 1, 0.9));
}

void broken_maps(Case &c) {
  const TemporaryFolder folder;
  for (const float bad : {kNan, kInf, -kInf, -1.0f}) {
    const std::string value = fmt::format("{}", bad);
    const std::string file = folder.picture("bad.exr", 4, 2, [&](int x, int y) { return x == 1 && y == 0 ? bad : 1.0f; });
    SceneText scene = floor();
    scene.lights = {map_light(file)};
    Stage stage = c.stage(scene);
    c.equal("warnings of a map with " + value, static_cast<double>(stage.warnings().size()), 1);
    c.bounded_radiance("floor under it", scene, 1024, 0.3, 0.5);
    scene.lights = {kSky};
    scene.textures = {fmt::format(R"({{"name": "t", "type": "image", "file": "{}"}})", file)};
    scene.materials = {material("m", "diffuse", R"("reflectance": "t")")};
    scene.shapes = {level("m", 1, 0)};
    if (bad == -1.0f) c.bounded_radiance("a texture with -1", scene, 256, 0, 1);
    else c.rejects("a texture with " + value, scene.text(), "finite");
  }
  const std::string tiny = folder.picture("tiny.exr", 4, 2, [](int, int) { return 1e-40f; });
  SceneText scene = floor();
  scene.lights = {map_light(tiny)};
  c.bounded_radiance("a map of denormal numbers", scene, 256, 0, 1e-37);
}

void lamps_without_area(Case &c) {
  SceneText scene = floor();
  scene.lights = {kSky};
  const SceneText clean = scene;
  scene.shapes.push_back(quad("lamp", {0, 1, 0}, {1, 0, 0}, {2, 0, 0}));
  scene.shapes.push_back(quad("lamp", {0, 1, 0}, {0, 0, 0}, {0, 0, 1}));
  scene.shapes.push_back(mesh("lamp", R"("positions": [[0,1,0],[0,1,0],[0,1,0]], "indices": [[0,1,2]])"));
  Stage stage = c.stage(scene);
  c.equal("lights", static_cast<double>(stage.scene().lights.size()), 0);
  c.equal("primitives left out", static_cast<double>(stage.scene().num_dropped), 3);
  c.same_bits("with and without them", scene, clean);
}

void close_lights(Case &c) {
  for (const double d : {1.0, 1e-3}) {
    SceneText scene = floor();
    scene.lights = {fmt::format(R"({{"type": "point", "position": [0, {}, 0], "intensity": {}}})", d, d * d)};
    c.radiance(fmt::format("point light {:g} m above the floor", d), scene, 64, 0.5 / kPi, 1e-3);
  }
  for (const double d : {1e-10, 1e-19}) {
    SceneText scene = floor();
    scene.lights = {fmt::format(R"({{"type": "point", "position": [0, {}, 0], "intensity": 1}})", d)};
    c.bounded_radiance(fmt::format("point light {:g} m above the floor: finite", d), scene, 1024, 0, 1e30);
  }
  for (const char *points : {"area", "solid_angle"})
    for (const double h : {1.0, 0.1, 1e-3}) {
      SceneText scene = floor();
      scene.camera = camera({0, 0.5 * h, 0}, {0, 0, 0}, 1e-3);
      scene.integrator = fmt::format(R"("max_depth": 1, "roulette_depth": 9, "light_points": "{}")", points);
      scene.shapes.push_back(level("lamp", 1, h, true));
      c.radiance(fmt::format("square lamp {:g} m above the floor, points by {}", h, points), scene, h < 1 ? 65536 : 16384,
                 0.5 / kPi * rectangle_irradiance(-1, 1, -1, 1, h));
    }
}

/// A bright red square and 10^5 dim green triangles, a thousandth of its power.
Stage many_dim_lights(const Case &c, const char *choice, double green) {
  SceneText scene;
  scene.camera = camera({0, 0.5, 0}, {0, 0, 0}, 1e-3);
  scene.integrator = fmt::format(R"("max_depth": 1, "roulette_depth": 9, "light_choice": "{}")", choice);
  scene.materials = {material("bright", "black", R"("emission": [1, 0, 0])"),
                     material("dim", "black", fmt::format(R"("emission": [0, {}, 0])", green))};
  scene.shapes = {level("grey", 1, 0), quad("bright", {-2, 1, -1}, {2, 0, 0}, {0, 0, 2}),
                  mesh("dim", R"("positions": [[0,1,-1],[2,1,-1],[0,1,1]], "indices": [[0,1,2]])")};
  SceneDescription description = c.stage(scene).description();
  MeshData &data = std::get<MeshShape>(description.shapes[2].shape).data;
  const int side = 224;
  data.positions.clear();
  data.indices.clear();
  for (int j = 0; j <= side; ++j)
    for (int i = 0; i <= side; ++i)
      for (const double v : {2.0 * i / side, 1.0, 2.0 * j / side - 1}) data.positions.push_back(static_cast<float>(v));
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const int a = j * (side + 1) + i, b = a + side + 1;
      for (const int v : {a, a + 1, b, a + 1, b + 1, b}) data.indices.push_back(v);
    }
  return Stage(description);
}

void many_lights(Case &c) {
  const double green = 1e-3 * 0.2126 / 0.7152;  // a thousandth in luminance
  for (const char *choice : {"power", "tree"}) {
    Stage stage = many_dim_lights(c, choice, green);
    c.at_least("lights", static_cast<double>(stage.scene().lights.size()), 1e5);
    const double expected = 0.5 / kPi * green * rectangle_irradiance(0, 2, -1, 1, 1);
    for (const std::string &isa : c.isas()) {
      const Measured m = measure(c.film(stage, c.count(1024, 16384), isa));
      c.near(with_isa(c, fmt::format("light of 10^5 dim ones beside a bright one, chosen by {}", choice), isa), m.mean,
             expected, 4 * m.standard_error);
      c.at_most("relative standard error of that", m.standard_error / expected, c.quick() ? 0.25 : 0.06);
    }
  }
}

void behind_glass(Case &c) {
  SceneText scene;
  scene.camera = camera({0, 0, 5}, {0, 0, 0}, 15, {0, 1, 0});
  scene.integrator = R"("max_depth": 1000, "roulette_depth": 1000)";
  scene.materials = {material("glass", "dielectric", R"("ior": 1.5)"), emitter("walls", 1, R"("two_sided": true)"),
                     material("silver", "mirror", R"("reflectance": 1)")};
  scene.shapes = {sphere("white", {0, 0, 0}, 1), sphere("glass", {0, 0, 0}, 1.3), sphere("walls", {0, 0, 0}, 20)};
  c.radiance("a white ball in glass in an emitting sphere, which light samples never reach", scene, 4096, 1, 5e-4);
  scene.shapes = {quad("silver", {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), quad("lamp", {9, -9, 9}, {-18, 0, 0}, {0, 18, 0})};
  c.exact_radiance("a lamp seen in a mirror", scene, 1);
  scene = floor();
  scene.materials = {material("glass", "dielectric", R"("ior": 1.5)"), material("silver", "mirror", R"("reflectance": 1)")};
  scene.shapes.push_back(R"({"type": "box", "material": "glass", "lo": [-3, 0.6, -3], "hi": [3, 0.8, 3]})");
  scene.lights = {R"({"type": "point", "position": [0, 2, 0], "intensity": 1})"};
  c.exact_radiance("a point behind glass is not found: 0, as declared", scene, 0);
}

void lights_that_do_not_reach(Case &c) {
  SceneText scene = floor();
  scene.shapes.push_back(quad("lamp", {2, 0, 1}, {1, 0, 0}, {0, 0, -2}));
  c.exact_radiance("a lamp in the plane of the floor", scene, 0);
  scene.shapes.back() = level("lamp", 1, 1);
  c.exact_radiance("a lamp that faces away", scene, 0);
  scene.shapes.back() = quad("lamp", {2, 0, -1}, {0, -1, 0}, {0, 0, 2});
  c.exact_radiance("a lamp below the horizon", scene, 0);
  scene.shapes.back() = sphere("lamp", {0, 0, 0}, 10);
  c.exact_radiance("inside a sphere that emits outwards", scene, 0);
  scene.shapes.pop_back();
  scene.lights = {sun({1, 0, 0}, 1)};
  c.exact_radiance("a sun at the horizon", scene, 0);
  scene.lights = {sun({0, 1, 0}, 1)};
  c.exact_radiance("a sun below", scene, 0);
}

void sun_seen_and_sampled(Case &c) {
  const double diameter = 0.533, half = diameter / 2 * kPi / 180, fov = 1.5 * diameter;
  const double radiance = 2 / (kPi * std::sin(half) * std::sin(half)), edge = std::tan(fov / 2 * kPi / 180);
  SceneText scene;
  scene.lights = {sun({-1, -2, -1}, 2, diameter)};
  scene.camera = camera({0, 0, 0}, {1, 2, 1}, fov);
  c.radiance("the sun's disc, seen", scene, 65536, radiance * kPi * std::tan(half) * std::tan(half) / (4 * edge * edge), 1e-4);
  scene = floor();
  scene.lights = {sun({0, -1, 0}, 2, diameter)};
  c.radiance("its light on a floor, sampled", scene, 1024, 0.5 * 2 / kPi, 1e-4);
  // As a disc at infinity and as a distant ball: two ways through the light code, the same metal.
  for (const char *alpha : {"0.003", "0.05", "0.5"}) {
    const auto lit = [&](bool ball) {
      SceneText s;
      s.integrator = R"("max_depth": 1, "roulette_depth": 9)";
      s.camera = camera({-1, 2, 0}, {0, 0, 0}, 0.5);
      s.materials = {material("metal", "conductor", fmt::format(R"("reflectance": 0.9, "alpha": {})", alpha)),
                     emitter("ball", radiance)};
      s.shapes = {level("metal", 1, 0)};
      const double d = 1e4 / std::sqrt(5.0);
      if (ball) s.shapes.push_back(sphere("ball", {d, 2 * d, 0}, 1e4 * std::sin(half)));
      else s.lights = {sun({-1, -2, 0}, 2, diameter)};
      return s;
    };
    c.same_mean(fmt::format("sun and distant ball on metal of alpha {}", alpha), lit(false), lit(true), 4096, 3e-4);
  }
}

void weights_of_two_strategies(Case &c) {
  double worst_sum = 0, lo = 1, hi = 0;
  const float values[] = {1.2e-38f, 1e-30f, 1e-10f, 1e-3f, 0.5f, 1.0f, 2.0f, 1e3f, 1e10f, 1e20f, 1e30f, 3e38f};
  for (const float a : values)
    for (const float b : values) {
      const auto ab = static_cast<double>(power_heuristic(a, b)), ba = static_cast<double>(power_heuristic(b, a));
      worst_sum = std::fmax(worst_sum, std::isnan(ab + ba) ? 1 : std::fabs(ab + ba - 1));
      lo = std::fmin(lo, ab);
      hi = std::fmax(hi, ab);
    }
  c.at_most("largest distance of the sum of both weights from 1", worst_sum, 1e-6);
  c.within("least weight", lo, 0, 1);
  c.within("largest weight", hi, 0, 1);
  c.equal("weight against a density of 0", static_cast<double>(power_heuristic(1e-20f, 0)), 1);
  c.equal("weight against an infinite density", static_cast<double>(power_heuristic(1, kInf)), 0);
  SceneText scene = floor();
  scene.materials = {material("silver", "mirror", R"("reflectance": 1)")};
  scene.shapes = {level("silver", 1, 0)};
  scene.lights = {sun({0, -1, 0}, 1)};
  c.exact_radiance("a light without extent in a perfect mirror is not found: 0, as declared", scene, 0);
}

void maps_and_directions(Case &c) {
  const TemporaryFolder folder;
  SceneText scene;
  scene.lights = {map_light(folder.picture("two.exr", 2, 1, [](int, int) { return 1.0f; }))};
  c.exact_radiance("a map of 2 x 1 equal pixels, seen", scene, 1, 1e-6);
  scene = floor();
  scene.lights = {map_light(folder.picture("two.exr", 2, 1, [](int, int) { return 1.0f; }))};
  c.radiance("diffuse 0.5 under it", scene, 16384, 0.5, 1e-4);

  Random noise(14);
  scene.lights = {map_light(folder.picture("noise.exr", 16, 8, [&](int, int) { return noise.unit() < 0.3f ? 0.0f : noise.unit(); }))};
  Stage stage = c.stage(scene);
  const SceneView view = stage.scene().view();
  const auto uv_of = [&](Vec3 w) { return environment_uv(to_local(environment_frame(view), w)); };
  Random random(15);
  Histogram histogram(sphere_grid(16, 32));
  Mean by_density, by_sphere;
  double worst_uv = 0;
  for (int i = 0; i < c.count(200000, 2000000); ++i) {
    const EnvironmentSample s = sample_environment(view, random.square());
    const Vec2 uv = uv_of(s.direction);
    if (abs_of(s.direction.y) < 0.999f && s.uv.x > 1e-4f && s.uv.x < 0.9999f)
      worst_uv = std::fmax(worst_uv, static_cast<double>(max_of(abs_of(uv.x - s.uv.x), abs_of(uv.y - s.uv.y))));
    histogram.add(static_cast<double>(s.direction.y), azimuth(static_cast<double>(s.direction.z), static_cast<double>(s.direction.x)));
    by_density.add(static_cast<double>(environment_radiance(view, s.uv).y / s.pdf));
    by_sphere.add(static_cast<double>(environment_radiance(view, uv_of(random.direction())).y) * 4 * kPi);
  }
  c.at_most("largest distance between a sample's place in the map and its direction's", worst_uv, 1e-5);
  const Fit fit = chi_square_fit(histogram, cell_masses(histogram.grid(), [&](double y, double phi) {
                                   const double r = std::sqrt(1 - y * y);
                                   const Vec3 w = {static_cast<float>(r * std::sin(phi)), static_cast<float>(y),
                                                   static_cast<float>(r * std::cos(phi))};
                                   return static_cast<double>(environment_pdf(view, uv_of(w)));
                                 }));
  c.within("chi-square p of sampled directions", fit.p, 1e-5, 1);
  c.near("integral of the map by samples and by the sphere", by_density.mean(), by_sphere.mean(),
         4 * std::hypot(by_density.standard_error(), by_sphere.standard_error()));
  std::int64_t bad = 0;
  for (const Vec3 w : {Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{-0.0f, 1, -0.0f}, Vec3{0, 0, 1}, Vec3{0, 0, -1}, Vec3{-0.0f, 0, 1}}) {
    const Vec2 uv = uv_of(w);
    bad += !is_finite(uv.x) || !is_finite(uv.y) || !(environment_pdf(view, uv) >= 0) || !all_finite(environment_radiance(view, uv));
  }
  c.equal("poles and seam: values that are not finite", static_cast<double>(bad), 0);
}

}  // namespace

Group lights_group() {
  return {"lights",
          {{"L1", "a map of 8 million pixels, one of which shines", one_hot_texel},
           {"L2", "a sun of 1e10 in the map", a_sun_in_the_map},
           {"L3", "suns and bulbs down to 1e-6 rad", tiny_lights},
           {"L4", "lights that are dark, and none at all", lights_that_are_dark},
           {"L5", "maps and textures with numbers that are none", broken_maps},
           {"L6", "lamps without area", lamps_without_area},
           {"L7", "lights that almost touch the surface", close_lights},
           {"L8", "10^5 dim lights beside a bright one", many_lights},
           {"L9", "lights behind glass and in mirrors", behind_glass},
           {"L10", "lights at the horizon, facing away, inside out", lights_that_do_not_reach},
           {"L11", "the sun, seen and sampled", sun_seen_and_sampled},
           {"L12", "weights of densities from 1e-38 to infinity", weights_of_two_strategies},
           {"L13", "directions and places in a map", maps_and_directions}}};
}

}  // namespace phalanx::check
