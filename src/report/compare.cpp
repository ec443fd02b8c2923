// Statistics of paired runs, then the tables and the JSON made of them.
#include "compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "../scene/accel.h"
#include "../wavefront/stages.h"
#include "version.h"

namespace phalanx {

// ---- statistics --------------------------------------------------------------------------------

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {(values[(n - 1) / 2] + values[n / 2]) / 2, values.front(), values.back()};
}

/// Between the order statistics k and n + 1 - k lies the median unless fewer than k values fall on
/// one of its sides: probability 2 P(Binomial(n, 1/2) < k).
MedianInterval median_interval(std::vector<double> values) {
  constexpr double kWanted = 0.95;
  std::sort(values.begin(), values.end());
  const int n = static_cast<int>(values.size());
  double probability = std::pow(0.5, n);  // of exactly k - 1 values on a given side
  double outside = 2 * probability;
  int k = 1;
  for (; 2 * (k + 1) <= n; k++) {
    probability *= static_cast<double>(n - k + 1) / k;
    if (1 - (outside + 2 * probability) < kWanted) break;
    outside += 2 * probability;
  }
  return {spread_of(values).median, values[static_cast<std::size_t>(k - 1)],
          values[static_cast<std::size_t>(n - k)], 1 - outside};
}

MedianInterval paired_speed_up(const std::vector<double> &base, const std::vector<double> &time) {
  std::vector<double> ratios(base.size());
  for (std::size_t i = 0; i < ratios.size(); i++) ratios[i] = base[i] / time[i];
  return median_interval(std::move(ratios));
}

double geometric_mean(const std::vector<double> &values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

namespace {

bool same_bits(Vec3 a, Vec3 b) { return std::memcmp(&a, &b, sizeof(Vec3)) == 0; }

double largest_channel(Vec3 v) {
  return double{std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)})};
}

}  // namespace

FilmDifferences film_differences(const Film &film, const Film &reference) {
  FilmDifferences result;
  result.num_pixels = film.num_pixels();
  for (std::int64_t i = 0; i < result.num_pixels; i++) {
    const Vec3 x = film.mean(i), r = reference.mean(i);
    if (film.sample_count(i) == reference.sample_count(i) && same_bits(x, r) &&
        same_bits(film.variance_of_mean(i), reference.variance_of_mean(i)))
      continue;
    result.num_different++;
    const double difference = largest_channel({x.x - r.x, x.y - r.y, x.z - r.z});
    const double size = std::max(largest_channel(x), largest_channel(r));
    if (size > 0) result.largest_relative = std::max(result.largest_relative, difference / size);
  }
  return result;
}

// ---- derived figures ---------------------------------------------------------------------------

namespace {

using Json = nlohmann::ordered_json;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

std::vector<double> wall_seconds_of(const ScheduleRuns &schedule) {
  std::vector<double> seconds;
  for (const RunStats &run : schedule.runs) seconds.push_back(run.wall_s);
  return seconds;
}

double utilisation_of(const StageStats &stage) {
  if (stage.lanes_total == 0) return kUnknown;
  return static_cast<double>(stage.lanes_active) / static_cast<double>(stage.lanes_total);
}

/// The film adds sample after sample; it has no lanes.
bool is_simd(const StageStats &stage) { return stage.name != stage_name(kStageFilm); }

/// The stages of a run, each with the median of its seconds over all runs.
std::vector<StageStats> median_stages(const ScheduleRuns &schedule) {
  std::vector<StageStats> stages = schedule.runs.front().stages;
  for (StageStats &stage : stages) {
    std::vector<double> seconds;
    for (const RunStats &run : schedule.runs)
      for (const StageStats &same : run.stages)
        if (same.name == stage.name) seconds.push_back(same.seconds);
    stage.seconds = spread_of(seconds).median;
  }
  return stages;
}

const ScheduleRuns *find_mode(const SceneComparison &comparison, Mode mode) {
  for (const ScheduleRuns &schedule : comparison.schedules)
    if (schedule.mode == mode) return &schedule;
  return nullptr;
}

/// Against the recursive runs of the same scene, where there are any.
std::optional<MedianInterval> speed_up(const SceneComparison &comparison,
                                       const ScheduleRuns &schedule) {
  const ScheduleRuns *recursive = find_mode(comparison, Mode::kRecursive);
  if (recursive == nullptr) return std::nullopt;
  return paired_speed_up(wall_seconds_of(*recursive), wall_seconds_of(schedule));
}

double mrays_per_median_second(const ScheduleRuns &schedule) {
  const double seconds = spread_of(wall_seconds_of(schedule)).median;
  return static_cast<double>(schedule.runs.front().rays.total()) / seconds * 1e-6;
}

/// Processor time over wall time of the runs on one thread: below 1 when others used the processor.
double processor_share(const SceneComparison &comparison) {
  double cpu = 0, wall = 0;
  for (const ScheduleRuns &schedule : comparison.schedules) {
    if (schedule.threads != 1) continue;
    for (const RunStats &run : schedule.runs) {
      cpu += run.cpu_s;
      wall += run.wall_s;
    }
  }
  return wall > 0 ? cpu / wall : kUnknown;
}

}  // namespace

