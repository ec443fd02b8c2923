// Scenes that are hard on numbers: moved to the origin, freed of repetitions, and spoken of.
#include <doctest/doctest.h>

#include "scene/build.h"
#include "scene/recentre.h"
#include "scene/scene_file.h"
#include "scene/stiffness.h"

using namespace phalanx;

namespace {

SceneDescription parse(const std::string &rest) {
  Diagnostics diagnostics;
  SceneDescription scene = parse_scene_text(R"({"version": 1, )" + rest + "}", "test", ".", diagnostics);
  for (const Problem &p : diagnostics.errors()) FAIL(p.text());
  return scene;
}

Scene build(const SceneDescription &description) {
  Diagnostics diagnostics;
  Scene scene = build_scene(description, diagnostics);
  for (const Problem &p : diagnostics.errors()) FAIL(p.text());
  return scene;
}

const char kMaterials[] = R"("materials": [{"name": "m", "type": "diffuse"}, {"name": "n", "type": "diffuse", "reflectance": 0.2},
  {"name": "veil", "type": "diffuse", "opacity": 0.5}], )";

bool mentions(const std::vector<Stiffness> &found, const std::string &part) {
  for (const Stiffness &s : found)
    if (s.what.find(part) != std::string::npos) return true;
  return false;
}
std::vector<Stiffness> stiffness(const std::string &rest) {
  const SceneDescription description = parse(rest);
  return find_stiffness(description, build(description));
}

}  // namespace

TEST_CASE("recentre: a scene far off is moved to the origin with camera and lights") {
  const SceneDescription scene = parse(std::string(kMaterials) +
      R"("camera": {"position": [1e6, 0, 3], "look_at": [1e6, 0, 0]},
    "lights": [{"type": "point", "position": [1e6, 2, 0], "intensity": 1}, {"type": "directional", "direction": [0, -1, 0], "irradiance": 1}],
    "shapes": [{"type": "sphere", "material": "m", "center": [1e6, 0, 0], "radius": 1}])");
  CHECK(scene.origin[0] == 1e6);
  CHECK(scene.camera.position[0] == 0);
  CHECK(scene.camera.look_at[0] == 0);
  CHECK(scene.camera.position[2] - scene.camera.look_at[2] == 3);
  CHECK(scene.lights[0].position[0] == 0);
  CHECK(scene.lights[1].direction[1] == -1);
  CHECK(build(scene).spheres[0].center.x == 0.0f);
}

