// Lights that are no surfaces, textured lamps, and how lights are chosen: from the file to the kernels' arrays.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "../../kernels/physics/light_rich.h"
#include "../../kernels/physics/surface.h"
#include "../../src/output/image_file.h"
#include "../../src/scene/build.h"
#include "../../src/scene/build_lights.h"
#include "../../src/scene/scene_file.h"
#include "../output/temp_dir.h"

using namespace phalanx;

namespace {

constexpr double kPi = 3.14159265358979323846;

struct Built {
  Scene scene;
  std::string problems;  // errors, then warnings
};

Built build(const std::string &text, const std::string &folder = ".") {
  Diagnostics diagnostics;
  const SceneDescription description =
      parse_scene_text("{\"version\": 1, " + text + "}", "scene.json", folder, diagnostics);
  Built built;
  if (!diagnostics.has_errors()) built.scene = build_scene(description, diagnostics);
  for (const Problem &problem : diagnostics.errors()) built.problems += problem.text() + "\n";
  for (const Problem &problem : diagnostics.warnings()) built.problems += problem.text() + "\n";
  return built;
}

Scene lights(const std::string &list, const std::string &more = "") {
  const Built built = build("\"lights\": [" + list + "]" + more);
  CHECK(built.problems == "");
  return built.scene;
}

void check_near(Vec3 a, Vec3 b, float tolerance = 1e-6f) {
  INFO(a.x, " ", a.y, " ", a.z, " against ", b.x, " ", b.y, " ", b.z);
  CHECK(length(a - b) <= tolerance);
}

/// A lamp of two triangles and a floor of 10 x 10 metres.
const std::string kRoom = R"(, "materials": [{"name": "grey", "type": "diffuse"},
    {"name": "lamp", "type": "black", "emission": 1}],
  "shapes": [{"type": "quad", "material": "grey", "corner": [0, 0, 0], "edge_u": [10, 0, 0], "edge_v": [0, 10, 0]},
    {"type": "mesh", "material": "lamp", "positions": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
     "indices": [[0, 1, 2], [0, 2, 3]]},
    {"type": "quad", "material": "lamp", "corner": [0, 0, 1], "edge_u": [1, 0, 0], "edge_v": [0, 2, 0]},
    {"type": "quad", "material": "lamp", "corner": [0, 0, 1], "edge_u": [1, 0, 0], "edge_v": [1, 2, 0]}])";

std::string many_points(int count) {
  std::string list;
  for (int i = 0; i < count; ++i)
    list += (i > 0 ? ", " : "") + std::string(R"({"type": "point", "position": [)") +
            std::to_string(i) + R"(, 0, 0], "intensity": 1})";
  return list;
}

const std::string kIes = "TILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 100\n0 45 90\n0\n683 0 0\n";

}  // namespace

TEST_CASE("lights: point, spot, directional and sun are what the file says") {
  const Scene scene = lights(R"({"type": "point", "position": [1, 2, 3], "intensity": [4, 5, 6]},
    {"type": "directional", "direction": [0, -2, 0], "irradiance": 7},
    {"type": "spot", "position": [1, 1, 1], "direction": [3, 0, 0], "intensity": 2, "inner_angle": 30,
     "outer_angle": 60},
    {"type": "sun", "sun_elevation": 30, "sun_azimuth": 90, "irradiance": 1000},
    {"type": "point", "position": [0, 0, 0], "intensity": 0})");
  REQUIRE(scene.lights.size() == 4);  // those at infinity last, what is black left out
  const Light &point = scene.lights[0], &spot = scene.lights[1], &directional = scene.lights[2],
              &sun = scene.lights[3];
  CHECK(point.kind == kPointLight);
  check_near(point.p, {1, 2, 3});
  check_near(point.emission, {4, 5, 6});
  CHECK((point.profile == -1 && point.emission_texture == -1 && point.opacity_texture == -1));
  CHECK(spot.kind == kSpotLight);
  check_near(spot.normal, {1, 0, 0});
  CHECK(spot.cos_inner == doctest::Approx(std::sqrt(0.75)));
  CHECK(spot.cos_outer == doctest::Approx(0.5));
  CHECK(directional.kind == kDirectionalLight);
  check_near(directional.normal, {0, 1, 0});
  CHECK(directional.one_minus_cos == 0);
  CHECK(directional.emission.x == 7);
  check_near(sun.normal, {std::sqrt(0.75f), 0.5f, 0});
  const double half = 0.533 / 2 * kPi / 180;
  CHECK(sun.one_minus_cos == doctest::Approx(1 - std::cos(half)).epsilon(1e-6));
  CHECK(sun.emission.y == doctest::Approx(1000 / (kPi * std::sin(half) * std::sin(half))));
  CHECK(scene.num_infinite_lights == 2);
  CHECK(scene.has_environment);  // the sun's disc is seen
  CHECK(is_black(scene.environment));
  CHECK(has_rich_lights(scene));
  const SceneView view = scene.view();
  CHECK(view.num_infinite_lights == 2);
  CHECK(view.num_light_nodes == 0);
  double sum = 0;
  for (const Light &light : scene.lights) sum += static_cast<double>(light.select_pdf);
  CHECK(sum == doctest::Approx(1));
}

