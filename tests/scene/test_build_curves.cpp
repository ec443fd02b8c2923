// Strands and moving instances in the built scene.
#include <doctest/doctest.h>

#include <cmath>

#include "../../src/scene/build.h"
#include "../../src/scene/generate.h"
#include "scene_texts.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

std::string scene_text(const std::string &parts) {
  return R"({"version": 1, "materials": [{"name": "grey", "type": "diffuse"},
    {"name": "lamp", "type": "black", "emission": 1}], )" +
         parts + "}";
}

Scene build(const std::string &parts, std::string &error) {
  Diagnostics diagnostics;
  const SceneDescription description =
      parse_scene_text(scene_text(parts), "scene.json", ".", diagnostics);
  REQUIRE_MESSAGE(!diagnostics.has_errors(), errors_of(diagnostics));
  Scene scene = build_scene(description, diagnostics);
  error = errors_of(diagnostics);
  return scene;
}

Scene build_good(const std::string &parts) {
  std::string error;
  Scene scene = build(parts, error);
  CHECK(error == "");
  return scene;
}

void check_error(const std::string &parts, const std::string &expected) {
  std::string error;
  build(parts, error);
  INFO(error);
  CHECK(error.find(expected) != std::string::npos);
}

std::string curves(const std::string &more, const char *material = "grey") {
  return std::string(R"("shapes": [{"type": "curves", "material": ")") + material + "\", " + more + "}]";
}

}  // namespace

TEST_CASE("curves: points, segments and places along the strands") {
  const Scene scene = build_good(curves(
      R"("radius": [0.5, 0.25], "strands": [[[0, 0, 0], [0, 1, 0], [0, 1, 0], [0, 1, 3]], [[5, 0, 0], [6, 0, 0]],
         [[7, 7, 7], [7, 7, 7]]], "transform": {"scale": 2})"));
  REQUIRE(scene.geometries.size() == 1);
  CHECK(scene.geometries[0].shape == kCurves);
  CHECK(scene.num_prims[0] == 3);
  CHECK(scene.curve_segments == std::vector<std::int32_t>{0, 1, 3});  // a point that repeats is left out
  CHECK(scene.curve_along == std::vector<float>{0, 0.25f, 1, 0, 1});
  REQUIRE(scene.curve_points.size() == 20);
  CHECK(scene.curve_points[8] == 0.0f);
  CHECK(scene.curve_points[9] == 2.0f);
  CHECK(scene.curve_points[10] == 6.0f);
  CHECK(scene.curve_points[11] == 0.5f);
  CHECK(scene.num_dropped == 1);
  CHECK(scene.bounds_lo.x == -1.0f);
  CHECK(scene.view().num_curve_segments == 3);
}

TEST_CASE("curves: long thin pieces are cut, short ones stay") {
  const Scene scene = build_good(curves(
      R"("radius": [0.05, 0.001], "strands": [[[0, 0, 0], [0, 40, 0]], [[3, 0, 0], [3, 0.1, 0]]])"));
  const auto num_points = scene.curve_points.size() / 4;
  CHECK(num_points - 2 > 40 / (0.05 * 150));
  REQUIRE(num_points - 2 < 100);
  for (std::size_t i = 0; i + 3 < num_points; ++i) {
    const float *const a = &scene.curve_points[4 * i], *const b = a + 4;
    CHECK(b[1] - a[1] <= 151 * b[3]);
    CHECK(a[3] == doctest::Approx(0.05 - 0.049 * double(a[1]) / 40));
    CHECK(scene.curve_along[i] == doctest::Approx(double(a[1]) / 40));
  }
  CHECK(scene.curve_points[4 * (num_points - 3) + 1] == 40);
  CHECK(scene.num_prims[0] == static_cast<std::int32_t>(num_points - 2));
}

