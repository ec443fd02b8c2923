// What comes out of good scene files, what is said about bad ones.
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <sstream>

#include "../../src/scene/metals.h"
#include "scene_texts.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

SceneDescription load_good(const std::string &path) {
  Diagnostics diagnostics;
  const SceneDescription scene = load_scene_file(path, diagnostics);
  REQUIRE_MESSAGE(!diagnostics.has_errors(), errors_of(diagnostics));
  return scene;
}

SceneDescription everything() {
  return load_good(source_path("tests/scene/valid/everything.json"));
}

template <typename Shape>
const Shape &shape_as(const ShapeDescription &shape) {
  REQUIRE(std::holds_alternative<Shape>(shape.shape));
  return std::get<Shape>(shape.shape);
}

std::size_t num_triangles(const ShapeDescription &shape) {
  return shape_as<MeshShape>(shape).data.indices.size() / 3;
}

void check_rows(const Transform &transform, const Transform &expected) {
  for (int row = 0; row < 3; row++) {
    for (int column = 0; column < 4; column++) {
      CAPTURE(row);
      CAPTURE(column);
      CHECK(transform.m[row][column] == doctest::Approx(expected.m[row][column]).epsilon(1e-14));
    }
  }
}

}  // namespace

TEST_CASE("scene file: a scene that says nothing has the defaults of description.h") {
  const SceneDescription scene = load_good(source_path("tests/scene/valid/minimal.json"));
  const SceneDescription defaults;
  CHECK(scene.camera.position == defaults.camera.position);
  CHECK(scene.camera.look_at == defaults.camera.look_at);
  CHECK(scene.camera.fov == defaults.camera.fov);
  CHECK(scene.film.width == defaults.film.width);
  CHECK(scene.film.filter == defaults.film.filter);
  CHECK(scene.film.filter_radius == defaults.film.filter_radius);
  CHECK(scene.sampler.spp == defaults.sampler.spp);
  CHECK(scene.integrator.max_depth == defaults.integrator.max_depth);
  CHECK(scene.materials.empty());
  CHECK(scene.shapes.empty());
  CHECK(!scene.has_environment);
}

TEST_CASE("scene file: camera, film, sampler and integrator say what the file says") {
  const SceneDescription scene = everything();
  CHECK(scene.file == source_path("tests/scene/valid/everything.json"));
  CHECK(scene.camera.position == Double3{0, 1, 5});
  CHECK(scene.camera.look_at == Double3{0, 1, 0});
  CHECK(scene.camera.up == Double3{0, 2, 0.5});
  CHECK(scene.camera.fov == 39.5);
  CHECK(scene.camera.aperture_radius == 0.05);
  CHECK(scene.camera.focus_distance == 4.5);
  CHECK(scene.camera.kind == kPerspective);
  CHECK(scene.camera.blades == 7);
  CHECK(scene.camera.blade_rotation == 12.5);
  CHECK(scene.film.width == 320);
  CHECK(scene.film.height == 200);
  CHECK(scene.film.filter == kGaussianFilter);
  CHECK(scene.film.filter_radius == 2);
  CHECK(scene.film.filter_sigma == 0.6);
  CHECK(scene.film.crop == std::array<int, 4>{10, 20, 30, 40});
  CHECK(scene.film.exposure == -1.5);
  CHECK(scene.sampler.kind == kIndependentSampler);
  CHECK(scene.sampler.spp == 100);
  CHECK(scene.sampler.seed == 7);
  CHECK(scene.integrator.max_depth == 5);
  CHECK(scene.integrator.roulette_depth == 3);
}

