// phalanx converge: error against run time.
#include "../report/convergence.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <memory>

#include "../core/timer.h"
#include "../output/film_image.h"
#include "../output/files.h"
#include "../output/image_file.h"
#include "../plan/seeds.h"
#include "../report/error_map.h"
#include "../report/flip.h"
#include "../report/metrics.h"
#include "../scene/sampler_names.h"
#include "../wavefront/isa.h"
#include "commands.h"
#include "lists.h"
#include "outputs.h"
#include "subject.h"

namespace phalanx {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr int kDefaultMaxSpp = 256;
constexpr int kReferenceTimes = 4;  // each half of a reference has this many times the samples of a run

struct ConvergeCommand {
  std::vector<std::string> scenes;
  std::vector<Mode> modes = {Mode::kWavefront};
  std::vector<int> samplers;   // SamplerKind; empty: the scene's
  std::vector<double> targets;
  int num_seeds = 16;
  int max_spp = 0;             // 0: the default, or with a limit of time none
  double max_time_s = 0;       // of a run; 0: no limit
  int reference_spp = 0;       // of a half; 0: kReferenceTimes those of a run
  bool replicates = false;
  RenderOptions options;
  std::string reference = "auto", json, csv, maps;
};

// ---- the reference -----------------------------------------------------------------------------

void check_reference(const Image &image, const std::string &path, const Plan &plan) {
  if (image.width != plan.crop.width || image.height != plan.crop.height)
    throw InputError(fmt::format("{}: {} x {} pixels; the picture has {} x {}", path, image.width,
                                 image.height, plan.crop.width, plan.crop.height));
  if (!rgb_planes(image)[0]) throw InputError(path + ": has no channels R, G, B or Y");
  const Anomalies found = find_anomalies(image);
  if (found.nan + found.inf > 0) throw InputError(path + ": has pixels that are not finite");
}

ReferencePair pair_of(Image a, Image b, const std::string &description, int spp, bool halves) {
  Image mean = make_image(a.width, a.height);
  for (int c = 0; c < 3; ++c) {
    std::vector<float> &plane = add_channel(mean, std::string(1, "RGB"[c]));
    const float *pa = rgb_planes(a)[c], *pb = rgb_planes(b)[c];
    for (std::size_t i = 0; i < plane.size(); ++i)
      plane[i] = static_cast<float>(0.5 * (double{pa[i]} + double{pb[i]}));
  }
  return {std::move(a), std::move(b), std::move(mean), description, spp, halves};
}

ReferencePair read_reference(const ConvergeCommand &command, const Plan &plan) {
  const std::vector<std::string> paths = words(command.reference, ',');
  const Image a = read_image(paths[0]), b = read_image(paths.back());
  check_reference(a, paths[0], plan);
  check_reference(b, paths.back(), plan);
  const bool halves = paths.size() == 2;
  return pair_of(a, b,
                 halves ? fmt::format("the halves {} and {}", paths[0], paths[1])
                        : fmt::format("{}, alone: errors hold its own", paths[0]),
                 0, halves);
}

/// A picture as a whole image: crop windows and their offsets do not matter here.
Image picture_of(const Film &film) {
  return image_from_film(film, film.crop().x + film.crop().width, film.crop().y + film.crop().height, {});
}

/// Both halves with seeds of their own, by the wavefront, without replicates or adaptive sampling.
ReferencePair render_reference(const ConvergeCommand &command, const Subject &subject, int seed) {
  RenderOptions options = command.options;
  options.mode = Mode::kWavefront;
  options.adaptive = false;
  options.spp = command.reference_spp > 0   ? command.reference_spp
                : command.max_spp > 0 ? std::min(kReferenceTimes * command.max_spp, kNoSampleLimit)
                                      : 0;
  if (options.spp == 0) options.time_limit_s = kReferenceTimes * command.max_time_s;
  Image halves[2];
  int spp = 0;
  for (int half = 0; half < 2; ++half) {
    options.seed = derived_seed(seed, SeedUse::kReference, half);
    const RenderResult result = subject.render(options);
    spp = result.stats.spp;
    halves[half] = picture_of(result.film);
  }
  return pair_of(std::move(halves[0]), std::move(halves[1]),
                 fmt::format("two halves of {} samples per pixel", spp), spp, true);
}

// ---- runs --------------------------------------------------------------------------------------

/// One run with its checkpoints. Its clock stands still while errors are computed.
class Run {
 public:
  Run(const ReferencePair &reference, bool with_flip, double max_time_s)
      : reference_(reference), with_flip_(with_flip), max_time_s_(max_time_s), cpu_start_(cpu_seconds()) {}

