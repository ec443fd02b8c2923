// Materials from scene files to what kernels read: principled, hair, lobes of "dirt", blends, null.
#include <doctest/doctest.h>

#include <cmath>

#include "../../kernels/physics/albedo_table.h"
#include "scene/build.h"
#include "scene_texts.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

/// The material of that name in everything.json.
const MaterialDescription &find(const SceneDescription &scene, const std::string &name) {
  for (const MaterialDescription &material : scene.materials)
    if (material.name == name) return material;
  FAIL("there is no material " << name);
  return scene.materials[0];
}

SceneDescription parse(const std::string &world) {
  Diagnostics diagnostics;
  const SceneDescription scene =
      parse_scene_text(R"({"version": 1, )" + world + "}", "scene.json", ".", diagnostics);
  REQUIRE(errors_of(diagnostics) == "");
  return scene;
}

Scene build(const std::string &world) {
  Diagnostics diagnostics;
  Scene scene = build_scene(parse(world), diagnostics);
  REQUIRE(errors_of(diagnostics) == "");
  return scene;
}

/// The only material of a scene, built.
Material built(const std::string &keys) {
  return build(R"("materials": [{"name": "m", )" + keys + "}]").materials.at(0);
}

}  // namespace

TEST_CASE("materials: principled, hair, Phong and blends say what the file says") {
  Diagnostics diagnostics;
  const SceneDescription scene =
      load_scene_file(source_path("tests/scene/valid/everything.json"), diagnostics);
  const MaterialDescription &lacquer = find(scene, "lacquer"), &gloss = find(scene, "gloss"),
                            &sheen = find(scene, "sheen"), &fair = find(scene, "fair"),
                            &dark = find(scene, "dark"), &mixed = find(scene, "mixed"),
                            &nested = find(scene, "nested"), &nothing = find(scene, "nothing");
  CHECK(lacquer.kind == kPrincipled);
  CHECK(lacquer.reflectance == Double3{0.25, 0.5, 0.75});
  CHECK(lacquer.metallic == 0.25);
  CHECK(lacquer.roughness == 0.4);
  CHECK(lacquer.ior == 1.4);
  CHECK(lacquer.specular_level == 0.9);
  CHECK(lacquer.specular == Double3{0.9, 0.8, 0.7});
  CHECK(lacquer.transmission == 0.125);
  CHECK(lacquer.clearcoat == 0.75);
  CHECK(lacquer.clearcoat_roughness == 0.2);
  CHECK(lacquer.sheen == Double3{0.1, 0.2, 0.3});
  CHECK(lacquer.sheen_roughness == 0.6);
  CHECK(lacquer.one_sided);
  CHECK(gloss.kind == kPhong);
  CHECK(gloss.exponent == 50);
  CHECK(sheen.kind == kBlinnPhong);
  CHECK(sheen.reflectance == Double3{0.1, 0.2, 0.3});
  CHECK(fair.kind == kHair);
  CHECK(!fair.has_absorption);
  CHECK(fair.roughness == 0.2);
  CHECK(fair.azimuthal_roughness == 0.4);
  CHECK(fair.ior == 1.6);
  CHECK(fair.tilt == 3);
  CHECK(dark.has_absorption);
  CHECK(dark.absorption == Double3{3, 4, 5});
  CHECK(is_blend(mixed));
  CHECK(scene.materials.at(static_cast<std::size_t>(mixed.blend_a)).name == "nested");
  CHECK(scene.materials.at(static_cast<std::size_t>(mixed.blend_b)).name == "red");
  CHECK(mixed.weight == 0.25);
  CHECK(mixed.emission == Double3{1, 1, 1});
  CHECK(scene.materials.at(static_cast<std::size_t>(nested.blend_b)).name == "fair");
  CHECK(nested.weight == 0.5);
  CHECK(nothing.is_null);
  CHECK(!mixed.is_null);
}

TEST_CASE("materials: kernels get what the description says") {
  const Material m = built(
      R"("type": "principled", "roughness": 0.5, "clearcoat_roughness": 0.25, "sheen_roughness": 1,
         "specular": 0.75, "metallic": 0.5, "transmission": 0.25, "one_sided": true, "opacity": 0.5)");
  CHECK(m.kind == kPrincipled);
  CHECK(m.alpha == 0.25f);
  CHECK(m.clearcoat_alpha == 0.0625f);
  CHECK(m.sheen_alpha == 1.0f);
  CHECK(m.specular_level == 0.75f);
  CHECK((m.metallic == 0.5f && m.transmission == 0.25f));
  CHECK(m.one_sided == 1);
  CHECK(m.opacity == 0.5f);
  CHECK(m.table >= 0);
  CHECK(built(R"("type": "phong", "exponent": 3)").exponent == 3.0f);
  CHECK(built(R"("type": "diffuse")").one_sided == 0);
}