TEST_CASE("scene file: materials and lights say what the file says") {
  const SceneDescription scene = everything();
  REQUIRE(scene.materials.size() >= 12);
  const MaterialDescription &red = scene.materials[0], &mirror = scene.materials[1],
                            &water = scene.materials[2], &steel = scene.materials[3],
                            &alloy = scene.materials[4], &gold = scene.materials[5],
                            &lamp = scene.materials[6];
  CHECK(red.name == "red");
  CHECK(red.kind == kDiffuse);
  CHECK(red.reflectance == Double3{0.75, 0.25, 0.125});
  CHECK(red.emission == Double3{0, 0, 0});
  CHECK(mirror.kind == kMirror);
  CHECK(mirror.reflectance == Double3{0.9, 0.9, 0.9});
  CHECK(water.kind == kDielectric);
  CHECK(water.ior == 1.33);
  CHECK(steel.kind == kConductor);
  CHECK(!steel.has_ior);
  CHECK(steel.reflectance == Double3{0.5, 0.625, 0.75});
  CHECK(steel.roughness == 0.3);
  CHECK(alloy.has_ior);
  CHECK(alloy.eta == Double3{0.25, 0.5, 1});
  CHECK(alloy.k == Double3{4, 3, 2});
  CHECK(alloy.roughness == 0.5);  // alpha 0.25
  CHECK(gold.has_ior);
  CHECK(gold.eta == Double3{0.222, 0.428, 1.335});
  CHECK(gold.roughness == 0.1);
  CHECK(lamp.kind == kBlack);
  CHECK(lamp.emission == Double3{10, 20, 30});
  CHECK(lamp.two_sided);
  CHECK(scene.has_environment);
  CHECK(scene.environment == Double3{0.5, 0.75, 1});
}

TEST_CASE("scene file: lights that are no surfaces say what the file says") {
  const SceneDescription scene = everything();
  CHECK(scene.integrator.light_choice == LightChoice::kTree);
  CHECK(scene.integrator.light_points == LightPoints::kSolidAngle);
  REQUIRE(scene.lights.size() == 5);
  const LightDescription &point = scene.lights[0], &spot = scene.lights[1], &ies = scene.lights[2],
                         &directional = scene.lights[3], &sun = scene.lights[4];
  CHECK(point.kind == kPointLight);
  CHECK(point.origin == scene.file + ": /lights/1");
  CHECK(point.position == Double3{1, 2, 3});
  CHECK(point.emission == Double3{4, 5, 6});
  CHECK(spot.kind == kSpotLight);
  CHECK(spot.direction == Double3{0, 0, 2});
  CHECK(spot.inner_angle == 12.5);
  CHECK(spot.outer_angle == 25);
  CHECK(ies.kind == kPointLight);
  CHECK(ies.profile.ends_with("downlight.ies"));
  CHECK(!ies.profile_intensity);
  CHECK(ies.horizontal == Double3{0, 1, 0});
  CHECK(directional.kind == kDirectionalLight);
  CHECK(directional.angular_diameter == 0);
  CHECK(directional.emission == Double3{0.5, 0.5, 0.5});
  CHECK(sun.kind == kDirectionalLight);
  CHECK(sun.direction == Double3{0, -1, 0});
  CHECK(sun.angular_diameter == 1.5);
  CHECK(!scene.sky);
  CHECK(!scene.environment_map);
}

TEST_CASE("scene file: rough, coated, thin and tinted materials say what the file says") {
  const SceneDescription scene = everything();
  const MaterialDescription &clay = scene.materials[7], &brushed = scene.materials[8],
                            &frosted = scene.materials[9], &pane = scene.materials[10],
                            &varnish = scene.materials[11];
  CHECK(clay.kind == kRoughDiffuse);
  CHECK(clay.reflectance == Double3{0.5, 0.25, 0.125});
  CHECK(clay.roughness == 0.75);
  CHECK(brushed.kind == kConductor);
  CHECK((brushed.anisotropic && brushed.multiple_scattering && brushed.has_ior));
  CHECK(brushed.roughness_x == 0.2);
  CHECK(brushed.roughness_y == 0.6);
  CHECK(frosted.kind == kDielectric);
  CHECK(frosted.roughness == 0.4);
  CHECK(frosted.specular == Double3{0.5, 0.5, 0.5});
  CHECK(frosted.transmittance == Double3{0.25, 0.5, 0.75});
  CHECK(pane.kind == kThinDielectric);
  CHECK(pane.ior == 1.75);
  CHECK(pane.specular == Double3{0.75, 0.5, 0.25});
  CHECK(pane.transmittance == Double3{0.5, 0.5, 0.5});
  CHECK(varnish.kind == kCoated);
  CHECK(varnish.reflectance == Double3{0.5, 0.25, 0.75});
  CHECK(varnish.ior == 1.6);
  CHECK(varnish.roughness == 0.5);  // alpha 0.25
  CHECK(varnish.specular == Double3{0.9, 0.9, 0.9});
}