double lane_utilisation(const ScheduleRuns &schedule) {
  if (schedule.mode == Mode::kDepthFirst || schedule.mode == Mode::kRecursive) return kUnknown;
  double useful = 0, all = 0;
  for (const StageStats &stage : median_stages(schedule)) {
    if (!is_simd(stage) || stage.lanes_total == 0) continue;
    useful += stage.seconds * utilisation_of(stage);
    all += stage.seconds;
  }
  return all > 0 ? useful / all : kUnknown;
}

bool has_equal_bits(const SceneComparison &comparison) {
  const auto equal = [](const ScheduleRuns &schedule) {
    return schedule.mode == Mode::kRecursive || schedule.differences.num_different == 0;
  };
  return std::all_of(comparison.schedules.begin(), comparison.schedules.end(), equal) &&
         std::all_of(comparison.scaling.begin(), comparison.scaling.end(), equal);
}

// ---- text --------------------------------------------------------------------------------------

namespace {

std::string percent(double share) {
  return std::isnan(share) ? "-" : fmt::format("{:.1f} %", 100 * share);
}

std::string spread_text(const Spread &s) {
  return fmt::format("{:.3f} ({:.3f}-{:.3f})", s.median, s.min, s.max);
}

std::string interval_text(const std::optional<MedianInterval> &ratio) {
  if (!ratio) return "-";
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", ratio->median, ratio->lo, ratio->hi);
}

std::string differences_text(const FilmDifferences &d) {
  if (d.num_different == 0) return "0";
  return fmt::format("{} (rel. {:.1e})", d.num_different, d.largest_relative);
}

std::string heading(const SceneComparison &c) {
  const ScheduleRuns &first = c.schedules.front();
  return fmt::format("{}: {} x {} pixels, {} spp, depth {}, {}, {} thread{}, {} run{} in turn\n",
                     c.scene, c.width, c.height, c.spp, c.max_depth, c.isa, first.threads,
                     first.threads == 1 ? "" : "s", first.runs.size(),
                     first.runs.size() == 1 ? "" : "s");
}

std::string coverage_title(const SceneComparison &c) {
  const MedianInterval any = median_interval(wall_seconds_of(c.schedules.front()));
  return fmt::format("speed-up [{} interval]", percent(any.coverage));
}

constexpr char kScheduleRow[] = "{:<13}{:>23}{:>28}{:>9}{:>23}{:>9}\n";

std::string schedule_table(const SceneComparison &c) {
  std::string text = fmt::format(kScheduleRow, "schedule", "seconds (min-max)", coverage_title(c),
                                 "Mray/s", "pixels that differ", "lanes");
  for (const ScheduleRuns &s : c.schedules)
    text += fmt::format(kScheduleRow, mode_name(s.mode), spread_text(spread_of(wall_seconds_of(s))),
                        interval_text(speed_up(c, s)),
                        fmt::format("{:.2f}", mrays_per_median_second(s)),
                        differences_text(s.differences), percent(lane_utilisation(s)));
  return text;
}

constexpr char kStageRow[] = "  {:<18}{:>9}{:>9}{:>12}{:>10}{:>9}\n";

std::string stage_table(const ScheduleRuns &wavefront) {
  const std::vector<StageStats> stages = median_stages(wavefront);
  double total = 0;
  for (const StageStats &stage : stages) total += stage.seconds;
  std::string text =
      fmt::format(kStageRow, "wavefront stage", "seconds", "share", "items", "ns/item", "lanes");
  for (const StageStats &stage : stages)
    text += fmt::format(
        kStageRow, stage.name, fmt::format("{:.4f}", stage.seconds), percent(stage.seconds / total),
        stage.items, fmt::format("{:.1f}", stage.seconds * 1e9 / static_cast<double>(stage.items)),
        is_simd(stage) ? percent(utilisation_of(stage)) : "-");
  return text;
}

constexpr char kScalingRow[] = "  {:<18}{:>23}{:>28}{:>23}\n";

std::string scaling_table(const SceneComparison &c, const ScheduleRuns &first) {
  std::string text = fmt::format(kScalingRow, "wavefront threads", "seconds (min-max)",
                                 coverage_title(c), "pixels that differ");
  const auto row = [&](const ScheduleRuns &s) {
    return fmt::format(kScalingRow, s.threads, spread_text(spread_of(wall_seconds_of(s))),
                       interval_text(paired_speed_up(wall_seconds_of(first), wall_seconds_of(s))),
                       differences_text(s.differences));
  };
  text += row(first);
  for (const ScheduleRuns &s : c.scaling) text += row(s);
  return text;
}

std::string notes(const SceneComparison &c) {
  constexpr double kIdleMachine = 0.97;
  std::string text;
  if (!has_equal_bits(c))
    text += "  NOT EQUAL: a schedule that must have the bits of depth-first has not\n";
  const double share = processor_share(c);
  if (share < kIdleMachine)
    text += fmt::format("  note: only {} of the time on the processor; is the machine busy?\n",
                        percent(share));
  const std::int64_t invalid = c.schedules.front().runs.front().invalid.count;
  if (invalid > 0) text += fmt::format("  note: {} samples were not finite\n", invalid);
  return text;
}

/// Median speed-ups of a mode over the scenes that have it.
std::vector<double> speed_ups(const std::vector<SceneComparison> &comparisons, Mode mode) {
  std::vector<double> result;
  for (const SceneComparison &c : comparisons)
    if (const ScheduleRuns *schedule = find_mode(c, mode))
      if (const auto ratio = speed_up(c, *schedule)) result.push_back(ratio->median);
  return result;
}

}  // namespace