TEST_CASE("lights: without anything of this, kernels and choices are those of plain scenes") {
  const Scene scene = lights(R"({"type": "environment", "radiance": 1})", kRoom);
  CHECK(!has_rich_lights(scene));
  REQUIRE(scene.lights.size() == 4);
  const double areas[] = {0.5, 0.5, 2, 2};
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(scene.lights[i].select_pdf == doctest::Approx(areas[i] / 5).epsilon(1e-6));
  const Scene uniform = lights("", R"(, "integrator": {"light_choice": "uniform"})" + kRoom);
  CHECK(!has_rich_lights(uniform));
  for (const Light &light : uniform.lights) CHECK(light.select_pdf == 0.25f);
}

TEST_CASE("lights: powers of all kinds are in one unit") {
  // All over pi: a point's 4 I, a lamp's L A, a sun's E R^2.
  const Scene scene = lights(R"({"type": "point", "position": [0, 0, 0], "intensity": 3},
    {"type": "directional", "direction": [0, 0, -1], "irradiance": 0.5})",
                             kRoom);
  REQUIRE(scene.lights.size() == 6);
  const double powers[] = {0.5, 0.5, 2, 2, 12, 0.5 * 0.25 * 201};
  double sum = 0;
  for (const double power : powers) sum += power;
  for (std::size_t i = 0; i < 6; ++i)
    CHECK(scene.lights[i].select_pdf == doctest::Approx(powers[i] / sum).epsilon(1e-5));
}

TEST_CASE("lights: solid angles are for triangles and rectangles") {
  const Scene scene = lights("", R"(, "integrator": {"light_points": "solid_angle"})" + kRoom);
  CHECK(has_rich_lights(scene));
  const int expected[] = {1, 1, 1, 0};  // the last is an oblique parallelogram
  for (std::size_t i = 0; i < 4; ++i) CHECK(scene.lights[i].by_solid_angle == expected[i]);
}

TEST_CASE("lights: the tree is taken from 65 lights on, or when asked for") {
  CHECK(lights(many_points(64)).light_nodes.empty());
  CHECK(lights(many_points(65)).light_nodes.size() == 129);
  CHECK(
      lights(many_points(65), R"(, "integrator": {"light_choice": "power"})").light_nodes.empty());
  CHECK(lights(many_points(2), R"(, "integrator": {"light_choice": "tree"})").light_nodes.size() ==
        3);
  CHECK(lights(many_points(1), R"(, "integrator": {"light_choice": "tree"})").light_nodes.empty());
  const Scene scene = lights(many_points(65) + R"(, {"type": "environment", "radiance": 1},
    {"type": "directional", "direction": [0, 1, 0], "irradiance": 1},
    {"type": "sun", "irradiance": 3})");
  CHECK(scene.num_infinite_lights == 2);
  CHECK((scene.infinite_share >= 0.1f && scene.infinite_share <= 0.9f));
  const SceneView view = scene.view();
  double sum = 0;
  for (const Light &light : scene.lights)
    sum += static_cast<double>(choice_pdf(view, light, vec3(3, 4, 5)));
  CHECK(sum == doctest::Approx(1));
  CHECK(scene.lights[66].select_pdf ==
        doctest::Approx(0.75 * static_cast<double>(scene.infinite_share)));
  for (const float u : {0.0f, 0.5f * scene.infinite_share}) {
    const ChosenLight c = choose_light_rich(view, vec3(0, 0, 0), vec2(u, 0.3f));
    CHECK(c.light >= 65);
  }
}

TEST_CASE("lights: an environment map from a file, turned and scaled") {
  const TempDir folder;
  Image image = make_image(4, 2);
  const char *const names[] = {"R", "G", "B"};
  for (int c = 0; c < 3; ++c) {
    std::vector<float> &plane = add_channel(image, names[c]);
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = static_cast<float>(i + 1);
  }
  for (const std::string name : {"sky.exr", "sky.hdr"}) {
    write_image(folder / name, image, 0);
    const Built built = build(R"("lights": [{"type": "environment", "file": ")" + name +
                                  R"(", "rotate": 90, "scale": [1, 2, 3]}])",
                              folder.path());
    CHECK(built.problems == "");
    const Scene &scene = built.scene;
    CHECK((scene.environment_width == 4 && scene.environment_height == 2));
    CHECK(scene.environment_texels[3 * 5] == 6);
    CHECK(scene.environment_texels[3 * 5 + 2] == 18);
    check_near(scene.environment_z, {1, 0, 0});
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].kind == kEnvironmentLight);
    CHECK(scene.lights[0].select_pdf == 1);
    CHECK(scene.has_environment);
    CHECK(has_rich_lights(scene));
  }
}

