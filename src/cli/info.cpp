// phalanx info: what is in a scene file, or in an image file.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "../core/error.h"
#include "../output/image_file.h"
#include "../scene/build.h"
#include "../scene/scene_file.h"
#include "../scene/stiffness.h"
#include "commands.h"
#include "text.h"

namespace phalanx {
namespace {

// ---- scenes ------------------------------------------------------------------------------------

std::int64_t num_triangles(const Scene &scene, GeometryRange range) {
  std::int64_t count = 0;
  for (int i = range.first; i < range.first + range.count; i++)
    if (scene.geometries[i].shape == kMesh) count += scene.num_prims[i];
  return count;
}

/// As a ray sees it: an instanced triangle counts once per instance.
std::int64_t num_visible_triangles(const Scene &scene) {
  std::int64_t count = num_triangles(scene, scene.top_level);
  for (const int group : scene.instance_group) count += num_triangles(scene, scene.groups[group]);
  return count;
}

std::string materials_by_kind(const Scene &scene) {
#define PHALANX_KIND(constant, name, density, transmits) #name,
  const char *const names[kNumMaterialKinds] = {PHALANX_MATERIAL_KINDS(PHALANX_KIND)};
#undef PHALANX_KIND
  std::string text;
  for (int kind = 0; kind < kNumMaterialKinds; kind++) {
    const auto count = std::count_if(scene.materials.begin(), scene.materials.end(),
                                     [&](const Material &m) { return m.kind == kind; });
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, names[kind]);
  }
  return text;
}

std::string bounds_text(const Scene &scene) {
  const Vec3 lo = scene.bounds_lo, hi = scene.bounds_hi;
  if (lo.x > hi.x) return "empty";
  return fmt::format("({:g}, {:g}, {:g}) to ({:g}, {:g}, {:g}) m", lo.x, lo.y, lo.z, hi.x, hi.y,
                     hi.z);
}

void print_scene(const SceneDescription &description, const Scene &scene) {
  const auto line = [](const char *name, const auto &value) {
    fmt::print("{:<24}{}\n", name, value);
  };
  line("scene", description.file);
  line("picture", fmt::format("{} x {} pixels, {} spp, depth {}", description.film.width,
                              description.film.height, description.sampler.spp,
                              description.integrator.max_depth));
  line("triangles", scene.triangles.size());
  line("vertices", scene.num_vertices());
  line("quads", scene.quads.size());
  line("spheres", scene.spheres.size());
  line("disks", scene.disks.size());
  if (!scene.curve_segments.empty()) line("curve segments", scene.curve_segments.size());
  line("instances", fmt::format("{} of {} groups", scene.instances.size(), scene.groups.size()));
  line("visible triangles", num_visible_triangles(scene));
  line("materials", fmt::format("{} ({})", scene.materials.size(), materials_by_kind(scene)));
  line("lights", scene.lights.size());
  line("environment", scene.has_environment
                          ? fmt::format("({:g}, {:g}, {:g}) W/sr/m^2", scene.environment.x,
                                        scene.environment.y, scene.environment.z)
                          : "none");
  line("bounds", bounds_text(scene));
  line("memory", text_of_bytes(scene.bytes()) + " without ray queries");
  for (const std::string &note : scene.notes) line("note", note);
  for (const Stiffness &stiff : find_stiffness(description, scene)) {
    line("stiff", stiff.what);
    line("", "-> " + stiff.remedy);
  }
}

int info_of_scene(const std::string &path) {
  Diagnostics diagnostics;
  const SceneDescription description = load_scene_file(path, diagnostics);
  diagnostics.throw_if_errors();
  const Scene scene = build_scene(description, diagnostics);
  diagnostics.throw_if_errors();
  print_scene(description, scene);
  for (const Problem &problem : diagnostics.warnings())
    fmt::print("{:<24}{}\n", "warning", problem.text());
  return kExitDone;
}

// ---- images ------------------------------------------------------------------------------------

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

struct Range {
  double min = kNothing, max = kNothing, sum = 0;  // of finite values
  std::int64_t finite = 0, nan = 0, inf = 0, negative = 0;
};

Range range_of(const std::vector<float> &values) {
  Range range;
  for (const float value : values) {
    if (std::isnan(value))
      range.nan++;
    else if (std::isinf(value))
      range.inf++;
    if (!std::isfinite(value)) continue;
    range.min = std::fmin(range.min, double{value});
    range.max = std::fmax(range.max, double{value});
    range.sum += double{value};
    range.negative += value < 0 ? 1 : 0;
    range.finite++;
  }
  return range;
}

void print_channel(const Channel &channel) {
  const Range range = range_of(channel.values);
  const double mean = range.finite ? range.sum / static_cast<double>(range.finite) : kNothing;
  fmt::print("{:<24}min {:<12.6g} mean {:<12.6g} max {:<12.6g} NaN {} Inf {} negative {}\n",
             channel.name, range.min, mean, range.max, range.nan, range.inf, range.negative);
}

int info_of_image(const std::string &path) {
  const Image image = read_image(path);
  fmt::print("{:<24}{}\n", "image", path);
  fmt::print("{:<24}{} x {} pixels", "size", image.width, image.height);
  if (image.width != image.full_width || image.height != image.full_height)
    fmt::print(" at ({}, {}) of {} x {}", image.x, image.y, image.full_width, image.full_height);
  fmt::print("\n");
  for (const Channel &channel : image.channels) print_channel(channel);
  for (const auto &[key, value] : image.metadata) fmt::print("{:<24}{}\n", key, value);
  return kExitDone;
}

}  // namespace

void add_info_command(CLI::App &app, int &exit_code) {
  auto path = std::make_shared<std::string>();
  CLI::App *sub = app.add_subcommand("info", "Describe a scene or an image");
  sub->add_option("FILE", *path, "Scene file, or image by extension .exr, .hdr or .png")
      ->required();
  sub->footer("Examples:\n  phalanx info scenes/cornell-box.json\n  phalanx info box.exr");
  sub->callback([path, &exit_code] {
    exit_code = is_image_path(*path) ? info_of_image(*path) : info_of_scene(*path);
  });
}

}  // namespace phalanx
