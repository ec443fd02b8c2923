// Pictures with known answers, measured to a standard error of 0.1 % (numbers: scene, expected).
//
// Every case uses independent samples, so that the standard error is the sample's own, a fixed
// seed, and a z-test at 4 standard errors (p = 6e-5 a case).
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "support/scenes.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

constexpr double kPi = std::numbers::pi;

struct Measured {
  double mean = 0, standard_error = 0;
};

/// Mean radiance of an 8 x 8 picture seen through a very narrow angle.
Measured measure(const std::string &camera, const std::string &rest, int spp,
                 const std::string &integrator = R"("max_depth": 64, "roulette_depth": 64)") {
  const std::string text = R"({"version": 1, "camera": {)" + camera + R"(},
    "film": {"width": 8, "height": 8, "filter": {"type": "box"}},
    "sampler": {"type": "independent", "seed": 1},
    "integrator": {)" + integrator + "}, " + rest + "}";
  const BuiltScene scene = build_text(text, isas_here().back());
  RenderOptions o;
  o.spp = spp;
  o.threads = 2;
  const RenderResult r = render_scene(scene, o);
  CHECK(r.stats.invalid.count == 0);
  Measured m;
  double variance = 0;
  for (std::int64_t i = 0; i < r.film.num_pixels(); ++i) {
    m.mean += double(r.film.mean(i).y);
    variance += double(r.film.variance_of_mean(i).y);
  }
  const double n = static_cast<double>(r.film.num_pixels());
  m.mean /= n;
  m.standard_error = std::sqrt(variance) / n;
  return m;
}

void check(const Measured &m, double expected) {
  CAPTURE(m.mean);
  CAPTURE(m.standard_error);
  CAPTURE(expected);
  CHECK(m.standard_error <= 1e-3 * expected);
  // Where samples have no variance, rounding is left: a path's radiance is summed in floats.
  CHECK(std::abs(m.mean - expected) <= 4 * m.standard_error + 5e-5 * expected);
}

const char *const kLookDown = R"("position": [0, 0.5, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "fov": 0.001)";
const char *const kGrey = R"("materials": [{"name": "grey", "type": "diffuse", "reflectance": 0.5},
  {"name": "lamp", "type": "black", "emission": 1}])";
const char *const kFloor = R"({"type": "quad", "material": "grey", "corner": [-1, 0, 1], "edge_u": [2, 0, 0], "edge_v": [0, 0, -2]})";

}  // namespace

TEST_CASE("analytic 1: a convex body of albedo 1 under a constant sky is invisible") {
  for (const char *shape :
       {R"({"type": "sphere", "material": "white", "center": [0, 0, 0], "radius": 1})",
        R"({"type": "box", "material": "white", "transform": {"rotate": {"axis": [1, 2, 3], "angle": 40}}})"}) {
    const Measured m = measure(R"("position": [0, 0, 5], "look_at": [0, 0, 0], "fov": 25)",
                               std::string(R"("materials": [{"name": "white", "type": "diffuse", "reflectance": 1}],
      "lights": [{"type": "environment", "radiance": 1}], "shapes": [)") + shape + "]", 64);
    check(m, 1);
  }
}

TEST_CASE("analytic 2: integrating sphere, L = Le / (1 - albedo)") {
  const auto sphere = [](double albedo, int spp, const std::string &integrator) {
    return measure(R"("position": [0.1, 0.2, 0.3], "look_at": [1, 0, 0], "fov": 20)",
                   R"("materials": [{"name": "wall", "type": "diffuse", "reflectance": )" +
                       std::to_string(albedo) + R"(, "emission": 1, "two_sided": true}],
      "shapes": [{"type": "sphere", "material": "wall", "center": [0, 0, 0], "radius": 1}])",
                   spp, integrator);
  };
  const std::string endless = R"("max_depth": 100, "roulette_depth": 100)";
  check(sphere(0.5, 1024, endless), 2);
  check(sphere(0.8, 1024, endless), 5);
  check(sphere(0.999, 8, R"("max_depth": 20000, "roulette_depth": 20000)"), 1 / (1 - double(0.999f)));
  // Roulette changes the noise and not the mean.
  check(sphere(0.8, 32768, R"("max_depth": 1000, "roulette_depth": 1)"), 5);
  // Cut off after n scattering events: (1 - albedo^(n + 1)) / (1 - albedo).
  for (int depth : {0, 1, 2, 5}) {
    check(sphere(0.8, 1024, R"("roulette_depth": 100, "max_depth": )" + std::to_string(depth)),
          (1 - std::pow(0.8, depth + 1)) / 0.2);
  }
}

TEST_CASE("analytic 3: disk on the axis, sphere above the horizon") {
  // E = pi L R^2 / (R^2 + h^2) = pi / 2 at R = h = 1; L = albedo E / pi.
  check(measure(kLookDown, std::string(kGrey) + R"(, "shapes": [)" + kFloor + R"(,
    {"type": "disk", "material": "lamp", "center": [0, 1, 0], "normal": [0, -1, 0], "radius": 1}])", 16384),
        0.25);
  // E = pi L (R / d)^2 cos theta.
  for (double radius : {0.5, 1e-2, 1e-4}) {
    const double d2 = 4 + 1, cosine = 2 / std::sqrt(d2);
    const double emission = 1 / (radius * radius);
    check(measure(kLookDown, R"("materials": [{"name": "grey", "type": "diffuse", "reflectance": 0.5},
      {"name": "lamp", "type": "black", "emission": )" + std::to_string(emission) + R"(}], "shapes": [)" + kFloor +
        R"(, {"type": "sphere", "material": "lamp", "center": [1, 2, 0], "radius": )" + std::to_string(radius) + "}]", 16384),
          0.5 * emission * radius * radius / d2 * cosine);
  }
}

