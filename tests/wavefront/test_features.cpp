// Every feature that a scene can have, in a small scene of its own: all schedules give the same picture.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "support/scenes.h"

using namespace phalanx;
using namespace phalanx::test;
using Json = nlohmann::json;

namespace {

/// A floor, a ball of material "m", a box behind it, a lamp.
Json base_scene() {
  return Json::parse(R"({
    "version": 1,
    "camera": {"position": [0, 1.2, 4], "look_at": [0, 0.7, 0], "fov": 40},
    "film": {"width": 32, "height": 32},
    "sampler": {"spp": 8},
    "integrator": {"max_depth": 6},
    "textures": [
      {"name": "checks", "type": "checker", "a": 0.1, "b": 0.9, "transform": {"scale": [8, 4]}},
      {"name": "veins", "type": "marble", "a": [0.9, 0.8, 0.7], "b": [0.1, 0.2, 0.3], "scale": 3, "turbulence": 2},
      {"name": "grain", "type": "noise", "a": 0, "b": 1, "scale": 9}
    ],
    "materials": [
      {"name": "grey", "type": "diffuse", "reflectance": 0.6},
      {"name": "red", "type": "diffuse", "reflectance": [0.7, 0.2, 0.1]},
      {"name": "lamp", "type": "black", "emission": 12},
      {"name": "m", "type": "diffuse", "reflectance": 0.5}
    ],
    "lights": [],
    "shapes": [
      {"type": "quad", "material": "grey", "corner": [-4, 0, 4], "edge_u": [8, 0, 0], "edge_v": [0, 0, -8]},
      {"type": "box", "material": "red", "lo": [-1.8, 0, -2], "hi": [1.8, 1.6, -1.6]},
      {"type": "quad", "material": "lamp", "corner": [-0.6, 3, -0.4], "edge_u": [1.2, 0, 0], "edge_v": [0, 0, 1.2]},
      {"type": "sphere", "material": "m", "center": [0, 0.7, 0], "radius": 0.7}
    ]})");
}

/// Applies a JSON merge patch (RFC 7396); "m" replaces the ball's material.
Json with(const char *patch) {
  Json scene = base_scene(), change = Json::parse(patch);
  if (change.contains("m")) {
    scene["materials"][3] = change["m"];
    scene["materials"][3]["name"] = "m";
    change.erase("m");
  }
  scene.merge_patch(change);
  return scene;
}

RenderOptions by(Mode mode) {
  RenderOptions o;
  o.mode = mode;
  o.threads = 1;
  o.aovs = true;
  return o;
}

double largest_difference(const Film &a, const Film &b) {
  double worst = 0;
  for (std::int64_t i = 0; i < a.num_pixels(); ++i) {
    const Vec3 x = a.mean(i), d = abs3(x - b.mean(i));
    worst = std::max(worst, double(max_component(d)) / std::max(1.0, double(max_component(abs3(x)))));
  }
  return worst;
}

double mean_of(const Film &film) {
  double sum = 0;
  for (std::int64_t i = 0; i < film.num_pixels(); ++i) sum += double(film.mean(i).y);
  return sum / double(film.num_pixels());
}

void check_schedules(const Json &json) {
  const std::string text = json.dump();
  CAPTURE(text);
  for (const std::string &isa : isas_here()) {
    CAPTURE(isa);
    const BuiltScene scene = build_text(text, isa);
    const RenderResult expected = render_scene(scene, by(Mode::kDepthFirst));
    const RenderResult wavefront = render_scene(scene, by(Mode::kWavefront));
    CHECK(pixels_that_differ(wavefront.film, expected.film) == 0);
    CHECK(wavefront.stats.rays.total() == expected.stats.rays.total());
    CHECK(pixels_that_differ(render_scene(scene, by(Mode::kMegakernel)).film, expected.film) == 0);
    CHECK(largest_difference(render_scene(scene, by(Mode::kRecursive)).film, expected.film) < 1e-4);
    CHECK(expected.stats.invalid.count == 0);
    CHECK(mean_of(expected.film) > 1e-3);
  }
}

}  // namespace