TEST_CASE("lights: maps with black, negative or infinite pixels, or no map at all (L4, L5)") {
  const TempDir folder;
  const auto with = [&](float value) {
    Image image = make_image(4, 2);
    for (const char *name : {"R", "G", "B"}) add_channel(image, name)[3] = value;
    write_image(folder / "map.exr", image, 0);
    return build(R"("lights": [{"type": "environment", "file": "map.exr"},
      {"type": "point", "position": [0, 0, 0], "intensity": 1}])",
                 folder.path());
  };
  const Built black = with(0);
  CHECK(black.problems == "");
  CHECK(black.scene.lights.size() == 1);  // the point stays
  CHECK(black.scene.environment_width == 0);
  CHECK(!black.scene.has_environment);
  for (const float value : {-1.0f, HUGE_VALF, NAN}) {
    const Built bad = with(value);
    CHECK(bad.problems.find("scene.json: /lights/0: 3 values of") != std::string::npos);
    CHECK(bad.scene.lights.size() == 1);
  }
  CHECK(with(1).scene.lights.size() == 2);
  put(folder / "map.exr", "no picture");
  CHECK(build(R"("lights": [{"type": "environment", "file": "map.exr"}])", folder.path())
            .problems.find("scene.json: /lights/0: ") == 0);
}

TEST_CASE("lights: an IES file gives a profile, and the intensity unless the scene does") {
  const TempDir folder;
  put(folder / "lamp.ies", kIes);
  const Built built = build(R"("lights": [
    {"type": "ies", "file": "lamp.ies", "position": [0, 3, 0]},
    {"type": "ies", "file": "lamp.ies", "position": [0, 3, 0], "direction": [1, 0, 0], "horizontal": [1, 1, 0],
     "intensity": [1, 2, 3]}])",
                            folder.path());
  CHECK(built.problems == "");
  const Scene &scene = built.scene;
  REQUIRE(scene.profiles.size() == 2);
  CHECK(scene.profiles[0].first == scene.profiles[1].first);  // one table for both
  check_near(scene.profiles[0].n, {0, -1, 0});
  check_near(scene.profiles[0].s, {1, 0, 0});
  check_near(scene.profiles[1].s, {0, 1, 0});
  check_near(scene.lights[0].emission, {1, 1, 1});
  check_near(scene.lights[1].emission, {1, 2, 3});
  const SceneView view = scene.view();
  CHECK(profile_intensity(view, 0, vec3(0, -1, 0)) == doctest::Approx(1));
  CHECK(profile_intensity(view, 0, vec3(0.70710678f, -0.70710678f, 0)) ==
        doctest::Approx(0).epsilon(1e-4));
  CHECK(profile_intensity(view, 1, vec3(1, 0, 0)) == doctest::Approx(1));
  put(folder / "tilted.ies", "TILT=x.tlt" + kIes.substr(9));
  CHECK(build(R"("lights": [{"type": "ies", "file": "tilted.ies", "position": [0, 0, 0]}])",
              folder.path())
            .problems.find("asks for a tilt") != std::string::npos);
  put(folder / "bad.ies", "lamp");
  CHECK(build(R"("lights": [{"type": "ies", "file": "bad.ies", "position": [0, 0, 0]}])",
              folder.path())
            .problems.find("/lights/0: ") != std::string::npos);
}

TEST_CASE("lights: the sky is a map with the sun in it") {
  const Scene scene =
      lights(R"({"type": "sky", "sun_elevation": 30, "sun_azimuth": 120, "turbidity": 2})");
  REQUIRE(scene.lights.size() == 2);
  CHECK(scene.lights[0].kind == kDirectionalLight);
  CHECK(scene.lights[0].one_minus_cos > 0);
  CHECK(scene.lights[1].kind == kEnvironmentLight);
  const SceneView view = scene.view();
  const Vec3 sun = scene.lights[0].normal;
  check_near(sun, {0.75f, 0.5f, std::sqrt(0.1875f)}, 1e-5f);
  // The map is brightest around the disc.
  const auto map_at = [&](Vec3 w) {
    return environment_radiance(view, environment_uv(to_local(environment_frame(view), w))).y;
  };
  float brightest = 0;
  Vec3 where = {0, 0, 0};
  for (int i = 0; i < 180; ++i)
    for (int j = 0; j < 90; ++j) {
      const float phi = static_cast<float>(2 * i * kPi / 180),
                  theta = static_cast<float>(j * kPi / 180);
      const Vec3 w =
          vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      if (map_at(w) > brightest) brightest = map_at(w), where = w;
    }
  CHECK(dot(where, sun) > 0.995f);
  CHECK(lights(R"({"type": "sky", "sun": false})").lights.size() == 1);
  CHECK(lights(R"({"type": "sky", "sun_elevation": -5})").lights.size() == 1);  // after sunset
  CHECK(lights(R"({"type": "sky", "sun_elevation": -60})").lights.empty());     // night
}