TEST_CASE("materials: two principled materials share their tables") {
  const Scene scene = build(
      R"("materials": [{"name": "a", "type": "principled"}, {"name": "b", "type": "principled"}])");
  CHECK(scene.materials[0].table == scene.materials[1].table);
  CHECK(scene.tables.size() == 3 * PHALANX_ALBEDO_FLOATS);
}

TEST_CASE("materials: the colour of hair and its absorption are told from one another") {
  // Chiang et al. 2016, eq. 9, for an azimuthal roughness of 0.3.
  const double divisor =
      5.969 - 0.215 * 0.3 + 2.532 * 0.09 - 10.73 * 0.027 + 5.574 * 0.0081 + 0.245 * 0.00243;
  const Material fair = built(R"("type": "hair", "reflectance": [0.7, 0.5, 0])");
  CHECK(fair.transmittance.x == doctest::Approx(std::pow(std::log(0.7) / divisor, 2)));
  CHECK(fair.transmittance.y == doctest::Approx(std::pow(std::log(0.5) / divisor, 2)));
  CHECK((fair.transmittance.z > 5 && is_finite(fair.transmittance.z)));
  const Material same = built(R"("type": "hair", "absorption": [)" +
                              std::to_string(fair.transmittance.x) + ", 0, 1e3]");
  CHECK(same.reflectance.x == doctest::Approx(0.7).epsilon(1e-4));
  CHECK(same.reflectance.y == 1.0f);
  CHECK(same.reflectance.z < 1e-20f);
  CHECK(fair.roughness == doctest::Approx(0.3));
  CHECK(fair.alpha == doctest::Approx(0.3));
  CHECK(fair.tilt == doctest::Approx(std::sin(2 * 3.14159265358979 / 180)));
}

TEST_CASE("materials: blends know their parts by index, wherever these stand") {
  const Scene scene = build(R"("materials": [
      {"name": "x", "type": "blend", "a": "red", "b": "y", "weight": 0.75, "emission": 2},
      {"name": "red", "type": "diffuse"},
      {"name": "y", "type": "blend", "a": "red", "b": "red"}])");
  const Material &x = scene.materials[0];
  CHECK(x.kind == kBlend);
  CHECK((x.blend_a == 1 && x.blend_b == 2));
  CHECK(x.weight == 0.75f);
  CHECK(x.emission.x == 2.0f);
}

TEST_CASE("materials: 16 levels of blends are read, and a thousand that share their parts") {
  std::string text = R"("materials": [{"name": "x0", "type": "diffuse"})";
  for (int i = 1; i <= 1000; ++i) {
    const std::string part = "\"x" + std::to_string(i <= 16 ? i - 1 : 15) + "\"";
    text += R"(, {"name": "x)" + std::to_string(i) + R"(", "type": "blend", "a": )" + part +
            R"(, "b": )" + part + "}";
  }
  CHECK(parse(text + "]").materials.size() == 1001);
}

TEST_CASE("materials: shapes of null materials are left out, with a note") {
  const Scene scene = build(R"(
      "materials": [{"name": "air", "type": "null"}, {"name": "red", "type": "diffuse"}],
      "shapes": [{"type": "sphere", "material": "air", "center": [0, 0, 0], "radius": 1},
                 {"type": "sphere", "material": "red", "center": [5, 0, 0], "radius": 1}],
      "groups": [{"name": "g", "shapes": [
                 {"type": "sphere", "material": "air", "center": [0, 9, 0], "radius": 1}]}],
      "instances": [{"group": "g"}])");
  CHECK(scene.geometries.size() == 1);
  CHECK(scene.instances.empty());
  CHECK(scene.bounds_lo.x == doctest::Approx(4));
  CHECK(scene.bounds_hi.y == doctest::Approx(1));
  REQUIRE(scene.notes.size() == 1);
  CHECK(scene.notes[0] == "2 shapes of null materials left out");
}
