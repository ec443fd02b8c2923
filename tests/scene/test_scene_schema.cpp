// docs/scene.schema.json and the scene reader say the same: held together by examples and mutants.
#include <doctest/doctest.h>

#include <array>
#include <functional>

#include "json_schema.h"
#include "scene_texts.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

const JsonSchema &schema() {
  static const JsonSchema loaded(Json::parse(read_text(source_path("docs/scene.schema.json"))));
  return loaded;
}

Json valid_scene(const std::string &name) {
  return Json::parse(read_text(source_path("tests/scene/valid/" + name + ".json")));
}
Json everything() { return valid_scene("everything"); }
/// A scene has one environment only: these have the others.
std::vector<Json> valid_scenes() { return {everything(), valid_scene("sky"), valid_scene("map")}; }

/// Errors that no JSON Schema can state: they compare one value with another, or ask the disk.
bool is_beyond_schema(const std::string &errors) {
  for (const char *message :
       {"unknown material '",   "unknown group '",       "duplicate material name",
        "unknown texture '",     "duplicate texture name", "is not sRGB",
        "emission_scale is for", "normal_scale is for",   "bump_scale is for",
        "are linear: leave out", "scale makes cubes",     "a .png, .jpg, .hdr or .exr",
        "duplicate group name", "position and look_at",  "up is [0, 0, 0]",
        "up is parallel",       "the axis is [0, 0, 0]", "the normal is [0, 0, 0]",
        "the crop reaches",     "2^30 pixels",           "out of range: the mesh",
        "for every vertex",     "for every triangle",    "one normal for each",
        "one uv for each",       "one colour for each",
        "there is no file",     "an .obj or .ply file",  "amplitude must be less",
        "more than 50 million", "made of itself",        "nested more than", "; give",
        "every component of lo", "too large",            "a second environment",
        "an .hdr or .exr file", "an .ies file",          "inner_angle is larger",
        "direction is [0",      "horizontal is "}) {
    if (errors.find(message) != std::string::npos) return true;
  }
  return false;
}

/// Reads a scene that has one more error, so that generators do not run; returns the other errors.
std::string errors_without_generating(Json scene) {
  scene["zzz"] = 0;
  Diagnostics diagnostics;
  parse_scene_text(scene.dump(), "scene.json", source_path("tests/scene/valid"), diagnostics);
  std::string errors;
  for (const Problem &problem : diagnostics.errors()) {
    if (problem.json_path != "/zzz") errors += problem.text() + "\n";
  }
  return errors;
}

void check_agreement(const Json &scene) {
  const std::string errors = errors_without_generating(scene);
  const bool valid = schema().accepts(scene);
  if (valid == errors.empty() || (valid && is_beyond_schema(errors))) return;
  FAIL_CHECK((valid ? "the schema accepts, the reader does not: "
                    : "the reader accepts, the schema does not: ")
             << errors << scene.dump());
}

/// Calls `visit` with the pointer of every value below the root.
void for_each_value(const Json &value, const Json::json_pointer &at,
                    const std::function<void(const Json::json_pointer &)> &visit) {
  if (!value.is_structured()) return;
  for (const auto &[key, child] : value.items()) {
    const Json::json_pointer place = value.is_array() ? at / std::stoul(key) : at / key;
    visit(place);
    for_each_value(child, place, visit);
  }
}

/// A schema of one object, and where such an object stands in a scene.
struct ObjectCase {
  Json schema;  // with "properties" and "examples"
  Json scene;   // valid, holding the example
  Json::json_pointer at;
};

