// phalanx render: load, build, plan, render, write, report.
#include "../render/render.h"

#include <fmt/format.h>
#include <unistd.h>

#include <memory>
#include <optional>

#include "../core/error.h"
#include "../core/timer.h"
#include "../output/film_image.h"
#include "../report/report.h"
#include "../scene/build.h"
#include "../scene/scene_file.h"
#include "../wavefront/isa.h"
#include "commands.h"
#include "outputs.h"
#include "picture_options.h"
#include "progress.h"
#include "signals.h"
#include "text.h"

namespace phalanx {
namespace {

struct RenderCommand {
  std::string scene;
  RenderOptions options;
  std::vector<std::string> images;
  std::string report, layers;
  std::optional<double> exposure;
  bool strict = false, quiet = false;
};

/// Better to refuse now than to be killed for memory in an hour.
void check_memory(const MemoryPlan &memory) {
  const std::int64_t installed = std::int64_t{sysconf(_SC_PHYS_PAGES)} * sysconf(_SC_PAGESIZE);
  if (installed > 0 && memory.total() > installed)
    throw MemoryError(
        fmt::format("this needs {} of memory (scene {}, film {}, ray queries {}, waves {}); the "
                    "machine has {}. "
                    "Try a smaller --size or a --crop{}",
                    text_of_bytes(memory.total()), text_of_bytes(memory.scene),
                    text_of_bytes(memory.film), text_of_bytes(memory.accel_estimate),
                    text_of_bytes(memory.waves), text_of_bytes(installed),
                    memory.replicates > 0 ? fmt::format(", or leave out the error estimate ({})",
                                                        text_of_bytes(memory.replicates))
                                          : ""));
}

/// Replicates have the same number of samples each, and so have quarters of them with --adaptive.
void say_if_rounded(const Plan &plan, int wanted, bool quiet) {
  if (quiet || plan.spp == wanted || plan.spp >= kNoSampleLimit) return;
  fmt::print(stderr, "phalanx: {} samples per pixel instead of {}: {}{}\n", plan.spp, wanted,
             plan.replicates > 0 ? fmt::format("a multiple of {} replicates", plan.replicates) : "",
             plan.adaptive ? plan.replicates > 0 ? ", each a multiple of 4" : "a multiple of 4" : "");
}

void warn_of_invalid_samples(const InvalidSamples &invalid) {
  if (invalid.count == 0) return;
  fmt::print(
      stderr,
      "phalanx: warning: {} samples were not finite and were left out; the first is sample {} "
      "of pixel ({}, {})\n",
      invalid.count, invalid.sample, invalid.x, invalid.y);
}

int exit_code_of(const RunStats &stats, bool strict) {
  if (stop_signal() != 0) return 128 + stop_signal();
  return strict && stats.invalid.count > 0 ? kExitInvalidSamples : kExitDone;
}

int run_render(const RenderCommand &command) {
  const double start = wall_seconds();
  const Layers layers = command.layers.empty() ? Layers{} : layers_from_list(command.layers);
  RenderOptions options = command.options;
  options.isa = resolve_isa(options.isa);
  options.aovs = layers.need_first_hits();
  const Outputs outputs = choose_outputs(command.scene, command.images, command.report);
  check_outputs(outputs, command.scene, layers.any());

  Diagnostics diagnostics;
  const SceneDescription description = load_scene_file(command.scene, diagnostics);
  diagnostics.throw_if_errors();
  const Scene scene = build_scene(description, diagnostics);
  print_problems(diagnostics.warnings(), "warning: ");
  diagnostics.throw_if_errors();
  const Plan plan = make_plan(description, scene, options);
  say_if_rounded(plan, options.spp > 0 ? options.spp : description.sampler.spp, command.quiet);
  check_memory(plan_memory(plan, scene));
  const Accel accel(scene, options.isa, options.threads);
  const double setup_s = wall_seconds() - start;

  const bool stratified = plan.frame.sampler == kSobolSampler;
  ProgressDisplay display(progress_style(command.quiet), stratified);
  catch_stop_signals();
  RenderResult result =
      render(scene, accel, plan, options, [&](const Progress &progress, const Film &film) {
        display.update(progress, film);
        return stop_signal() == 0;
      });
  result.stats.setup_s = setup_s;

  const Report report{command.scene, plan,
                      result.stats,  result.error.value_or(estimate_error(result.film, stratified)),
                      std::nullopt,  peak_rss_bytes(),
                      result.replicates ? tile_errors(*result.replicates) : std::vector<TileError>()};
  display.finish(report.stats, report.error, plan.target_error);
  warn_of_invalid_samples(report.stats.invalid);
  Image image = image_from_film(result.film, plan.frame.width, plan.frame.height, layers);
  image.metadata = report_metadata(report);
  write_outputs(outputs, image, command.exposure.value_or(description.film.exposure),
                report_json(report));
  if (!command.quiet) fmt::print(stderr, "wrote {}\n", fmt::join(outputs.images, ", "));
  return exit_code_of(report.stats, command.strict);
}

const char kExamples[] =
    "Examples:\n"
    "  phalanx render scenes/cornell-box.json -o box.png\n"
    "  phalanx render scenes/cornell-box.json --time 30 -o box.exr --report box-report.json\n"
    "  phalanx render scenes/cornell-box.json --target-error 1e-3 --time 600 -o box.exr\n"
    "  phalanx render scenes/cornell-box.json --size 320x240 --crop 100,50,64,64 --spp 256\n"
    "  phalanx render scenes/cornell-box.json -o box.exr --aov albedo,normal,variance,samples\n"
    "Exit codes: 0 done, 2 bad command line or scene, 3 invalid samples under --strict,\n"
    "4 out of memory, 5 cannot write, 130/143 stopped by SIGINT/SIGTERM (the image is written).";

}  // namespace

void add_render_command(CLI::App &app, int &exit_code) {
  auto command = std::make_shared<RenderCommand>();
  CLI::App *sub = app.add_subcommand("render", "Render a scene to images");
  add_picture_options(*sub, command->scene, command->options);
  sub->add_option("-o,--output", command->images,
                  "Image to write, by extension .exr, .hdr or .png; may be repeated. "
                  "Default: the scene's name with .exr and .png, in the working directory")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  sub->add_option("--aov", command->layers,
                  "Layers to add to EXR files: albedo, normal, depth, samples, variance, or all")
      ->type_name("LIST");
  sub->add_option("--exposure", command->exposure,
                  "Exposure of PNG files in stops; default: the scene's")
      ->type_name("STOPS");
  sub->add_option("--report", command->report, "Write a report as JSON; - is stdout")
      ->type_name("FILE");
  sub->add_flag("--strict", command->strict, "Exit with 3 if any sample was not finite");
  sub->add_flag("--quiet", command->quiet, "No progress and no summary");
  sub->footer(kExamples);
  sub->callback([command, &exit_code] { exit_code = run_render(*command); });
}

}  // namespace phalanx