TEST_CASE("features: every material in every schedule") {
  for (const char *patch :
       {R"({"m": {"type": "rough_diffuse", "roughness": 0.8}})",
        R"({"m": {"type": "diffuse", "reflectance": "veins"}})",
        R"({"m": {"type": "diffuse", "one_sided": true, "opacity": "checks"}})",
        R"({"m": {"type": "conductor", "metal": "gold", "roughness_x": 0.1, "roughness_y": 0.5}})",
        R"({"m": {"type": "conductor", "metal": "copper", "roughness": 0.8, "multiple_scattering": true}})",
        R"({"m": {"type": "conductor", "roughness": "checks"}})",
        R"({"m": {"type": "dielectric", "roughness": 0.3}})",
        R"({"m": {"type": "dielectric", "roughness": 0.3, "transmittance": [0.3, 0.9, 0.5]}})",
        R"({"m": {"type": "thin_dielectric"}})", R"({"m": {"type": "coated_diffuse"}})",
        R"({"m": {"type": "coated_diffuse", "roughness": 0.4, "bump_map": "grain", "bump_scale": 0.02}})",
        R"({"m": {"type": "principled", "metallic": 0.4, "roughness": 0.3, "clearcoat": 1, "sheen_color": 0.4}})",
        R"({"m": {"type": "principled", "transmission": 0.7, "roughness": 0.2}})",
        R"({"m": {"type": "phong", "exponent": 30}})", R"({"m": {"type": "blinn_phong", "exponent": 30}})",
        R"({"m": {"type": "hair"}})", R"({"m": {"type": "blend", "a": "grey", "b": "red", "weight": "grain"}})",
        R"({"m": {"type": "black", "emission": "veins"}})"})
    check_schedules(with(patch));
}

TEST_CASE("features: every light in every schedule") {
  for (const char *patch :
       {R"({"lights": [{"type": "point", "position": [1, 2, 2], "intensity": 5}]})",
        R"({"lights": [{"type": "spot", "position": [1, 3, 2], "direction": [-1, -3, -2], "intensity": 9}]})",
        R"({"lights": [{"type": "directional", "direction": [-1, -3, -2], "irradiance": 2}]})",
        R"({"lights": [{"type": "sun", "sun_elevation": 50, "irradiance": 2, "angular_diameter": 8}]})",
        R"({"lights": [{"type": "sky", "sun_elevation": 40, "scale": 0.05}]})",
        R"({"integrator": {"light_choice": "uniform"}})", R"({"integrator": {"light_choice": "tree"}})",
        R"({"integrator": {"light_points": "solid_angle"}})"})
    check_schedules(with(patch));
}

TEST_CASE("features: every camera, sampler and integrator in every schedule") {
  for (const char *patch :
       {R"({"camera": {"type": "orthographic", "height": 3, "fov": null}})",
        R"({"camera": {"type": "equirectangular", "fov": null}})",
        R"({"camera": {"type": "fisheye", "angle": 200, "fov": null}})",
        R"({"camera": {"type": "thin_lens", "aperture_radius": 0.1, "blades": 5}})",
        R"({"sampler": {"type": "stratified"}})", R"({"sampler": {"type": "halton"}})",
        R"({"sampler": {"type": "blue_noise"}})", R"({"sampler": {"type": "independent"}})",
        R"({"integrator": {"type": "direct", "max_depth": null}})",
        R"({"integrator": {"type": "ambient_occlusion", "max_depth": null, "distance": 1.5}})",
        R"({"integrator": {"type": "normal", "max_depth": null}})",
        R"({"integrator": {"type": "albedo", "max_depth": null}})",
        R"({"integrator": {"type": "uv", "max_depth": null}})",
        R"({"integrator": {"type": "material", "max_depth": null}})"})
    check_schedules(with(patch));
}

TEST_CASE("features: ambient occlusion of a plane is 1, and of a plane below a ceiling 0") {
  Json scene = with(R"({"integrator": {"type": "ambient_occlusion", "max_depth": null}, "lights": []})");
  scene["camera"] = Json::parse(R"({"position": [0, 1, 0], "look_at": [0, 0, 0.001], "fov": 20})");
  scene["shapes"].erase(3);
  scene["shapes"].erase(2);
  scene["shapes"].erase(1);
  const std::string isa = isas_here().back();
  CHECK(mean_of(render_scene(build_text(scene.dump(), isa), by(Mode::kWavefront)).film) == 1.0);
  scene["shapes"].push_back(Json::parse(
      R"({"type": "quad", "material": "grey", "corner": [-400, 2, 400], "edge_u": [800, 0, 0], "edge_v": [0, 0, -800]})"));
  CHECK(mean_of(render_scene(build_text(scene.dump(), isa), by(Mode::kWavefront)).film) < 1e-4);
  scene["integrator"]["distance"] = 1.5;  // the ceiling is farther than that
  CHECK(mean_of(render_scene(build_text(scene.dump(), isa), by(Mode::kWavefront)).film) == 1.0);
}

