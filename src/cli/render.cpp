// phalanx render: load, build, plan, render, write, report.
#include "../render/render.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "../core/error.h"
#include "../core/timer.h"
#include "../distribute/checkpoint.h"
#include "../distribute/share_scene.h"
#include "../output/film_image.h"
#include "../output/image_file.h"
#include "../report/report.h"
#include "../scene/scene_bytes.h"
#include "../wavefront/isa.h"
#include "commands.h"
#include "lease_options.h"
#include "load_scene.h"
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
  LeaseCommand lease;
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

void warn_of_invalid_samples(const Report &report) {
  const RunStats &stats = report.stats;
  const InvalidSamples &invalid = stats.invalid;
  if (invalid.count > 0)
    fmt::print(stderr,
               "phalanx: warning: {} samples were left out: {} not finite, {} negative; the first is sample {} of pixel "
               "({}, {}). To see its path:\n  {}\n",
               invalid.count, invalid.not_finite, invalid.negative, invalid.sample, invalid.x, invalid.y,
               replay_command(report));
  if (stats.clamp > 0)
    fmt::print(stderr, "phalanx: --clamp {:g} cut {} samples and took {:.3g} % of the picture's light\n", stats.clamp,
               invalid.clamped, 100 * stats.clamped_share);
}

int exit_code_of(const RunStats &stats, bool strict) {
  if (stop_signal() != 0) return 128 + stop_signal();
  return strict && stats.invalid.count > 0 ? kExitInvalidSamples : kExitDone;
}

/// What this rank needs to render, the same on all ranks.
struct Workplace {
  LoadedScene loaded;
  RenderOptions options;
  Plan plan;
  std::optional<Accel> accel;
  std::vector<int> threads;  // of each rank
  std::uint64_t scene_fingerprint = 0;  // only if rendered by leases
};

void set_up(const RenderCommand &command, Ranks &ranks, bool by_leases, Workplace &work) {
  RenderOptions &options = work.options;
  options.isa = common_isa(ranks, options.isa);
  work.loaded = load_on_all(ranks, command.lease.shared_files, [&] {
    return load_scene(command.scene, launched_rank() == 0);
  });
  agree(ranks, [&] {
    work.plan = make_plan(work.loaded.description, work.loaded.scene, options);
    if (by_leases && (work.plan.replicates > 0 || work.plan.adaptive))
      throw InputError(
          "an estimate of the error and adaptive sampling are for one process without checkpoint, "
          "balance or map: leave out --error, --target-error and --adaptive");
    if (ranks.rank() == 0)
      say_if_rounded(work.plan, options.spp > 0 ? options.spp : work.loaded.description.sampler.spp,
                     command.quiet);
    check_memory(plan_memory(work.plan, work.loaded.scene));
    work.accel.emplace(work.loaded.scene, options.isa, work.plan.threads);
  });
  work.threads = share_numbers(ranks, work.plan.threads);
  if (!by_leases) return;
  if (options.tile_size == 0) work.plan.tile_size = lease_tile_size(work.plan, work.threads);
  work.scene_fingerprint = scene_fingerprint(work.loaded.scene);
  std::string facts;
  for (const auto &[name, value] : picture_facts(work.plan, options, work.scene_fingerprint))
    facts += name + " " + value + ", ";
  check_same(ranks, facts, "what it renders");
}

int serve(const Workplace &work, Ranks &ranks) {
  catch_stop_signals();  // rank 0 gets them, too, and says when to stop
  if (serve_leases(ranks, work.loaded.scene, *work.accel, work.plan, work.options)) return kExitDone;
  fmt::print(stderr, "phalanx: rank {}: rank 0 has said nothing for 30 s\n", ranks.rank());
  ranks.limit_ending(2, 1);
  return 1;
}