/// All object schemas with an example, each in a scene that is valid around it.
std::vector<ObjectCase> object_cases() {
  const Json base =
      Json::parse(R"({"version": 1, "materials": [{"name": "example", "type": "diffuse"},
                                                  {"name": "other", "type": "diffuse"}],
                                    "groups": [{"name": "example", "shapes": []}]})");
  const std::vector<std::array<const char *, 2>> places = {{"camera", "/camera"},
                                                           {"film", "/film"},
                                                           {"filter", "/film/filter"},
                                                           {"sampler", "/sampler"},
                                                           {"integrator", "/integrator"},
                                                           {"light", "/lights/0"},
                                                           {"texture", "/textures/0"},
                                                           {"texture_transform",
                                                            "/textures/0/transform"},
                                                           {"material", "/materials/0"},
                                                           {"shape", "/shapes/0"},
                                                           {"group", "/groups/0"},
                                                           {"instance", "/instances/0"},
                                                           {"step", "/instances/0/transform"}};
  std::vector<ObjectCase> cases;
  for (const auto &[definition, place] : places) {
    const Json &family = schema().root()["$defs"][definition];
    for (const Json &variant : family.contains("oneOf") ? family["oneOf"] : Json::array({family})) {
      ObjectCase object = {variant, base, Json::json_pointer(place)};
      if (std::string(place) == "/instances/0/transform")
        object.scene["instances"] = Json::parse(R"([{"group": "example"}])");
      if (std::string(place) == "/textures/0/transform")
        object.scene["textures"] =
            Json::parse(R"([{"name": "example", "type": "image", "file": "tiles.png"}])");
      object.scene[object.at] = variant.at("examples").at(0);
      cases.push_back(object);
    }
  }
  Json::json_pointer rotation("/instances/0/transform/rotate");
  cases.push_back({schema().root()["$defs"]["rotation"], base, rotation});
  cases.back().scene["instances"] = Json::parse(R"([{"group": "example"}])");
  cases.back().scene[rotation] = Json::parse(R"({"axis": [0, 1, 0], "angle": 45})");
  cases.push_back({schema().root(), base, Json::json_pointer()});
  return cases;
}

/// Depends on every value and its place.
template <typename Number>
double checksum(const std::vector<Number> &numbers) {
  double sum = static_cast<double>(numbers.size());
  for (const Number number : numbers) sum = sum * 0.999 + static_cast<double>(number);
  return sum;
}

std::vector<std::string> keys_of(const Json &object) {
  std::vector<std::string> keys;
  for (const auto &[key, value] : object.items()) keys.push_back(key);
  return keys;  // sorted
}

/// The keys that the reader names when it meets one that it does not know.
std::vector<std::string> keys_known_to_reader(const ObjectCase &object) {
  Json scene = object.scene;
  scene[object.at]["zzzzzzzz"] = 0;
  const std::string errors = errors_in_scene(scene.dump());
  const std::string marker = "known keys: ";
  const std::size_t start = errors.find(marker);
  REQUIRE_MESSAGE(start != std::string::npos, errors);
  std::string list = errors.substr(start + marker.size());
  list = list.substr(0, list.find('\n')) + ", ";
  Json keys = Json::object();
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = list.find(", ", at);
    keys[list.substr(at, end - at)] = 0;
    at = end + 2;
  }
  return keys_of(keys);
}

}  // namespace

TEST_CASE("schema: valid scenes are valid and every example of the schema is read") {
  for (const Json &scene : valid_scenes()) CHECK(schema().accepts(scene));
  CHECK(schema().accepts(Json::parse(R"({"version": 1})")));
  for (const ObjectCase &object : object_cases()) {
    CAPTURE(object.scene.dump());
    CHECK(schema().accepts(object.scene));
    CHECK(errors_in_scene(object.scene.dump()) == "");
  }
}

TEST_CASE(
    "schema: every key of the schema is known to the reader and every key of the reader to the "
    "schema") {
  const std::vector<ObjectCase> cases = object_cases();
  CHECK(cases.size() >= 34);
  for (const ObjectCase &object : cases) {
    CAPTURE(object.scene[object.at].dump());
    std::vector<std::string> described = keys_of(object.schema["properties"]);
    if (object.at.to_string() == "/instances/0/transform") {
      described = {"matrix", "rotate", "scale", "translate"};  // the schema has one object for each
    } else if (object.scene[object.at].value("type", "") == "mesh") {
      described = {"colours", "file",      "indices",   "material", "normals",
                   "positions", "transform", "type",     "uvs"};  // two objects
    }
    CHECK(keys_known_to_reader(object) == described);
  }
}

TEST_CASE("schema: the valid scenes use every key of the schema") {
  Json used;
  for (const Json &scene : valid_scenes())
    for_each_value(scene, Json::json_pointer(),
                   [&](const Json::json_pointer &at) { used[at.back()] = 0; });
  for (const ObjectCase &object : object_cases()) {
    for (const std::string &key : keys_of(object.schema["properties"])) {
      CAPTURE(key);
      CHECK(used.contains(key));
    }
  }
}

/// Keys that must be there where `key` is.
Json needed_with(const Json &schema, const std::string &key) {
  return schema.value("dependentRequired", Json::object()).value(key, Json::array());
}

