// phalanx replay: the path of one sample, vertex by vertex.
#include "../render/replay.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "../core/error.h"
#include "../wavefront/isa.h"
#include "commands.h"
#include "load_scene.h"
#include "picture_options.h"
#include "text.h"

namespace phalanx {
namespace {

struct ReplayCommand {
  std::string scene, pixel;
  int sample = 0;
  RenderOptions options;
};

std::string text_of(Vec3 v) { return fmt::format("({:.9g}, {:.9g}, {:.9g})", v.x, v.y, v.z); }

/// Shapes of the scene by name, materials as the file calls them.
struct Names {
  const SceneDescription &description;
  const Scene &scene;

  std::string of_material(int index) const {
    const auto i = static_cast<std::size_t>(index);
    if (index < 0 || i >= description.materials.size()) return "material " + std::to_string(index);
    return "'" + description.materials[i].name + "'";
  }
  std::string of_hit(const Hit &hit) const {
    static const char *const kShapes[] = {"triangle", "quad", "sphere", "disk", "piece of a strand"};
    const Geometry &g = scene.geometries[static_cast<std::size_t>(hit.geometry)];
    std::string text = fmt::format("{} {} of shape {}", kShapes[g.shape], hit.primitive, hit.geometry);
    if (hit.instance >= 0) text += fmt::format(" in instance {}", hit.instance);
    return text;
  }
};

void print_step(const PathStep &step, const Names &names) {
  const PathState &ray = step.ray;
  fmt::print("vertex {}\n", ray.depth);
  fmt::print("  ray from    {} towards {}\n", text_of(ray.origin), text_of(ray.direction));
  fmt::print("  throughput  {}, density {:.6g}{}\n", text_of(ray.throughput), ray.pdf,
             ray.pdf == 0 ? (ray.depth == 0 ? " (camera)" : " (delta)") : "");
  if (step.hit.geometry < 0) {
    fmt::print("  leaves the scene\n");
  } else {
    const Surface &s = step.surface;
    const int material = step.hit.material > 0 ? step.hit.material - 1 : s.material;
    fmt::print("  meets       {}, material {}, {}, after {:.9g} m\n", names.of_hit(step.hit), names.of_material(material),
               s.front != 0 ? "front" : "back", length(s.position - ray.origin));
    fmt::print("  at          {}, normal {}, offset {:.3g} m\n", text_of(s.position), text_of(s.normal), s.offset);
  }
  if (!is_black(step.emitted)) fmt::print("  emitted     {}\n", text_of(step.emitted));
  if (!is_black(step.shadow.contribution))
    fmt::print("  light       towards {}, {:.9g} m: {} {}\n", text_of(step.shadow.direction), step.shadow.distance,
               text_of(step.shadow.contribution), step.blocked ? "is blocked" : "arrives");
  if (step.hit.geometry >= 0 && step.next.depth < 0) fmt::print("  ends here\n");
  fmt::print("  sum so far  {}\n", text_of(step.radiance));
}

bool is_valid(Vec3 v) { return all_finite(v) && v.x >= 0 && v.y >= 0 && v.z >= 0; }

/// Prints how the schedule's sample compares with the sum; false where it must be equal and is not.
bool compare(const Replay &replay, const RenderOptions &options) {
  const std::string name = fmt::format("{}, {}", mode_name(options.mode), options.isa);
  fmt::print("sample        {}{}\n", text_of(replay.radiance), is_valid(replay.radiance) ? "" : ": invalid");
  if (!replay.rendered_is_valid || !is_valid(replay.radiance)) {
    const bool same = replay.rendered_is_valid == is_valid(replay.radiance);
    fmt::print("{:<13} {}\n", name, replay.rendered_is_valid ? text_of(replay.rendered) : "invalid, left out of the picture");
    fmt::print("{}\n", same ? "both are invalid" : "they differ");
    return same;
  }
  fmt::print("{:<13} {}\n", name, text_of(replay.rendered));
  if (options.mode != Mode::kRecursive) {
    const bool same = std::memcmp(&replay.rendered, &replay.radiance, sizeof(Vec3)) == 0;
    fmt::print("{}\n", same ? "the same bits" : "they differ");
    return same;
  }
  double difference = 0;
  for (const auto &[a, b] : {std::pair{replay.rendered.x, replay.radiance.x}, {replay.rendered.y, replay.radiance.y},
                             {replay.rendered.z, replay.radiance.z}}) {
    const double larger = std::fmax(static_cast<double>(a), static_cast<double>(b));
    if (larger > 0) difference = std::fmax(difference, std::fabs(static_cast<double>(a) - static_cast<double>(b)) / larger);
  }
  constexpr double kRounding = 1e-3;  // recursive sums from the far end
  fmt::print("relative difference {:.2g}: {}\n", difference, difference <= kRounding ? "rounding" : "they differ");
  return difference <= kRounding;
}

void read_pixel(const std::string &text, int &x, int &y) {
  int end = 0;
  if (std::sscanf(text.c_str(), "%d,%d%n", &x, &y, &end) != 2 || text.size() != static_cast<std::size_t>(end))
    throw InputError(fmt::format("--pixel: expected X,Y such as 100,50, found \"{}\"", text));
}

int run_replay(const ReplayCommand &command) {
  int x = 0, y = 0;
  read_pixel(command.pixel, x, y);
  RenderOptions options = command.options;
  options.isa = resolve_isa(options.isa);
  const auto [description, scene] = load_scene(command.scene);
  make_plan(description, scene, options);  // a bad frame is an error before the long part
  const Accel accel(scene, options.isa, options.threads);
  const Replay replay = replay_sample(scene, accel, description, options, x, y, command.sample);
  fmt::print("pixel ({}, {}), sample {} of {}\n", x, y, command.sample, command.scene);
  const Names names = {description, scene};
  for (const PathStep &step : replay.steps) print_step(step, names);
  return compare(replay, options) ? kExitDone : kExitBitsDiffer;
}

const char kExamples[] =
    "Examples:\n"
    "  phalanx replay scenes/cornell-box.json --pixel 100,50 --sample 3\n"
    "  phalanx replay scenes/cornell-box.json --pixel 100,50 --sample 3 --mode megakernel --isa avx2\n"
    "Size, samples per pixel, seed and depth must be those of the picture.\n"
    "Exit codes: 0 the sum has the bits of the sample, 2 bad command line or scene, 6 it has not.";

}  // namespace

void add_replay_command(CLI::App &app, int &exit_code) {
  auto command = std::make_shared<ReplayCommand>();
  CLI::App *sub = app.add_subcommand("replay", "Show the path of one sample, vertex by vertex");
  add_picture_options(*sub, command->scene, command->options);
  sub->add_option("--pixel", command->pixel, "Pixel of the full picture, from the upper left corner")
      ->type_name("X,Y")
      ->required();
  sub->add_option("--sample", command->sample, "Number of the sample in its pixel, from 0")
      ->type_name("N")
      ->check(CLI::Range(0, 0x7ffffffe))
      ->required();
  sub->footer(kExamples);
  sub->callback([command, &exit_code] { exit_code = run_replay(*command); });
}

}  // namespace phalanx