std::string compare_text(const SceneComparison &c) {
  const ScheduleRuns *wavefront = find_mode(c, Mode::kWavefront);
  std::string text = heading(c) + schedule_table(c);
  if (wavefront != nullptr) text += stage_table(*wavefront);
  if (wavefront != nullptr && !c.scaling.empty()) text += scaling_table(c, *wavefront);
  return text + notes(c);
}

std::string compare_summary_text(const std::vector<SceneComparison> &comparisons) {
  if (comparisons.size() < 2) return "";
  std::string text;
  for (const ScheduleRuns &schedule : comparisons.front().schedules) {
    const std::vector<double> ratios = speed_ups(comparisons, schedule.mode);
    if (ratios.empty() || schedule.mode == Mode::kRecursive) continue;
    const auto lowest = std::min_element(ratios.begin(), ratios.end());
    text += fmt::format("  {:<13}{:>8.3f}   lowest {:.3f}: {}\n", mode_name(schedule.mode),
                        geometric_mean(ratios), *lowest,
                        comparisons[static_cast<std::size_t>(lowest - ratios.begin())].scene);
  }
  if (text.empty()) return "";
  return fmt::format("speed-up over recursive, geometric mean of {} scenes\n", comparisons.size()) +
         text;
}

// ---- JSON --------------------------------------------------------------------------------------

namespace {

/// As the kernel names it; empty where it does not.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name"))
      return line.substr(std::min(line.size(), line.find(':') + 2));
  return "";
}