TEST_CASE(
    "lights: textures of emission and opacity count in the power, at the same points as at a hit") {
  const std::string scene_text = R"("textures": [{"name": "t", "type": "checker", "a": 1, "b": 3,
      "transform": {"scale": 4}}],
    "materials": [{"name": "plain", "type": "black", "emission": 2},
                  {"name": "lamp", "type": "black", "emission": "t"}],
    "shapes": [{"type": "quad", "material": "plain", "corner": [0, 0, 0], "edge_u": [1, 0, 0], "edge_v": [0, 1, 0]},
               {"type": "quad", "material": "lamp", "corner": [0, 0, 1], "edge_u": [1, 0, 0], "edge_v": [0, 1, 0]}])";
  const Built built = build(scene_text);
  CHECK(built.problems == "");
  REQUIRE(built.scene.lights.size() == 2);
  CHECK(has_rich_lights(built.scene));
  CHECK(built.scene.lights[0].emission_texture == -1);
  CHECK(built.scene.lights[1].emission_texture == 0);
  CHECK(built.scene.lights[0].select_pdf == doctest::Approx(0.5).epsilon(0.01));
  const SceneView view = built.scene.view();
  double sum = 0;
  for (int i = 0; i < 4096; ++i) {
    const Vec2 u = {static_cast<float>(i % 64) / 64, static_cast<float>(i / 64) / 64};
    const LightSample s = sample_light_rich(view, vec3(0.5f, 0.5f, 3), vec2(0.99f, 0), u);
    REQUIRE((s.radiance.x == 1 || s.radiance.x == 3));
    sum += static_cast<double>(s.radiance.x);
  }
  CHECK(sum / 4096 == doctest::Approx(2));
}

TEST_CASE("lights: a sampled point and a hit at that point read textures at the same place") {
  const TempDir folder;
  put(folder / "lamp.obj",
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.1 0.2\nvt 0.9 0.3\nvt 0.4 0.8\nf 1/1 2/2 3/3\n");
  const Built built = build(R"("textures": [{"name": "t", "type": "checker"}],
    "materials": [{"name": "lamp", "type": "black", "emission": "t", "two_sided": true}],
    "shapes": [{"type": "quad", "material": "lamp", "corner": [0, 0, 0], "edge_u": [1, 0.5, 0], "edge_v": [0, 1, 2]},
      {"type": "sphere", "material": "lamp", "center": [1, 2, 3], "radius": 2},
      {"type": "disk", "material": "lamp", "center": [0, 0, 0], "normal": [1, 2, 3], "radius": 2},
      {"type": "mesh", "material": "lamp", "file": "lamp.obj"},
      {"type": "mesh", "material": "lamp", "positions": [0, 0, 1, 1, 0, 1, 0, 1, 1], "indices": [0, 1, 2]}])",
                            folder.path());
  CHECK(built.problems == "");
  const SceneView view = built.scene.view();
  REQUIRE(view.num_lights == 5);
  for (int32 g = 0; g < view.num_geometries; ++g) {
    const Light &light = view.lights[view.geometries[g].first_light];
    for (int i = 0; i < 100; ++i) {
      const Vec2 u = {0.005f + 0.0099f * static_cast<float>(i),
                      0.005f + 0.0099f * static_cast<float>(i * 37 % 100)};
      const Vec3 origin = {7, -3, 9};
      const LightPoint point = sample_surface_light(light, origin, u);
      const TexturePoint sampled = light_texture_point(light, point);
      Hit hit = {};
      hit.geometry = g;
      hit.instance = -1;
      const Surface s = make_surface<kRich>(view, hit, origin, normalize(point.position - origin));
      CAPTURE(g);
      CAPTURE(i);
      REQUIRE(length(s.at.position - sampled.position) < 1e-4f);
      if (light.kind == kDiskLight && sampled.uv.x < 0.1f)
        continue;  // the angle has no digits there
      REQUIRE(std::fabs(std::remainder(s.at.uv.x - sampled.uv.x, 1.0f)) < 1e-4f);
      REQUIRE(std::fabs(std::remainder(s.at.uv.y - sampled.uv.y, 1.0f)) < 1e-4f);
      REQUIRE(length(s.at.colour - sampled.colour) < 1e-4f);
    }
  }
}