TEST_CASE("scene file: shapes, groups and instances say what the file says") {
  const SceneDescription scene = everything();
  REQUIRE(scene.shapes.size() == 16);
  CHECK(scene.shapes[0].origin == scene.file + ": /shapes/0");
  CHECK(scene.shapes[0].material == 6);
  CHECK(shape_as<QuadShape>(scene.shapes[0]).corner == Double3{-1, 2, -1});
  CHECK(shape_as<QuadShape>(scene.shapes[0]).edge_u == Double3{2, 0, 0});
  CHECK(shape_as<QuadShape>(scene.shapes[0]).edge_v == Double3{0, 0, 2});
  REQUIRE(shape_as<SpheresShape>(scene.shapes[1]).spheres.size() == 1);
  CHECK(shape_as<SpheresShape>(scene.shapes[1]).spheres[0] == std::array<double, 4>{1, 2, 3, 0.5});
  CHECK(shape_as<DiskShape>(scene.shapes[2]).center == Double3{4, 5, 6});
  CHECK(shape_as<DiskShape>(scene.shapes[2]).normal == Double3{0, 3, 0});
  CHECK(shape_as<DiskShape>(scene.shapes[2]).radius == 2.5);
  CHECK(num_triangles(scene.shapes[3]) == 1);
  CHECK(num_triangles(scene.shapes[4]) == 2);
  const MeshData &inlined = shape_as<MeshShape>(scene.shapes[5]).data;
  CHECK(inlined.positions == std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
  CHECK(inlined.normals == std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1});
  CHECK(inlined.indices == std::vector<std::int32_t>{0, 1, 2});
  CHECK(num_triangles(scene.shapes[6]) == 12 * 8 * 8);                   // displaced_sphere
  CHECK(num_triangles(scene.shapes[7]) == 2 * 9 * 9);                    // terrain
  CHECK(num_triangles(scene.shapes[8]) == 2 * (2 * 20 + 4 * 8));         // menger
  CHECK(num_triangles(scene.shapes[9]) == 2 * 24 * 6);                   // torus_knot
  CHECK(shape_as<SpheresShape>(scene.shapes[10]).spheres.size() == 91);  // sphere_flake
  CHECK(num_triangles(scene.shapes[11]) == 20 * 16);                     // icosphere
  CHECK(num_triangles(scene.shapes[12]) == 12);                          // box
  const CurvesShape &lines = shape_as<CurvesShape>(scene.shapes[13]);
  CHECK(lines.sizes == std::vector<std::int32_t>{3, 2});
  CHECK(lines.points[2] == std::array<double, 4>{0, 1, 3, 0.25});
  const CurvesShape &spline = shape_as<CurvesShape>(scene.shapes[14]);
  REQUIRE(spline.sizes == std::vector<std::int32_t>{9});  // 4 spans of 2 segments
  CHECK(spline.points[0] == std::array<double, 4>{0, 0, 0, 0.5});
  CHECK(spline.points[8][0] == doctest::Approx(1));
  CHECK(spline.points[8][1] == doctest::Approx(1));
  CHECK(spline.points[8][3] == 0.125);
  const CurvesShape &fur = shape_as<CurvesShape>(scene.shapes[15]);
  CHECK(fur.sizes == std::vector<std::int32_t>(7, 4));
  CHECK(fur.points[0][3] == doctest::Approx(0.01));
  CHECK(fur.points[3][3] == doctest::Approx(0.005));
  CHECK(std::hypot(fur.points[4][0] - 1, fur.points[4][1] - 2, fur.points[4][2] - 3) ==
        doctest::Approx(2));
  REQUIRE(scene.groups.size() == 1);
  CHECK(scene.groups[0].name == "pair");
  REQUIRE(scene.groups[0].shapes.size() == 2);
  CHECK(scene.groups[0].shapes[1].origin == scene.file + ": /groups/0/shapes/1");
  CHECK(num_triangles(scene.groups[0].shapes[1]) == 20);
  REQUIRE(scene.instances.size() == 3);
  CHECK(!scene.instances[0].transform_end);
  REQUIRE(scene.instances[2].transform_end);
  CHECK(scene.instances[2].transform_end->m[0][3] == 6);
  CHECK(scene.instances[0].group == 0);
  CHECK(scene.instances[0].origin == scene.file + ": /instances/0");
}