Json interval_json(const std::optional<MedianInterval> &ratio) {
  if (!ratio) return nullptr;
  return {{"median", ratio->median},
          {"lo", ratio->lo},
          {"hi", ratio->hi},
          {"coverage", ratio->coverage}};
}

Json seconds_json(const ScheduleRuns &schedule) {
  const std::vector<double> runs = wall_seconds_of(schedule);
  const Spread spread = spread_of(runs);
  return {{"median", spread.median}, {"min", spread.min}, {"max", spread.max}, {"runs", runs}};
}

Json cpu_seconds_json(const ScheduleRuns &schedule) {
  Json runs = Json::array();
  for (const RunStats &run : schedule.runs) runs.push_back(run.cpu_s);
  return runs;
}

Json stages_json(const ScheduleRuns &schedule) {
  Json list = Json::array();
  for (const StageStats &stage : median_stages(schedule))
    list.push_back({{"name", stage.name},
                    {"seconds", stage.seconds},
                    {"items", stage.items},
                    {"lanes_active", stage.lanes_active},
                    {"lanes_total", stage.lanes_total},
                    {"utilisation", utilisation_of(stage)}});
  return list;
}

Json schedule_json(const ScheduleRuns &schedule, const std::optional<MedianInterval> &ratio) {
  const RunStats &run = schedule.runs.front();
  return {{"mode", mode_name(schedule.mode)},
          {"threads", schedule.threads},
          {"seconds", seconds_json(schedule)},
          {"cpu_s", cpu_seconds_json(schedule)},
          {"speed_up", interval_json(ratio)},
          {"rays",
           {{"camera", run.rays.camera}, {"bounce", run.rays.bounce}, {"shadow", run.rays.shadow}}},
          {"mrays_per_s", mrays_per_median_second(schedule)},
          {"num_different", schedule.differences.num_different},
          {"largest_relative_difference", schedule.differences.largest_relative},
          {"utilisation", lane_utilisation(schedule)},
          {"stages", stages_json(schedule)},
          {"invalid", run.invalid.count}};
}

Json scaling_json(const SceneComparison &c) {
  Json list = Json::array();
  const ScheduleRuns *first = find_mode(c, Mode::kWavefront);
  if (first == nullptr || c.scaling.empty()) return list;
  const auto add = [&](const ScheduleRuns &s) {
    list.push_back(schedule_json(s, paired_speed_up(wall_seconds_of(*first), wall_seconds_of(s))));
  };
  add(*first);
  for (const ScheduleRuns &s : c.scaling) add(s);
  return list;
}

Json scene_json(const SceneComparison &c) {
  Json schedules = Json::array();
  for (const ScheduleRuns &s : c.schedules) schedules.push_back(schedule_json(s, speed_up(c, s)));
  return {{"scene", c.scene},
          {"isa", c.isa},
          {"width", c.width},
          {"height", c.height},
          {"spp", c.spp},
          {"max_depth", c.max_depth},
          {"wave_size", c.wave_size},
          {"tile_size", c.tile_size},
          {"num_runs", c.schedules.front().runs.size()},
          {"setup_s", c.setup_s},
          {"processor_share", processor_share(c)},
          {"equal_bits", has_equal_bits(c)},
          {"schedules", schedules},
          {"scaling", scaling_json(c)}};
}

}  // namespace

std::string compare_json(const std::vector<SceneComparison> &comparisons) {
  Json scenes = Json::array(), means = Json::object();
  for (const SceneComparison &c : comparisons) scenes.push_back(scene_json(c));
  for (const ScheduleRuns &schedule : comparisons.front().schedules) {
    const std::vector<double> ratios = speed_ups(comparisons, schedule.mode);
    if (!ratios.empty()) means[mode_name(schedule.mode)] = geometric_mean(ratios);
  }
  const Json json = {{"version", version()},    {"processor", processor_name()},
                     {"compiler", __VERSION__}, {"embree", Accel::library_version()},
                     {"scenes", scenes},        {"geometric_mean_speed_up", means}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace phalanx