TEST_CASE("schema: the limits and needed keys of the schema are those of the reader") {
  int num_limits = 0;
  for (const ObjectCase &object : object_cases()) {
    for (const auto &[key, property] : object.schema["properties"].items()) {
      const Json &rule = schema().resolve(property);
      const std::string place = (object.at / key).to_string();
      CAPTURE(place);
      const auto is_read = [&](const Json &value) {
        Json scene = object.scene;
        scene[object.at][key] = value;
        for (const Json &with : needed_with(object.schema, key))
          scene[object.at].emplace(with.get<std::string>(), value);
        const std::string errors = errors_without_generating(scene);
        return errors.empty() || is_beyond_schema(errors);
      };
      const auto check_limit = [&](const char *keyword, double outwards, bool included) {
        if (!rule.contains(keyword)) return;
        num_limits++;
        const double limit = rule[keyword].get<double>();
        const bool whole = rule["type"] == "integer";
        const double outside = whole ? limit + outwards : std::nextafter(limit, outwards * 1e300);
        const double inside = whole ? limit - outwards : std::nextafter(limit, -outwards * 1e300);
        CHECK(is_read(limit) == included);
        CHECK(!is_read(outside));
        CHECK(is_read(inside));
      };
      check_limit("minimum", -1, true);
      check_limit("maximum", 1, true);
      check_limit("exclusiveMaximum", 1, false);
      if (rule.contains("enum")) {
        for (const Json &name : rule["enum"]) CHECK(is_read(name));
      }
    }
    for (const std::string &key : keys_of(object.scene[object.at])) {
      Json scene = object.scene;
      scene[object.at].erase(key);
      check_agreement(scene);
    }
  }
  CHECK(num_limits > 80);
}

TEST_CASE("schema: writing out the defaults changes nothing") {
  const auto facts = [](const Json &scene) {
    Diagnostics diagnostics;
    const SceneDescription read =
        parse_scene_text(scene.dump(), "", source_path("tests/scene/valid"), diagnostics);
    CHECK(errors_of(diagnostics) == "");
    Json all;
    const CameraDescription &camera = read.camera;
    all["camera"] = {camera.position,       camera.look_at,         camera.up,
                     camera.fov,            camera.aperture_radius, camera.focus_distance,
                     camera.kind,           camera.blades,          camera.blade_rotation,
                     camera.height,         camera.angle};
    const FilmDescription &film = read.film;
    all["film"] = {film.width,        film.height, film.filter,  film.filter_radius,
                   film.filter_sigma, film.crop,   film.exposure};
    all["sampler"] = {read.sampler.kind, read.sampler.spp, read.sampler.seed};
    all["integrator"] = {read.integrator.max_depth, read.integrator.roulette_depth,
                         read.integrator.light_choice, read.integrator.light_points};
    for (const LightDescription &light : read.lights) {
      all["lights"].push_back({light.kind, light.emission, light.position, light.direction,
                               light.inner_angle, light.outer_angle, light.angular_diameter,
                               light.profile_intensity, light.horizontal});
    }
    if (const auto &sky = read.sky) {
      all["sky"] = {sky->turbidity, sky->sun_direction, sky->ground_albedo,
                    sky->angular_diameter, sky->sun, sky->scale};
    }
    for (const TextureDescription &texture : read.textures) {
      all["textures"].push_back({texture.kind, texture.a, texture.b, texture.channel,
                                 texture.to_texture, texture.srgb, texture.wrap_u, texture.wrap_v,
                                 texture.nearest, texture.scale, texture.turbulence,
                                 texture.octaves});
    }
    for (const MaterialDescription &material : read.materials) {
      all["materials"].push_back({material.kind, material.reflectance, material.has_ior,
                                  material.eta, material.k, material.roughness, material.ior,
                                  material.emission, material.two_sided, material.anisotropic,
                                  material.multiple_scattering, material.specular,
                                  material.transmittance, material.opacity,
                                  material.normal_scale, material.bump_scale, material.exponent,
                                  material.has_absorption, material.absorption,
                                  material.azimuthal_roughness, material.tilt,
                                  material.specular_level, material.metallic,
                                  material.transmission, material.clearcoat,
                                  material.clearcoat_roughness, material.sheen,
                                  material.sheen_roughness, material.blend_a, material.blend_b,
                                  material.weight, material.is_null, material.one_sided});
    }
    for (const ShapeDescription &shape : read.shapes) {
      if (const auto *mesh = std::get_if<MeshShape>(&shape.shape)) {
        all["shapes"].push_back({checksum(mesh->data.positions), checksum(mesh->data.indices)});
      } else if (const auto *spheres = std::get_if<SpheresShape>(&shape.shape)) {
        all["shapes"].push_back(spheres->spheres);
      } else if (const auto *curves = std::get_if<CurvesShape>(&shape.shape)) {
        std::vector<double> numbers;
        for (const auto &point : curves->points)
          numbers.insert(numbers.end(), point.begin(), point.end());
        all["shapes"].push_back({checksum(numbers), checksum(curves->sizes)});
      }
    }
    return all;
  };
  for (const ObjectCase &object : object_cases()) {
    for (const auto &[key, property] : object.schema["properties"].items()) {
      if (!property.contains("default") || object.scene[object.at].contains(key)) continue;
      if (object.at.empty() && key == "film") continue;
      Json scene = object.scene;
      scene[object.at][key] = property["default"];
      CAPTURE(scene.dump());
      CHECK(facts(scene) == facts(object.scene));
    }
  }
}