TEST_CASE("scene file: the steps of a transform are applied in their order") {
  const SceneDescription scene = everything();
  check_rows(scene.shapes[0].transform, {{{1, 0, 0, 0}, {0, 1, 0, 0.5}, {0, 0, 1, 0}}});
  // Scaled by 2, then x to y by a quarter turn, then moved: exact, since 90 degrees are.
  check_rows(scene.shapes[1].transform, {{{0, -2, 0, 10}, {2, 0, 0, 0}, {0, 0, 2, 0}}});
  check_rows(scene.shapes[2].transform, {{{0, 0, 1, 7}, {1, 0, 0, 8}, {0, 1, 0, 9}}});
  check_rows(scene.shapes[3].transform, {{{1, 0, 0, 0}, {0, 2, 0, 0}, {0, 0, 3, 0}}});
  check_rows(scene.instances[0].transform, {{{1, 0, 0, 1}, {0, 1, 0, 0}, {0, 0, 1, 1}}});
  check_rows(scene.instances[1].transform, {});
}

TEST_CASE("scene file: every invalid scene is refused with its place, cause and remedy") {
  int num_scenes = 0;
  const auto start = std::chrono::steady_clock::now();
  for (const auto &entry :
       std::filesystem::directory_iterator(source_path("tests/scene/invalid"))) {
    if (entry.path().extension() != ".json") continue;
    num_scenes++;
    const std::string scene_path = entry.path().string();
    CAPTURE(scene_path);
    Diagnostics diagnostics;
    load_scene_file(scene_path, diagnostics);
    const std::string errors = errors_of(diagnostics);
    CAPTURE(errors);
    // A line "errors: N" says how many errors there are, 1 if there is none: mistakes do not cascade.
    std::size_t num_expected = 1;
    std::filesystem::path expected_path = entry.path();
    std::istringstream expected(read_text(expected_path.replace_extension(".expected").string()));
    int num_lines = 0;
    for (std::string line; std::getline(expected, line); num_lines++) {
      if (line.starts_with("errors: ")) {
        num_expected = std::stoul(line.substr(8));
      } else {
        CAPTURE(line);
        CHECK(errors.find(line) != std::string::npos);
      }
    }
    CHECK(num_lines > 0);
    CHECK(diagnostics.errors().size() == num_expected);
    for (const Problem &problem : diagnostics.errors()) {
      CHECK(problem.text().starts_with(scene_path + ":"));
      CHECK(problem.line > 0);
      CHECK(problem.column > 0);
      CHECK(problem.message.find('\n') == std::string::npos);
    }
  }
  CHECK(num_scenes >= 170);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  CHECK(seconds.count() < 0.1 * num_scenes);
}

TEST_CASE("scene file: twenty errors are shown and the others counted") {
  std::string text = R"({"version": 1)";
  for (int i = 0; i < 33; i++) text += ", \"wrong key " + std::to_string(i) + "\": 0";
  Diagnostics diagnostics;
  parse_scene_text(text + "}", "scene.json", ".", diagnostics);
  CHECK(diagnostics.errors().size() == 20);
  try {
    diagnostics.throw_if_errors();
    FAIL("expected an InputError");
  } catch (const InputError &error) {
    CHECK(error.problems().size() == 21);
    CHECK(error.problems().back().text() == "scene.json: and 13 more errors");
    CHECK(std::string(error.what()).starts_with("scene.json:1:16: /wrong key 0: unknown key"));
  }
}

TEST_CASE("scene file: a problem is printed without what is not known") {
  CHECK(Problem{"a.json", 3, 5, "/film", "bad"}.text() == "a.json:3:5: /film: bad");
  CHECK(Problem{"a.json", 3, 0, "", "bad"}.text() == "a.json:3: bad");
  CHECK(Problem{"a.json", 0, 0, "", "bad"}.text() == "a.json: bad");
  CHECK(Problem{"", 0, 0, "/film", "bad"}.text() == "/film: bad");
  CHECK(std::string(InputError("bad").what()) == "bad");
}