  /// For render().
  bool at_pass(const Progress &progress, const Film &film) {
    if (!progress.between_passes) return true;
    const double before = wall_seconds(), cpu_before = cpu_seconds();
    const double elapsed = progress.elapsed_s - measuring_s_;
    if (std::has_single_bit(static_cast<unsigned>(progress.spp_done)))
      measure(progress, film, elapsed, cpu_before - cpu_start_ - measuring_cpu_s_);
    measuring_s_ += wall_seconds() - before;
    measuring_cpu_s_ += cpu_seconds() - cpu_before;
    return max_time_s_ == 0 || elapsed < max_time_s_;
  }

  std::vector<RunPoint> points;
  Image last;  // at the last checkpoint

 private:
  void measure(const Progress &progress, const Film &film, double wall_s, double cpu_s) {
    RunPoint p;
    p.spp = progress.spp_done;
    double samples = 0;
    for (std::int64_t i = 0; i < film.num_pixels(); ++i) samples += static_cast<double>(film.sample_count(i));
    p.samples_per_pixel = samples / static_cast<double>(film.num_pixels());
    p.wall_s = wall_s;
    p.cpu_s = cpu_s;
    p.rays = progress.rays;
    last = picture_of(film);
    p.error = picture_error(last, reference_);
    p.flip = with_flip_ ? flip(last, reference_.mean, true).mean : kUnknown;
    const auto *checks = progress.checks;
    if (checks != nullptr && !checks->empty() && checks->back().spp == p.spp) {
      p.estimate = checks->back().relmse;
      p.lo95 = checks->back().lo95;
      p.hi95 = checks->back().hi95;
    } else {
      p.estimate = estimate_error(film, false).relmse;
      p.lo95 = p.hi95 = kUnknown;  // of the scatter between tiles, not of this figure
    }
    points.push_back(p);
  }