TEST_CASE("features: bumps of a texture in space turn with their instance") {
  // What is seen, the lamp and the camera turn together by 90 degrees: the picture stays.
  Json scene = Json::parse(R"({
    "version": 1,
    "camera": {"position": [1, 0, 4], "look_at": [0, 0, 0], "fov": 30},
    "film": {"width": 32, "height": 32}, "sampler": {"spp": 16}, "integrator": {"max_depth": 1},
    "textures": [{"name": "grain", "type": "noise", "a": 0, "b": 1, "scale": 3, "octaves": 1}],
    "materials": [{"name": "m", "type": "diffuse", "reflectance": 0.5, "bump_map": "grain", "bump_scale": 0.4}],
    "lights": [{"type": "point", "position": [3, 4, 5], "intensity": 50}],
    "shapes": [],
    "groups": [{"name": "ball", "shapes": [{"type": "icosphere", "material": "m", "subdivisions": 5}]}],
    "instances": [{"group": "ball", "transform": [{"scale": [1.2, 0.8, 1]}]}]})");
  const auto picture = [&] {
    return render_scene(build_text(scene.dump(), isas_here().back()), by(Mode::kWavefront)).film;
  };
  const Film straight = picture();
  scene["camera"]["position"] = {4, 0, -1};
  scene["lights"][0]["position"] = {5, 4, -3};
  scene["instances"][0]["transform"] =
      Json::parse(R"([{"scale": [1.2, 0.8, 1]}, {"rotate": {"axis": [0, 1, 0], "angle": 90}}])");
  const Film turned = picture();
  scene["materials"][0]["bump_scale"] = 0;
  const Film smooth = picture();
  const auto difference = [](const Film &a, const Film &b) {
    double sum = 0;
    for (std::int64_t i = 0; i < a.num_pixels(); ++i) sum += double(abs3(a.mean(i) - b.mean(i)).y);
    return sum / double(a.num_pixels()) / mean_of(a);
  };
  CHECK(difference(straight, turned) < 2e-3);
  CHECK(difference(smooth, turned) > 0.05);
}

TEST_CASE("features: light that crosses a long thin strand is not lost") {
  // White hair under an even sky is not seen: one event sends light on, and nothing is in its way.
  const Json scene = Json::parse(R"({
    "version": 1,
    "camera": {"type": "orthographic", "height": 0.1, "position": [0, 0, 3], "look_at": [0, 0, 0]},
    "film": {"width": 16, "height": 16}, "sampler": {"spp": 64},
    "integrator": {"max_depth": 1},
    "materials": [{"name": "m", "type": "hair", "absorption": 0}],
    "lights": [{"type": "environment", "radiance": 1}],
    "shapes": [{"type": "curves", "material": "m", "radius": 0.06, "strands": [[[0, -60, 0], [0, 60, 0]]]}]})");
  const RenderResult r =
      render_scene(build_text(scene.dump(), isas_here().back()), by(Mode::kWavefront));
  CHECK(std::fabs(mean_of(r.film) - 1) < 0.01);
}

TEST_CASE("features: a mirrored quad shows its texture mirrored") {
  Json scene = Json::parse(R"({
    "version": 1,
    "camera": {"type": "orthographic", "height": 2, "position": [0, 0, 3], "look_at": [0, 0, 0]},
    "film": {"width": 16, "height": 16, "filter": {"type": "box"}}, "sampler": {"spp": 1},
    "integrator": {"type": "albedo"},
    "textures": [{"name": "checks", "type": "checker", "a": 0.1, "b": 0.9, "transform": {"scale": [2, 1]}}],
    "materials": [{"name": "m", "type": "diffuse", "reflectance": "checks"}],
    "shapes": [{"type": "quad", "material": "m", "corner": [-1, -1, 0], "edge_u": [2, 0, 0], "edge_v": [0, 2, 0]}]})");
  const auto picture = [&] {
    return render_scene(build_text(scene.dump(), isas_here().back()), by(Mode::kWavefront)).film;
  };
  const Film straight = picture();
  scene["shapes"][0]["transform"] = Json::parse(R"([{"scale": [-1, 1, 1]}])");
  const Film mirrored = picture();
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      CHECK(straight.mean(16 * y + x).x == (x < 8 ? 0.1f : 0.9f));
      CHECK(mirrored.mean(16 * y + x).x == (x < 8 ? 0.9f : 0.1f));
    }
}

TEST_CASE("features: opacity lets light through in proportion, for the eye and for lamps") {
  // A black sheet of opacity 0.3 before a lamp that fills the view.
  const Json scene = Json::parse(R"({
    "version": 1,
    "camera": {"position": [0, 0, 3], "look_at": [0, 0, 0], "fov": 10},
    "film": {"width": 16, "height": 16}, "sampler": {"spp": 256},
    "materials": [{"name": "lamp", "type": "black", "emission": 1},
                  {"name": "sheet", "type": "black", "opacity": 0.3}],
    "shapes": [{"type": "quad", "material": "lamp", "corner": [-5, -5, 0], "edge_u": [10, 0, 0], "edge_v": [0, 10, 0]},
               {"type": "quad", "material": "sheet", "corner": [-5, -5, 1], "edge_u": [10, 0, 0], "edge_v": [0, 10, 0]}]})");
  const RenderResult r =
      render_scene(build_text(scene.dump(), isas_here().back()), by(Mode::kWavefront));
  CHECK(std::fabs(mean_of(r.film) - 0.7) < 4 * std::sqrt(0.21 / (256.0 * 256.0)));
}