TEST_CASE("scene file: files that cannot be read are named") {
  const auto errors_of_file = [](const std::string &path) {
    Diagnostics diagnostics;
    load_scene_file(path, diagnostics);
    return errors_of(diagnostics);
  };
  const std::string folder = source_path("tests/scene");
  CHECK(errors_of_file(folder + "/no-such-scene.json") ==
        folder + "/no-such-scene.json: there is no such file\n");
  CHECK(errors_of_file(folder) == folder + ": this is a folder; expected a scene file\n");
  CHECK(errors_of_file("") == "there is no such file\n");
}

TEST_CASE("scene file: nothing is generated for a file with an error") {
  // 50 million triangles would take seconds and gigabytes.
  const auto start = std::chrono::steady_clock::now();
  const std::string errors =
      errors_in_scene(R"({"version": 1, "materials": [{"name": "m", "type": "diffuse"}],
    "shapes": [{"type": "terrain", "material": "m", "resolution": 5000}], "oops": 0})");
  CHECK(errors ==
        "scene.json:2:75: /oops: unknown key 'oops' in a scene; known keys: version, description, "
        "camera, "
        "film, sampler, integrator, textures, materials, lights, shapes, groups, instances\n");
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  CHECK(seconds.count() < 0.1);
}

TEST_CASE("scene file: what is allowed but hardly meant is a warning") {
  const auto first_warning = [](const std::string &body) {
    Diagnostics diagnostics;
    parse_scene_text("{\"version\": 1, " + body + "}", "scene.json", ".", diagnostics);
    CHECK(!diagnostics.has_errors());
    return diagnostics.warnings().empty() ? "" : diagnostics.warnings()[0].text();
  };
  CHECK(first_warning(R"("sampler": {"spp": 100})")
            .starts_with("scene.json:1:27: /sampler: spp 100 is not a power of two"));
  CHECK(first_warning(R"("sampler": {"spp": 128})") == "");
  CHECK(first_warning(R"("sampler": {"type": "independent", "spp": 100})") == "");
  CHECK(first_warning(R"("materials": [{"name": "m", "type": "black", "two_sided": true}])")
            .find("two_sided does nothing") != std::string::npos);
}

TEST_CASE("scene file: a box filter is one pixel wide unless told otherwise") {
  Diagnostics diagnostics;
  const auto film = [&](const std::string &filter) {
    return parse_scene_text("{\"version\": 1, \"film\": {\"filter\": " + filter + "}}", "", ".",
                            diagnostics)
        .film;
  };
  CHECK(film(R"({"type": "box"})").filter_radius == 0.5);
  CHECK(film(R"({"type": "box", "radius": 1})").filter_radius == 1);
  CHECK(film(R"({"radius": 3})").filter == kBlackmanHarrisFilter);
  CHECK(!diagnostics.has_errors());
}

TEST_CASE("scene file: numbers of whole value are integers however they are written") {
  Diagnostics diagnostics;
  const SceneDescription scene = parse_scene_text(
      R"({"version": 1.0, "film": {"width": 1e3, "height": 64.0}, "camera": {"fov": 4.5E+1}})", "",
      ".", diagnostics);
  CHECK(errors_of(diagnostics) == "");
  CHECK(scene.film.width == 1000);
  CHECK(scene.film.height == 64);
}

TEST_CASE("scene file: metals reflect as metals do") {
  CHECK(metals().size() == 8);
  for (const Metal &metal : metals()) {
    CAPTURE(metal.name);
    Double3 reflectance;
    for (std::size_t i = 0; i < 3; i++) {
      const double k2 = metal.k[i] * metal.k[i], minus = metal.eta[i] - 1, plus = metal.eta[i] + 1;
      reflectance[i] = (minus * minus + k2) / (plus * plus + k2);
      CHECK(reflectance[i] > 0.4);
      CHECK(reflectance[i] < 1);
    }
    // No metal of the table is bluish by more than a little.
    CHECK(reflectance[0] > reflectance[2] - 0.02);
  }
}