TEST_CASE("analytic 4: a square lamp overhead (Lambert's polygon formula)") {
  const char *const shapes[] = {
      R"({"type": "quad", "material": "lamp", "corner": [-1, 1, -1], "edge_u": [2, 0, 0], "edge_v": [0, 0, 2]})",
      R"({"type": "mesh", "material": "lamp", "positions": [[-1,1,-1],[1,1,-1],[1,1,1],[-1,1,1]], "indices": [[0,1,2],[0,2,3]]})"};
  for (const char *lamp : shapes) {
    check(measure(kLookDown, std::string(kGrey) + R"(, "shapes": [)" + kFloor + "," + lamp + "]", 16384),
          0.27706321);
  }
}

TEST_CASE("analytic 9: rough metal, alpha = 1, loses all but 1 - ln 2 in single scattering") {
  check(measure(kLookDown, R"("materials": [{"name": "metal", "type": "conductor", "reflectance": 1, "alpha": 1}],
    "lights": [{"type": "environment", "radiance": 1}],
    "shapes": [{"type": "quad", "material": "metal", "corner": [-1, 0, 1], "edge_u": [2, 0, 0], "edge_v": [0, 0, -2]}])", 32768),
        1 - std::log(2.0));
}

TEST_CASE("analytic 10: inside an emitting sphere") {
  const std::string room = R"(, "shapes": [{"type": "sphere", "material": "sky", "center": [0, 0, 0], "radius": 10})";
  const std::string materials = R"("materials": [{"name": "grey", "type": "diffuse", "reflectance": 0.5},
    {"name": "sky", "type": "black", "emission": 2, "two_sided": true}])";
  check(measure(R"("position": [1, 2, 3], "look_at": [0, 0, 9], "fov": 60)", materials + room + "]", 16), 2);
  // E = pi Le on any convex body.
  check(measure(kLookDown, materials + room + "," + kFloor + "]", 16384), 1);
}

TEST_CASE("analytic 12: half a sky, seen by a tilted plane: albedo (1 + cos tilt) / 2") {
  for (double tilt : {0.0, 30.0, 75.0}) {
    // The ground is black and reaches to the horizon but for 1e-6 of a radian.
    const double t = tilt * kPi / 180, c = std::cos(t), s = std::sin(t);
    const auto n = [](double x) { return std::to_string(x); };
    const std::string plane = R"({"type": "quad", "material": "grey", "corner": [)" + n(-0.1 * c) + "," +
        n(1 - 0.1 * s) + R"(, 0.1], "edge_u": [)" + n(0.2 * c) + "," + n(0.2 * s) + R"(, 0], "edge_v": [0, 0, -0.2]})";
    const std::string camera = R"("position": [)" + n(-0.5 * s) + "," + n(1 + 0.5 * c) +
        R"(, 0], "look_at": [0, 1, 0], "up": [0, 0, 1], "fov": 0.001)";
    check(measure(camera, R"("materials": [{"name": "grey", "type": "diffuse", "reflectance": 0.5}, {"name": "black", "type": "black"}],
      "lights": [{"type": "environment", "radiance": 1}],
      "shapes": [{"type": "quad", "material": "black", "corner": [-1e6, 0, 1e6], "edge_u": [2e6, 0, 0], "edge_v": [0, 0, -2e6]},)" +
                              plane + "]", 16384),
          0.25 * (1 + c));
  }
}

TEST_CASE("analytic 6: a glass slab reflects R = 2r / (1 + r) at normal incidence") {
  check(measure(R"("position": [0, 3, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "fov": 0.001)",
                R"("materials": [{"name": "glass", "type": "dielectric", "ior": 1.5}, {"name": "black", "type": "black"}],
    "lights": [{"type": "environment", "radiance": 1}],
    "shapes": [{"type": "box", "material": "glass", "lo": [-1, 0, -1], "hi": [1, 0.5, 1]},
      {"type": "quad", "material": "black", "corner": [-1, -1, 1], "edge_u": [2, 0, 0], "edge_v": [0, 0, -2]}])", 262144),
        2 * 0.04 / 1.04);
}

TEST_CASE("a floor at height 0 does not shade itself") {
  // Nothing of its points is rounded, so their offset is 0 and rays start on the plane itself.
  for (const char *floor : {kFloor, R"({"type": "mesh", "material": "grey", "positions": [[-1,0,1],[1,0,1],[1,0,-1],[-1,0,-1]], "indices": [[0,1,2],[0,2,3]]})"}) {
    check(measure(R"("position": [0.1, 3, 0.2], "look_at": [0, 0, 0], "up": [0, 0, 1], "fov": 20)",
                  std::string(kGrey) + R"(, "lights": [{"type": "environment", "radiance": 1}], "shapes": [)" + floor + "]", 64),
          0.5);
  }
}

TEST_CASE("a convex lamp that scatters light does not light itself") {
  // Every point shows its own emission and nothing else: no light reaches it.
  for (const char *shape : {R"({"type": "sphere", "material": "lamp", "center": [0, 0, 0], "radius": 1})",
                            R"({"type": "disk", "material": "lamp", "center": [0, 0, 0], "normal": [0, 0, 1], "radius": 2})",
                            R"({"type": "box", "material": "lamp"})"}) {
    check(measure(R"("position": [0, 0, 5], "look_at": [0, 0, 0], "fov": 15)",
                  std::string(R"("materials": [{"name": "lamp", "type": "diffuse", "reflectance": 0.8, "emission": 1, "two_sided": true}],
      "shapes": [)") + shape + "]", 256),
          1);
  }
}
