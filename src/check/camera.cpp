// Cameras and pictures at the ends of their ranges.
#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "../core/error.h"
#include "../plan/plan.h"
#include "../scene/scene_file.h"
#include "case.h"
#include "groups.h"
#include "temporary.h"

namespace phalanx::check {
namespace {

SceneText sky_only(const std::string &camera) {
  SceneText scene;
  scene.camera = camera;
  scene.lights = {kSky};
  return scene;
}

SceneText still_life() {
  SceneText scene;
  scene.width = 13;
  scene.height = 9;
  scene.camera = camera({0, 1, 4}, {0, 0.5, 0}, 40, {0, 1, 0});
  scene.lights = {kSky};
  scene.materials = {material("metal", "conductor", R"("reflectance": 0.8, "alpha": 0.2)")};
  scene.shapes = {level("grey", 3, 0), sphere("metal", {0, 0.5, 0}, 0.5)};
  return scene;
}

void angles_of_view(Case &c) {
  for (const double fov : {1e-6, 1e-4, 1.0, 179.99})
    c.exact_radiance(fmt::format("{:g} degrees under a white sky", fov), sky_only(camera({0, 0, 0}, {1, 2, 3}, fov, {0, 1, 0})), 1);
  for (const char *fov : {"0", "180", "-1", "1e999"})
    c.rejects(fmt::format("an angle of {} degrees", fov), fmt::format(R"({{"version": 1, "camera": {{"fov": {}}}}})", fov), "fov");
}

void cameras_without_direction(Case &c) {
  struct Bad {
    const char *what, *keys;
  };
  for (const Bad &bad : {Bad{"up along the view", R"("position": [0,5,0], "look_at": [0,0,0], "up": [0,1,0])"},
                         Bad{"up against the view", R"("position": [0,5,0], "look_at": [0,0,0], "up": [0,-3,0])"},
                         Bad{"up of length 0", R"("position": [0,0,5], "look_at": [0,0,0], "up": [0,0,0])"},
                         Bad{"a camera that looks at itself", R"("position": [1,2,3], "look_at": [1,2,3])"}})
    c.rejects(bad.what, fmt::format(R"({{"version": 1, "camera": {{{}}}}})", bad.keys), "/camera");
  // Nearly: still a picture.
  SceneText scene = sky_only(camera({0, 5, 0}, {0, 0, 0}, 40, {0, 1, 1e-5}));
  c.exact_radiance("up 1e-5 off the view", scene, 1);
}

void lenses(Case &c) {
  SceneText lens = still_life(), pinhole = still_life();
  lens.camera += R"(, "type": "thin_lens", "aperture_radius": 0)";
  c.same_bits("a lens of radius 0 and a pinhole", lens, pinhole);
  for (const char *keys : {R"("type": "thin_lens", "aperture_radius": 0.1, "focus_distance": 0)",
                           R"("type": "thin_lens", "aperture_radius": 0.1, "focus_distance": -1)",
                           R"("type": "thin_lens", "aperture_radius": -1)", R"("type": "thin_lens", "aperture_radius": 1e999)"})
    c.rejects(keys, fmt::format(R"({{"version": 1, "camera": {{{}}}}})", keys), "/camera");
  SceneText wide = sky_only(camera({0, 0, 0}, {0, 0, -1}, 40, {0, 1, 0}));
  wide.camera += R"(, "type": "thin_lens", "aperture_radius": 1e6, "focus_distance": 1e-6)";
  c.exact_radiance("a lens of 1e6 m focused at 1e-6 m", wide, 1);
}

void sizes(Case &c) {
  for (const auto &[width, height] : {std::pair{1, 1}, {1, 37}, {41, 1}, {3, 5}}) {
    SceneText scene = still_life();
    scene.width = width;
    scene.height = height;
    Stage stage = c.stage(scene);
    for (const std::string &isa : c.isas()) {
      RenderOptions options;
      options.isa = isa;
      options.spp = 8;
      options.mode = c.mode();
      const Film one = c.render(stage, options).film;
      options.threads = 7;
      options.tile_size = 1;
      c.equal(with_isa(c, fmt::format("{} x {} on 7 threads: pixels that differ", width, height), isa),
              static_cast<double>(pixels_that_differ(c.render(stage, options).film, one)), 0);
      c.at_least(with_isa(c, fmt::format("{} x {}: mean", width, height), isa), measure(one).mean, 0.01);
    }
  }
  for (const char *width : {"0", "-1", "2147483648", "1.5"})
    c.rejects(fmt::format("a width of {}", width), fmt::format(R"({{"version": 1, "film": {{"width": {}}}}})", width), "width");
}

void windows(Case &c) {
  Stage stage = c.stage(still_life());
  for (const std::string &isa : c.isas()) {
    RenderOptions options;
    options.isa = isa;
    options.spp = 16;
    options.mode = c.mode();
    const Film whole = c.render(stage, options).film;
    std::int64_t different = 0;
    for (int y = 0; y < 9; y += 4)
      for (int x = 0; x < 13; x += 4) {
        options.crop = {x, y, 1, 1};
        const Film window = c.render(stage, options).film;
        const Vec3 a = window.mean(0), b = whole.mean(y * 13 + x);
        different += a.x != b.x || a.y != b.y || a.z != b.z;
      }
    c.equal(with_isa(c, "windows of one pixel that differ from the whole, of 12", isa), static_cast<double>(different), 0);
    options.crop = {12, 8, 2, 1};
    bool refused = false;
    try {
      c.render(stage, options);
    } catch (const InputError &) {
      refused = true;
    }
    c.holds(with_isa(c, "a window beyond the picture is refused", isa), refused);
  }
}

void textures(Case &c) {
  const TemporaryFolder folder;
  const auto with = [](const std::string &texture) {
    SceneText scene = still_life();
    scene.textures = {texture};
    scene.materials.push_back(material("m", "diffuse", R"("reflectance": "t")"));
    scene.shapes = {level("m", 3, 0)};
    return scene;
  };
  const auto image = [](const std::string &file, const char *more = "") {
    return fmt::format(R"({{"name": "t", "type": "image", "file": "{}"{}}})", file, more);
  };
  const std::string constant = R"({"name": "t", "type": "constant", "colour": 0.25})";
  const std::string one = folder.picture("one.exr", 1, 1, [](int, int) { return 0.25f; });
  const std::string row = folder.picture("row.exr", 65536, 1, [](int, int) { return 0.25f; });
  const std::string broken = folder.picture("nan.exr", 2, 2, [](int x, int) { return x == 0 ? std::numeric_limits<float>::quiet_NaN() : 0.5f; });
  c.same_bits("an image of 1 x 1 and a constant", with(image(one)), with(constant));
  c.same_bits("without interpolation", with(image(one, R"(, "filter": "nearest")")), with(constant));
  c.same_bits("an image of 65536 x 1 and a constant", with(image(row)), with(constant));
  c.rejects("an image with NaN", with(image(broken)).text(), "finite");
  c.rejects("an image that is not there", with(image("missing.png")).text(), "missing.png");
  const Image written = make_image(0, 0);
  bool refused = false;
  try {
    write_image(one, written, 0);
    read_image(one);
  } catch (const std::exception &) {
    refused = true;
  }
  c.holds("an image of 0 x 0 is refused", refused);
  const std::string bright = folder.picture("bright.exr", 1, 1, [](int, int) { return 1e30f; });
  c.equal("1e30 in an EXR file, read again", static_cast<double>(read_image(bright).channels[0].values[0]), static_cast<double>(1e30f));
  c.remark("EXR files hold 32-bit floats, so that nothing overflows to half precision's infinity");
}

void numbers_of_samples(Case &c) {
  const auto warnings = [](const char *sampler, int spp) {
    Diagnostics diagnostics;
    parse_scene_text(fmt::format(R"({{"version": 1, "sampler": {{"type": "{}", "spp": {}}}}})", sampler, spp), "check", ".", diagnostics);
    diagnostics.throw_if_errors();
    return static_cast<double>(diagnostics.warnings().size());
  };
  c.equal("warnings of sobol with 1000 samples", warnings("sobol", 1000), 1);
  c.equal("warnings of sobol with 1024 samples", warnings("sobol", 1024), 0);
  c.equal("warnings of stratified with 1000 samples", warnings("stratified", 1000), 0);
  for (const int spp : {1, 3, 1000}) {
    SceneText scene = sky_only(camera({0, 0, 5}, {0, 0, 0}, 40, {0, 1, 0}));
    scene.shapes = {level("lamp", 2, 0)};
    Stage stage = c.stage(scene);
    for (const std::string &isa : c.isas()) {
      const Film film = c.film(stage, spp, isa);
      c.equal(with_isa(c, fmt::format("samples of a pixel, {} asked for", spp), isa), static_cast<double>(film.sample_count(0)), spp);
      c.near(with_isa(c, "a scene of radiance 1", isa), measure(film).mean, 1, 1e-7);
    }
  }
}

void places_of_cameras(Case &c) {
  const SceneText scene = still_life();
  const SceneDescription good = c.stage(scene).description();
  for (const double bad : {std::nan(""), HUGE_VAL}) {
    for (const char *what : {"position", "look_at", "up"}) {
      SceneDescription description = good;
      Double3 &v = what[0] == 'p' ? description.camera.position : what[0] == 'l' ? description.camera.look_at : description.camera.up;
      v[1] = bad;
      c.rejects(fmt::format("{} with {}", what, bad), description, "/camera");
    }
  }
  SceneText inside = still_life();
  inside.shapes = {R"({"type": "box", "material": "grey"})"};
  inside.camera = camera({0, 0, 0}, {0, 0, -1}, 60, {0, 1, 0});
  c.exact_radiance("inside a closed box under a white sky", inside, 0);
  SceneText on = still_life();
  on.camera = camera({0, 0, 2}, {0, 0, 0}, 40, {0, 1, 0});
  c.bounded_radiance("on the floor, looking along it", on, 64, 0.01, 2);
  on.camera = camera({0, 1, 0}, {0, 5, 0.1}, 40, {0, 0, 1});
  c.exact_radiance("on a ball, looking up", on, 1);
  on.camera = camera({0, 0.5, 0}, {0, 0.5, -1}, 40, {0, 1, 0});
  c.bounded_radiance("inside a metal ball", on, 64, 0, 1);
}

}  // namespace

Group camera_group() {
  return {"camera",
          {{"C1", "angles of view from 1e-6 to 179.99 degrees", angles_of_view},
           {"C2", "cameras without direction", cameras_without_direction},
           {"C3", "lenses of no size and no focus", lenses},
           {"C4", "pictures of one pixel, of one row, of none", sizes},
           {"C5", "windows of one pixel", windows},
           {"C6", "textures of one pixel, of 65536 in a row, of NaN", textures},
           {"C7", "numbers of samples that are no powers of two", numbers_of_samples},
           {"C8", "cameras inside, on and outside of everything", places_of_cameras}}};
}

}  // namespace phalanx::check