int run_rank(const RenderCommand &command, Ranks &ranks) {
  const double start = wall_seconds();
  const bool by_leases = command.lease.needs_leases(ranks);
  const Layers layers = command.layers.empty() ? Layers{} : layers_from_list(command.layers);
  Workplace work;
  work.options = command.options;
  work.options.aovs = layers.need_first_hits();
  const Outputs outputs = choose_outputs(command.scene, command.images, command.report);
  agree(ranks, [&] {
    if (ranks.rank() > 0) return;
    check_outputs(outputs, command.scene, layers.any());
    check_lease_outputs(command.lease, command.scene, outputs);
  });
  set_up(command, ranks, by_leases, work);
  if (ranks.rank() > 0) return serve(work, ranks);

  const Plan &plan = work.plan;
  const Scene &scene = work.loaded.scene;
  const double setup_s = wall_seconds() - start;
  const double exposure = command.exposure.value_or(work.loaded.description.film.exposure);
  const bool stratified = plan.frame.sampler == kSobolSampler;
  const auto report_of = [&](const Film &film, RunStats stats,
                             const std::optional<ErrorEstimate> &error = {},
                             std::vector<TileError> tiles = {}) {
    stats.setup_s = setup_s;
    return Report{command.scene, plan, std::move(stats),
                  error ? *error : estimate_error(film, stratified),
                  std::nullopt, peak_rss_bytes(), std::move(tiles)};
  };
  const auto image_of = [&](const Film &film, const Report &report) {
    Image image = image_from_film(film, plan.frame.width, plan.frame.height, layers);
    image.metadata = report_metadata(report);
    return image;
  };
  const auto snapshot = [&](const Film &film, const RunStats &stats) {
    const Report report = report_of(film, stats);
    write_outputs({outputs.images, ""}, image_of(film, report), exposure, "");
    if (!command.quiet) fmt::print(stderr, "wrote a snapshot to {}\n", fmt::join(outputs.images, ", "));
  };

  ProgressDisplay display(progress_style(command.quiet), stratified);
  catch_stop_signals();
  const auto progress = [&](const Progress &p, const Film &film) {
    display.update(p, film);
    if (!by_leases && p.between_passes && snapshot_requested()) {
      RunStats stats;
      stats.spp = p.spp_done;
      stats.threads = plan.threads;
      stats.mode = mode_name(work.options.mode);
      stats.isa = work.options.isa;
      stats.wall_s = p.elapsed_s;
      snapshot(film, stats);
    }
    return stop_signal() == 0;
  };
  LeaseResult result{Film({}, false), {}, {}, ""};
  std::optional<ErrorEstimate> error;
  std::vector<TileError> tiles;
  if (by_leases) {
    const LeaseOptions lease{command.lease.balance.value_or(Balance::kDynamic),
                             command.lease.checkpoint,
                             command.lease.checkpoint_every_s,
                             command.lease.resume,
                             work.scene_fingerprint,
                             work.threads};
    const auto warn = [](const std::string &text) {
      fmt::print(stderr, "phalanx: warning: {}\n", text);
    };
    result = render_leases(ranks, scene, *work.accel, plan, work.options, lease,
                           {progress, snapshot_requested, snapshot, warn});
  } else {
    RenderResult whole = render(scene, *work.accel, plan, work.options, progress);
    result.film = std::move(whole.film);
    result.stats = std::move(whole.stats);
    error = whole.error;
    if (whole.replicates) tiles = tile_errors(*whole.replicates);
  }

  const Report report = report_of(result.film, std::move(result.stats), error, std::move(tiles));
  display.finish(report.stats, report.error, plan.target_error);
  warn_of_invalid_samples(report);
  const bool has_lost = std::any_of(report.stats.per_rank.begin(), report.stats.per_rank.end(),
                                    [](const RankStats &r) { return r.lost; });
  const int exit_code = exit_code_of(report.stats, command.strict);
  if (!command.lease.map.empty()) write_image(command.lease.map, result.map, 0);
  write_outputs(outputs, image_of(result.film, report), exposure, report_json(report));
  if (!command.quiet) fmt::print(stderr, "wrote {}\n", fmt::join(outputs.images, ", "));
  if (!result.checkpoint_failure.empty()) throw WriteError(result.checkpoint_failure);
  if (has_lost) ranks.limit_ending(5, exit_code);
  return exit_code;
}

int run_render(const RenderCommand &command) {
  Ranks ranks;
  try {
    return run_rank(command, ranks);
  } catch (const StoppedByOthers &) {
    return kExitDone;  // rank 0 says why, and with which code
  } catch (const std::exception &error) {
    if (ranks.rank() == 0) throw;
    fmt::print(stderr, "phalanx: rank {}: {}\n", ranks.rank(), error.what());
    ranks.limit_ending(2, 1);  // others may wait for this rank in vain
    return 1;
  }
}

const char kExamples[] =
    "Examples:\n"
    "  phalanx render scenes/cornell-box.json -o box.png\n"
    "  phalanx render scenes/cornell-box.json --time 30 -o box.exr --report box-report.json\n"
    "  phalanx render scenes/cornell-box.json --target-error 1e-3 --time 600 -o box.exr\n"
    "  phalanx render scenes/cornell-box.json --size 320x240 --crop 100,50,64,64 --spp 256\n"
    "  phalanx render scenes/cornell-box.json -o box.exr --aov albedo,normal,variance,samples\n"
    "  phalanx render scenes/cornell-box.json -o box.png --checkpoint box.ckpt --resume\n"
    "  mpirun -n 4 phalanx render scenes/cornell-box.json -o box.png\n"
    "Exit codes: 0 done, 2 bad command line or scene, 3 invalid samples under --strict,\n"
    "4 out of memory, 5 cannot write, 130/143 stopped by SIGINT/SIGTERM (the image is written).\n"
    "SIGUSR1 writes the image as it is, and rendering goes on.";

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
  add_lease_options(*sub, command->lease);
  sub->add_flag("--strict", command->strict, "Exit with 3 if any sample was not finite or negative");
  sub->add_option("--clamp", command->options.clamp,
                  "Scale down samples whose largest channel is above this radiance: less noise, but the picture "
                  "becomes too dark; the report says by how much. Default: none")
      ->type_name("RADIANCE")
      ->check(CLI::PositiveNumber);
  sub->add_flag("--quiet", command->quiet, "No progress and no summary");
  sub->footer(kExamples);
  sub->callback([command, &exit_code] { exit_code = run_render(*command); });
}

}  // namespace phalanx