  const ReferencePair &reference_;
  bool with_flip_;
  double max_time_s_, cpu_start_;
  double measuring_s_ = 0, measuring_cpu_s_ = 0;
};

RenderOptions run_options(const ConvergeCommand &command, const Curve &curve, int sampler, int seed) {
  RenderOptions options = command.options;
  options.mode = curve.mode;
  options.sampler = sampler;
  options.seed = seed;
  options.spp = command.max_spp;
  options.replicates = command.replicates ? kDefaultReplicates : 0;
  if (options.spp == 0) options.spp = kNoSampleLimit;
  return options;
}

/// Checkpoints that all runs of all contestants have.
void keep_common_checkpoints(std::vector<Curve> &curves) {
  for (Curve &curve : curves) {
    std::size_t num = curve.runs.front().size();
    for (const auto &run : curve.runs) num = std::min(num, run.size());
    for (auto &run : curve.runs) run.resize(num);
    if (num == 0)
      throw InputError("--max-time: not one pass was done in it; errors are measured after whole passes");
  }
}

SceneConvergence converge_scene(const ConvergeCommand &command, const std::string &path) {
  const double start = wall_seconds();
  const Subject subject(path, command.options);
  SceneConvergence c;
  c.setup_s = wall_seconds() - start;
  const Plan plan = subject.plan(command.options);
  const int seed = plan.frame.seed;
  c.scene = path;
  c.isa = command.options.isa;
  c.width = plan.crop.width;
  c.height = plan.crop.height;
  c.max_depth = plan.frame.max_depth;
  c.threads = plan.threads;
  c.replicates = command.replicates ? kDefaultReplicates : 0;
  c.adaptive = command.options.adaptive;

  std::vector<int> samplers = command.samplers;
  if (samplers.empty()) samplers = {plan.frame.sampler};
  std::vector<int> sampler_of;
  for (const Mode mode : command.modes)
    for (const int sampler : samplers) {
      c.curves.push_back({mode, sampler_name(sampler), {}, {}, {}});
      sampler_of.push_back(sampler);
    }
  const ReferencePair reference = command.reference == "auto" ? render_reference(command, subject, seed)
                                                              : read_reference(command, plan);
  c.reference = reference.description;

  std::vector<BiasSums> bias(c.curves.size());
  std::vector<ErrorMap> maps(c.curves.size());
  for (int run_id = -1; run_id < command.num_seeds; ++run_id)  // the first one warms up
    for (std::size_t i = 0; i < c.curves.size(); ++i) {
      RenderOptions options =
          run_options(command, c.curves[i], sampler_of[i],
                      derived_seed(seed, SeedUse::kRun, std::max(run_id, 0)));
      if (run_id < 0) options.spp = 16;
      Run run(reference, run_id == 0, command.max_time_s);
      const RenderResult result = subject.render(
          options, [&](const Progress &p, const Film &film) { return run.at_pass(p, film); });
      if (run_id < 0) continue;
      if (run.points.empty()) throw InputError("--max-spp: 16 samples per pixel are the least");
      c.curves[i].runs.push_back(run.points);
      bias[i].add(run.last, reference);
      if (!command.maps.empty()) maps[i].add(run.last, reference.mean);
    }
  keep_common_checkpoints(c.curves);
  for (std::size_t i = 0; i < c.curves.size(); ++i) {
    c.curves[i].squared_bias = bias[i].squared(reference);
    c.curves[i].mean_bias = bias[i].image_mean(reference, c.curves[i].runs.front().back().spp);
    if (!command.maps.empty())
      write_image(fmt::format("{}/{}-{}-{}.png", command.maps, std::filesystem::path(path).stem().string(),
                              mode_name(c.curves[i].mode), c.curves[i].sampler),
                  maps[i].image(), 0);
  }
  c.targets = command.targets.empty() ? default_targets(c.curves) : command.targets;
  return c;
}

// ---- the command -------------------------------------------------------------------------------

void check(ConvergeCommand &command) {
  if (command.max_spp == 0 && command.max_time_s == 0) command.max_spp = kDefaultMaxSpp;
  if (command.replicates && command.max_spp > 0 && command.max_spp < 64)
    throw InputError("--error on: the estimate begins at 64 samples per pixel; --max-spp has to allow them");
  if (command.reference != "auto" && words(command.reference, ',').size() > 2)
    throw InputError("--reference: auto, one file, or two files A,B with independent samples");
  if (!command.maps.empty() && !std::filesystem::is_directory(command.maps))
    throw InputError(command.maps + ": --maps needs a folder that exists");
  for (const std::string &scene : command.scenes) {
    check_outputs({{}, command.json}, scene, false);
    check_outputs({{}, command.csv}, scene, false);
  }
  if (!command.json.empty() && command.json == command.csv)
    throw InputError(command.json + ": named twice as an output");
}

int run_converge(ConvergeCommand command) {
  command.options.isa = resolve_isa(command.options.isa);
  check(command);
  const bool print_tables = command.json != "-" && command.csv != "-";
  std::vector<SceneConvergence> scenes;
  for (const std::string &path : command.scenes) {
    scenes.push_back(converge_scene(command, path));
    if (!print_tables) continue;
    fmt::print("{}\n", convergence_text(scenes.back()));
    std::fflush(stdout);
  }
  if (print_tables) fmt::print("{}", convergence_summary_text(scenes));
  std::fflush(stdout);
  if (!command.json.empty()) write_outputs({{}, command.json}, {}, 0, convergence_json(scenes));
  if (!command.csv.empty()) write_outputs({{}, command.csv}, {}, 0, convergence_csv(scenes));
  return kExitDone;
}

// ---- its options -------------------------------------------------------------------------------

void read_samplers(const std::string &text, ConvergeCommand &command) {
  command.samplers.clear();
  for (const std::string &word : words(text, ',')) {
    const auto known = std::find_if(kSamplerNames.begin(), kSamplerNames.end(),
                                    [&](const auto &s) { return word == s.first; });
    if (known == kSamplerNames.end())
      bad_value("--samplers", "a list of sobol, independent, stratified, halton, blue_noise", text);
    command.samplers.push_back(known->second);
  }
}

void read_targets(const std::string &text, ConvergeCommand &command) {
  command.targets.clear();
  for (const std::string &word : words(text, ',')) {
    double value = 0;
    if (!CLI::detail::lexical_cast(word, value) || !std::isfinite(value) || value <= 0)
      bad_value("--targets", "a list of relMSE above 0, such as 1e-2,1e-3", text);
    command.targets.push_back(value);
  }
}

void read_max_time(const std::string &text, ConvergeCommand &command) {
  double &value = command.max_time_s;
  if (!CLI::detail::lexical_cast(text, value) || !std::isfinite(value) || value <= 0)
    bad_value("--max-time", "a number of seconds above 0", text);
}

void read_error(const std::string &text, ConvergeCommand &command) {
  if (text != "on" && text != "off") bad_value("--error", "on or off", text);
  command.replicates = text == "on";
}

/// Given twice, the last one counts: script/bench puts its defaults first.
void add_options(CLI::App &sub, ConvergeCommand &command) {
  using Read = void (*)(const std::string &, ConvergeCommand &);
  const auto text = [&](const char *name, const char *type, Read read, const char *help) {
    sub.add_option_function<std::string>(
           name, [read, &command](const std::string &value) { read(value, command); }, help)
        ->type_name(type)
        ->take_last();
  };
  const auto number = [&](const char *name, int &value, int lo, int hi, const char *help) {
    sub.add_option(name, value, help)->type_name("N")->check(CLI::Range(lo, hi))->take_last();
  };
  const auto file = [&](const char *name, std::string &value, const char *help) {
    sub.add_option(name, value, help)->type_name("FILE")->take_last();
  };
  RenderOptions &options = command.options;
  options.threads = 1;
  sub.add_option("SCENE", command.scenes, "Scene files")->required();
  text("--modes", "LIST",
       [](const std::string &value, ConvergeCommand &c) { c.modes = modes_from_list(value); },
       "Schedules; default wavefront. Each is timed itself");
  text("--samplers", "LIST", read_samplers, "Samplers; default: the scene's");
  number("--seeds", command.num_seeds, 2, 100000, "Runs of each contestant; default 16");
  number("--max-spp", command.max_spp, 16, 1 << 24, "Samples per pixel of a run; default 256");
  text("--max-time", "SECONDS", read_max_time, "A run ends after the pass in which this time is over");
  sub.add_option("--reference", command.reference,
                 "auto: two halves are rendered (default). FILE: errors then hold those of the file. A,B: two "
                 "files with independent samples")
      ->type_name("auto|FILE")
      ->take_last();
  number("--reference-spp", command.reference_spp, 1, 1 << 26,
         "Samples per pixel of each half; default 4 times those of a run");
  text("--targets", "LIST", read_targets, "relMSE to give the time to; default: the powers of ten on the way");
  text("--error", "on|off", read_error, "Runs with replicates, whose estimates are compared with the error");
  sub.add_flag("--adaptive", options.adaptive, "Runs with adaptive sampling");
  text("--size", "WxH", [](const std::string &value, ConvergeCommand &c) { read_size(value, c.options); },
       "Size of the picture in pixels; default: the scene's");
  number("--max-depth", options.max_depth, 0, 1 << 24,
         "Scattering events after the camera; default: the scene's");
  number("--threads", options.threads, 0, 65536, "Threads, 0 for all; default 1");
  sub.add_option("--isa", options.isa,
                 fmt::format("Instruction set: {}; the best one here by default",
                             fmt::join(known_isas(), ", ")))
      ->type_name("NAME")
      ->take_last();
  file("--json", command.json, "Write everything, run by run, as JSON; - is stdout, without the tables");
  file("--csv", command.csv, "Write a line for each scene, contestant and checkpoint; - is stdout");
  sub.add_option("--maps", command.maps, "Write error maps as PNG into this folder")
      ->type_name("FOLDER")
      ->take_last();
}

const char kHelp[] =
    "Examples:\n"
    "  phalanx converge scenes/cornell-box.json --size 128x128\n"
    "  phalanx converge scenes/*.json --modes wavefront,recursive,megakernel --size 128x128 --json c.json\n"
    "  phalanx converge scenes/veach-mis.json --samplers sobol,independent,halton --max-spp 1024\n"
    "  phalanx converge scenes/terrain.json --error on          is the error that is told the true one?\n"
    "docs/error.md explains every figure.";

}  // namespace

void add_converge_command(CLI::App &app, int &exit_code) {
  auto command = std::make_shared<ConvergeCommand>();
  CLI::App *sub = app.add_subcommand("converge", "Measure error against run time");
  add_options(*sub, *command);
  sub->footer(kHelp);
  sub->callback([command, &exit_code] { exit_code = run_converge(*command); });
}

}  // namespace phalanx
