// phalanx compare: the schedules in turn on the same samples.
#include "../report/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "../core/error.h"
#include "../core/timer.h"
#include "../output/files.h"
#include "../wavefront/isa.h"
#include "commands.h"
#include "lists.h"
#include "outputs.h"
#include "subject.h"

namespace phalanx {
namespace {

constexpr int kDefaultSpp = 16;  // scenes ask for pictures; a timing needs less

struct CompareCommand {
  std::vector<std::string> scenes;
  std::vector<Mode> modes = {Mode::kWavefront, Mode::kMegakernel, Mode::kDepthFirst,
                             Mode::kRecursive};
  std::vector<int> threads = {1};
  int num_runs = 5;
  RenderOptions options;
  std::string json;
};

// ---- measuring ---------------------------------------------------------------------------------

RenderOptions options_for(const CompareCommand &command, Mode mode, int threads) {
  RenderOptions options = command.options;
  options.mode = mode;
  options.threads = threads;
  return options;
}

void check_against(const Film &reference, const Film &film, ScheduleRuns &schedule) {
  const FilmDifferences differences = film_differences(film, reference);
  if (differences.num_different >= schedule.differences.num_different)
    schedule.differences = differences;
}

SceneComparison prepare(const CompareCommand &command, const std::string &path,
                        const Subject &subject) {
  const Plan plan = subject.plan(options_for(command, Mode::kWavefront, command.threads.front()));
  SceneComparison c;
  c.scene = path;
  c.isa = command.options.isa;
  c.width = plan.crop.width;
  c.height = plan.crop.height;
  c.spp = plan.spp;
  c.max_depth = plan.frame.max_depth;
  c.wave_size = plan.wave_size;
  c.tile_size = plan.tile_size;
  for (const Mode mode : command.modes) c.schedules.push_back({mode, plan.threads, {}, {}});
  for (std::size_t i = 1; i < command.threads.size(); i++)
    c.scaling.push_back(
        {Mode::kWavefront, subject.plan(options_for(command, Mode::kWavefront, command.threads[i])).threads, {}, {}});
  return c;
}

/// Renders the depth-first reference, warms every schedule up, then times them in turn.
SceneComparison compare_scene(const CompareCommand &command, const std::string &path) {
  const double start = wall_seconds();
  const Subject subject(path, command.options);
  SceneComparison c = prepare(command, path, subject);
  c.setup_s = wall_seconds() - start;

  const Film reference = subject.render(options_for(command, Mode::kDepthFirst, c.schedules.front().threads)).film;
  std::vector<ScheduleRuns *> turn;
  for (ScheduleRuns &schedule : c.schedules) turn.push_back(&schedule);
  for (ScheduleRuns &schedule : c.scaling) turn.push_back(&schedule);
  for (int round = 0; round <= command.num_runs; round++)
    for (ScheduleRuns *schedule : turn) {
      const bool warm_up = round == 0;
      if (warm_up && schedule->mode == Mode::kDepthFirst) continue;  // the reference was that
      RenderResult result = subject.render(options_for(command, schedule->mode, schedule->threads));
      check_against(reference, result.film, *schedule);
      if (!warm_up) schedule->runs.push_back(std::move(result.stats));
    }
  return c;
}

// ---- the command -------------------------------------------------------------------------------

void check(const CompareCommand &command) {
  const bool has_wavefront = std::find(command.modes.begin(), command.modes.end(),
                                       Mode::kWavefront) != command.modes.end();
  if (command.threads.size() > 1 && !has_wavefront)
    throw InputError("--threads: a list times the wavefront, which --modes leaves out");
  for (const std::string &scene : command.scenes) check_outputs({{}, command.json}, scene, false);
}

int run_compare(CompareCommand command) {
  command.options.isa = resolve_isa(command.options.isa);
  check(command);
  const bool print_tables = command.json != "-";
  std::vector<SceneComparison> comparisons;
  bool equal = true;
  for (const std::string &path : command.scenes) {
    comparisons.push_back(compare_scene(command, path));
    equal = equal && has_equal_bits(comparisons.back());
    if (!print_tables) continue;
    fmt::print("{}\n", compare_text(comparisons.back()));
    std::fflush(stdout);
  }
  if (print_tables) fmt::print("{}", compare_summary_text(comparisons));
  std::fflush(stdout);
  write_outputs({{}, command.json}, {}, 0, compare_json(comparisons));
  if (print_tables && !command.json.empty()) fmt::print(stderr, "wrote {}\n", command.json);
  return equal ? kExitDone : kExitBitsDiffer;
}

// ---- its options -------------------------------------------------------------------------------

void read_modes(const std::string &text, CompareCommand &command) {
  command.modes = modes_from_list(text);
}

void read_threads(const std::string &text, CompareCommand &command) {
  command.threads = ints(text, ',', 0);
  for (const int n : command.threads)
    if (n > 65536) command.threads.clear();
  if (command.threads.empty()) bad_value("--threads", "a list of numbers, such as 1,2,4", text);
}

/// Given twice, the last one counts: script/bench puts its defaults first.
void add_options(CLI::App &sub, CompareCommand &command) {
  using Read = void (*)(const std::string &, CompareCommand &);
  const auto text = [&](const char *name, const char *type, Read read, const char *help) {
    sub.add_option_function<std::string>(
           name, [read, &command](const std::string &value) { read(value, command); }, help)
        ->type_name(type)
        ->take_last();
  };
  const auto number = [&](const char *name, int &value, int lo, int hi, const char *help) {
    sub.add_option(name, value, help)->type_name("N")->check(CLI::Range(lo, hi))->take_last();
  };
  RenderOptions &options = command.options;
  sub.add_option("SCENE", command.scenes, "Scene files")->required();
  text("--modes", "LIST", read_modes,
       "Schedules, in their turn; default: wavefront,megakernel,depth-first,recursive");
  number("--runs", command.num_runs, 1, 10000, "Timed runs of each schedule; default 5");
  number("--spp", options.spp, 1, 1 << 24, "Samples per pixel; default 16");
  text("--size", "WxH",
       [](const std::string &value, CompareCommand &c) { read_size(value, c.options); }, "Size of the picture in pixels; default: the scene's");
  number("--max-depth", options.max_depth, 0, 1 << 24,
         "Scattering events after the camera; default: the scene's");
  text(
      "--threads", "LIST", read_threads,
      "Threads, 0 for all; default 1. Of a list, the first is for the schedules, and the wavefront "
      "is timed with all of them");
  sub.add_option("--isa", options.isa,
                 fmt::format("Instruction set: {}; the best one here by default",
                             fmt::join(known_isas(), ", ")))
      ->type_name("NAME")
      ->take_last();
  number("--wave-size", options.wave_size, 16, 1 << 20, "Paths in flight per thread");
  number("--tile-size", options.tile_size, 1, 256, "Side of a tile in pixels, a power of two");
  sub.add_option("--json", command.json,
                 "Write everything measured as JSON; - is stdout, without the tables")
      ->type_name("FILE")
      ->take_last();
}

const char kHelp[] =
    "Examples:\n"
    "  phalanx compare scenes/cornell-box.json --size 256x256\n"
    "  phalanx compare scenes/*.json --size 256x256 --runs 7 --json compare.json\n"
    "  phalanx compare scenes/menger.json --modes wavefront,recursive --threads 1,2,4\n"
    "Exit codes: 0 done, 2 bad command line or scene, 4 out of memory, 5 cannot write,\n"
    "6 a schedule that must have the bits of depth-first (all but recursive) has not.";

}  // namespace

void add_compare_command(CLI::App &app, int &exit_code) {
  auto command = std::make_shared<CompareCommand>();
  command->options.spp = kDefaultSpp;
  CLI::App *sub = app.add_subcommand("compare", "Time the schedules against each other");
  add_options(*sub, *command);
  sub->footer(kHelp);
  sub->callback([command, &exit_code] { exit_code = run_compare(*command); });
}

}  // namespace phalanx