TEST_CASE("curves: what they cannot be") {
  const std::string strand = R"("radius": 0.1, "strands": [[[0, 0, 0], [0, 1, 0]]])";
  check_error(curves(strand, "lamp"), "/shapes/0: curves cannot emit");
  check_error(curves(strand + R"(, "transform": {"scale": [1, 2, 1]})"), "scaled equally in all directions");
  check_error(curves(strand + R"(, "transform": [{"scale": 1e18}, {"scale": 10}])"), "at most 1.8e18");
  const std::string group =
      R"("groups": [{"name": "g", "shapes": [{"type": "curves", "material": "grey", )" + strand + "}]}], ";
  check_error(group + R"("instances": [{"group": "g", "transform": {"scale": [1, 2, 1]}}])",
              "/instances/0: a group with curves");
  check_error(group + R"("instances": [{"group": "g",
      "transform_end": {"rotate": {"axis": [0, 0, 1], "angle": 20}}}])",
              "/instances/0: a group with curves cannot turn while it moves");
  build_good(group + R"("instances": [{"group": "g", "transform": {"scale": 2},
      "transform_end": [{"scale": 3}, {"translate": [1, 0, 0]}]}])");
}

TEST_CASE("fur: strands start on the sphere, have the length asked for, the same on every machine") {
  Fur fur;
  fur.center = {1, 2, 3};
  fur.radius = 2;
  fur.count = 2000;
  fur.segments = 16;
  for (const double bend : {0.0, 1.0}) {
    fur.bend = bend;
    const CurvesShape shape = generate_fur(fur);
    REQUIRE(shape.sizes.size() == 2000);
    REQUIRE(shape.points.size() == 2000 * 17);
    double sum = 0;
    Double3 mean_root = {0, 0, 0};
    for (std::size_t i = 0; i < 2000; ++i) {
      const auto *const p = &shape.points[17 * i];
      const double off = std::hypot(p[0][0] - 1, p[0][1] - 2, p[0][2] - 3);
      REQUIRE(off == doctest::Approx(2));
      REQUIRE(p[0][3] == 0.0005);
      REQUIRE(p[16][3] == doctest::Approx(0.00005));
      double size = 0;
      for (int k = 0; k < 16; ++k)
        size += std::hypot(p[k + 1][0] - p[k][0], p[k + 1][1] - p[k][1], p[k + 1][2] - p[k][2]);
      REQUIRE(size > 0.8 * 0.3 * 0.999);
      REQUIRE(size < 1.2 * 0.3 * 1.001);
      sum += size / 2000;
      for (std::size_t axis = 0; axis < 3; ++axis) mean_root[axis] += p[0][axis] / 2000;
    }
    CHECK(sum == doctest::Approx(0.3).epsilon(0.02));
    CHECK(std::hypot(mean_root[0] - 1, mean_root[1] - 2, mean_root[2] - 3) < 0.15);
  }
}

TEST_CASE("motion: only instances that move have one") {
  const std::string group =
      R"("groups": [{"name": "g", "shapes": [{"type": "sphere", "material": "grey", "center": [0, 0, 0], "radius": 1}]},
                    {"name": "lamps", "shapes": [{"type": "sphere", "material": "lamp", "center": [0, 0, 0], "radius": 1}]}], )";
  CHECK(build_good(group + R"("instances": [{"group": "g"}, {"group": "g"}])").motions.empty());
  const Scene scene = build_good(
      group + R"("instances": [{"group": "g"}, {"group": "g", "transform_end": {"translate": [5, 0, 0]}}])");
  REQUIRE(scene.motions.size() == 2);
  CHECK(scene.motions[0].moves == 0);
  CHECK(scene.motions[1].moves == 1);
  CHECK(scene.motions[1].to_world_end.m03 == 5.0f);
  CHECK(scene.bounds_hi.x == 6.0f);
  check_error(group + R"("instances": [{"group": "lamps", "transform_end": {"translate": [5, 0, 0]}}])",
              "/instances/0: group 'lamps' holds shapes that emit: it cannot move");
  check_error(group + R"("instances": [{"group": "g",
      "transform_end": {"rotate": {"axis": [0, 0, 1], "angle": 180}}}])",
              "/instances/0: the group becomes flat on its way");
  check_error(group + R"("instances": [{"group": "g", "transform_end": {"scale": [1, 1, -1]}}])",
              "becomes flat");
  check_error(group + R"("instances": [{"group": "g", "transform_end": {"scale": 0}}])",
              "transform_end: the transform is singular");
}