TEST_CASE("recentre: what is near, empty, or textured in space stays") {
  CHECK(parse(std::string(kMaterials) + R"("shapes": [{"type": "sphere", "material": "m", "center": [100, 0, 0], "radius": 1}])").origin ==
        Double3{0, 0, 0});
  CHECK(parse(R"("camera": {"position": [1e9, 0, 3], "look_at": [1e9, 0, 0]})").origin == Double3{0, 0, 0});
  CHECK(parse(R"("camera": {"position": [1e6, 0, 3], "look_at": [1e6, 0, 0]},
    "textures": [{"name": "t", "type": "marble"}], "materials": [{"name": "m", "type": "diffuse", "reflectance": "t"}],
    "shapes": [{"type": "sphere", "material": "m", "center": [1e6, 0, 0], "radius": 1}])").origin == Double3{0, 0, 0});
}

TEST_CASE("recentre: instances move, groups do not") {
  const SceneDescription scene = parse(std::string(kMaterials) +
      R"("camera": {"position": [1e6, 0, 3], "look_at": [1e6, 0, 0]},
    "groups": [{"name": "g", "shapes": [{"type": "box", "material": "m"}]}],
    "instances": [{"group": "g", "transform": {"translate": [1e6, 0, 0]}, "transform_end": {"translate": [1e6, 1, 0]}}])");
  CHECK(scene.instances[0].transform.m[0][3] == 0);
  CHECK(scene.instances[0].transform_end->m[0][3] == 0);
  CHECK(scene.instances[0].transform_end->m[1][3] - scene.instances[0].transform.m[1][3] == 1);
}

TEST_CASE("repeated shapes: the first of two in one place stays (G6)") {
  const auto scene = [](const std::string &first, const std::string &second) {
    return build(parse(std::string(kMaterials) + R"("shapes": [)" + first + ", " + second + "]"));
  };
  const std::string quad = R"({"type": "quad", "material": "m", "corner": [0,0,0], "edge_u": [1,0,0], "edge_v": [0,1,0]})";
  const std::string turned = R"({"type": "quad", "material": "n", "corner": [0,1,0], "edge_u": [1,0,0], "edge_v": [0,-1,0]})";
  const std::string moved = R"({"type": "quad", "material": "n", "corner": [0,0,1e-6], "edge_u": [1,0,0], "edge_v": [0,1,0]})";
  const std::string veil = R"({"type": "quad", "material": "veil", "corner": [0,0,0], "edge_u": [1,0,0], "edge_v": [0,1,0]})";
  const Scene same = scene(quad, turned);
  CHECK(same.quads.size() == 1);
  CHECK(same.geometries.size() == 1);
  CHECK(same.geometries[0].material == 0);
  CHECK(same.num_dropped == 1);
  CHECK(same.notes.size() == 1);
  CHECK(scene(quad, moved).quads.size() == 2);
  CHECK(scene(quad, veil).quads.size() == 2);
  CHECK(scene(veil, quad).quads.size() == 2);
  const std::string mesh = R"("positions": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "normals": [[0,0,1],[0,0,1],[0,0,1],[0,0,1]], "indices": )";
  const Scene meshes = scene(R"({"type": "mesh", "material": "m", )" + mesh + "[[0,1,2],[0,2,3]]}",
                             R"({"type": "mesh", "material": "n", )" + mesh + "[[2,0,3],[2,1,0]]}");
  CHECK(meshes.triangles.size() == 2);
  CHECK(meshes.num_vertices() == 4);
  CHECK(meshes.vertex_normals.size() == 12);
  CHECK(scene(R"({"type": "sphere", "material": "m", "center": [0,0,0], "radius": 1})",
              R"({"type": "sphere", "material": "n", "center": [0,0,0], "radius": 1})").spheres.size() == 1);
  CHECK(scene(R"({"type": "disk", "material": "m", "center": [0,0,0], "normal": [0,0,1], "radius": 1})",
              R"({"type": "disk", "material": "n", "center": [0,0,0], "normal": [0,0,1], "radius": 1})").disks.size() == 1);
}

TEST_CASE("repeated shapes: groups are spaces of their own") {
  const Scene scene = build(parse(std::string(kMaterials) +
      R"("shapes": [{"type": "sphere", "material": "m", "center": [0,0,0], "radius": 1}],
    "groups": [{"name": "g", "shapes": [{"type": "sphere", "material": "m", "center": [0,0,0], "radius": 1}]}],
    "instances": [{"group": "g", "transform": {"translate": [5,0,0]}}])"));
  CHECK(scene.spheres.size() == 2);
}

TEST_CASE("stiffness: each kind is found") {
  const std::string camera = R"("camera": {"position": [0, 0, 5], "look_at": [0, 0, 0]}, )";
  CHECK(stiffness(camera + kMaterials + R"("shapes": [{"type": "box", "material": "m"}])").empty());
  CHECK(mentions(stiffness(camera + kMaterials + R"("shapes": [{"type": "mesh", "material": "m",
    "positions": [[0,0,0],[1,0,0],[0.5,1e-7,0]], "indices": [[0,1,2]]}])"), "sliver"));
  CHECK(mentions(stiffness(camera + kMaterials + R"("shapes": [{"type": "sphere", "material": "m", "center": [0,0,0], "radius": 1e-4},
    {"type": "sphere", "material": "m", "center": [0,0,0], "radius": 1e4}])"), "shapes from"));
  CHECK(mentions(stiffness(R"("camera": {"position": [1e6, 0, 5], "look_at": [1e6, 0, 0]}, "textures": [{"name": "t", "type": "noise"}],
    "materials": [{"name": "m", "type": "diffuse", "reflectance": "t"}],
    "shapes": [{"type": "box", "material": "m", "transform": {"translate": [1e6, 0, 0]}}])"), "steps of"));
  const auto of = [&](const std::string &material) {
    return stiffness(camera + R"("materials": [{"name": "m", )" + material +
                     R"(}], "lights": [{"type": "point", "position": [0,3,0], "intensity": 1}], "shapes": [{"type": "box", "material": "m"}])");
  };
  CHECK(mentions(of(R"("type": "conductor", "alpha": 1e-5)"), "nearly smooth"));
  CHECK(mentions(of(R"("type": "conductor", "alpha": 5e-3)"), "sharp highlights"));
  CHECK_FALSE(mentions(of(R"("type": "conductor", "alpha": 0.1)"), "highlights"));
  CHECK(mentions(of(R"("type": "diffuse", "reflectance": 1)"), "reflects everything"));
  CHECK(mentions(of(R"("type": "dielectric", "ior": 1.00001)"), "next to 1"));
  CHECK(mentions(of(R"("type": "dielectric", "ior": 50)"), "extreme index"));
  CHECK(mentions(of(R"("type": "dielectric")"), "no extent"));
  CHECK(mentions(stiffness(camera + R"("materials": [{"name": "m", "type": "diffuse"}, {"name": "l", "type": "black", "emission": 1e7}],
    "shapes": [{"type": "box", "material": "m"}, {"type": "sphere", "material": "l", "center": [0,3,0], "radius": 1e-4}])"), "tiny and very bright"));
}