TEST_CASE("schema: the reader and the schema agree about every mutant of a scene with every key") {
  const std::vector<Json> replacements = {nullptr,
                                          true,
                                          "text",
                                          "",
                                          -1,
                                          0,
                                          0.5,
                                          1,
                                          3,
                                          65536.5,
                                          1e30,
                                          -1e30,
                                          4e18,
                                          Json::array(),
                                          Json::object(),
                                          Json::parse("[0, 0, 0]"),
                                          Json::parse("[[1, 2, 3]]"),
                                          Json::parse(R"([{"type": "disk"}])"),
                                          Json::parse(R"({"name": 1})")};
  int num_mutants = 0;
  const auto check_mutant = [&](const Json &mutant) {
    check_agreement(mutant);
    num_mutants++;
  };
  for (const Json &original : valid_scenes()) {
    for_each_value(original, Json::json_pointer(), [&](const Json::json_pointer &at) {
      for (const Json &replacement : replacements) {
        Json mutant = original;
        mutant[at] = replacement;
        check_mutant(mutant);
      }
      Json mutant = original;
      Json &parent = mutant[at.parent_pointer()];
      if (parent.is_array()) {
        parent.erase(std::stoul(at.back()));
        check_mutant(mutant);
        mutant = original;
        mutant[at.parent_pointer()].push_back(original[at]);
        check_mutant(mutant);
      } else {
        parent.erase(at.back());
        check_mutant(mutant);
      }
    });
  }
  CHECK(num_mutants >= 2000);
  MESSAGE(num_mutants << " mutants");
}

TEST_CASE("schema: every misspelt key is reported at its place with the key that was meant") {
  const Json original = everything();
  int num_keys = 0;
  for_each_value(original, Json::json_pointer(), [&](const Json::json_pointer &at) {
    if (original[at.parent_pointer()].is_array() || at.back().size() < 3) return;
    std::string misspelt = at.back();
    std::swap(misspelt[1], misspelt[2]);
    if (misspelt == at.back()) misspelt += 'x';
    Json mutant = original;
    Json &parent = mutant[at.parent_pointer()];
    parent[misspelt] = parent[at.back()];
    parent.erase(at.back());
    Diagnostics diagnostics;
    parse_scene_text(mutant.dump(), "scene.json", source_path("tests/scene/valid"), diagnostics);
    const std::string place = (at.parent_pointer() / misspelt).to_string();
    const std::string message = "unknown key '" + misspelt + "'",
                      remedy = "did you mean '" + at.back() + "'?";
    bool reported = false;
    for (const Problem &problem : diagnostics.errors()) {
      reported |= problem.json_path == place && problem.message.find(message) == 0 &&
                  problem.message.find(remedy) != std::string::npos;
    }
    CAPTURE(place);
    CAPTURE(errors_of(diagnostics));
    CHECK(reported);
    num_keys++;
  });
  CHECK(num_keys > 140);
}

TEST_CASE("schema: a scene cut anywhere or changed in any byte does not crash") {
  const std::string text = read_text(source_path("tests/scene/valid/everything.json"));
  for (std::size_t length = 0; length + 2 < text.size(); length += 7)
    CHECK(errors_in_scene(text.substr(0, length)) != "");
  unsigned state = 1;
  for (int i = 0; i < 1000; i++) {
    state = state * 1664525u + 1013904223u;
    std::string changed = text;
    changed[(state >> 8) % text.size()] = static_cast<char>(state >> 24);
    Diagnostics diagnostics;
    parse_scene_text(changed, "scene.json", source_path("tests/scene/valid"), diagnostics);
  }
}
