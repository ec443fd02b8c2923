// The contract with scripts: the keys of --report.
#include "report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "../plan/seeds.h"
#include "../scene/sampler_names.h"
#include "line_fit.h"
#include "plan_json.h"
#include "version.h"

namespace phalanx {
namespace {

using Json = nlohmann::ordered_json;

Json stages_json(const std::vector<StageStats> &stages) {
  Json list = Json::array();
  for (const StageStats &stage : stages) {
    Json utilisation = nullptr;
    if (stage.lanes_total > 0)
      utilisation =
          static_cast<double>(stage.lanes_active) / static_cast<double>(stage.lanes_total);
    list.push_back({{"name", stage.name},
                    {"seconds", stage.seconds},
                    {"items", stage.items},
                    {"lanes_active", stage.lanes_active},
                    {"lanes_total", stage.lanes_total},
                    {"utilisation", utilisation}});
  }
  return list;
}

Json invalid_json(const Report &report) {
  const InvalidSamples &invalid = report.stats.invalid;
  Json first = nullptr;
  if (invalid.count > 0)
    first = {{"x", invalid.x}, {"y", invalid.y}, {"sample", invalid.sample}, {"replay", replay_command(report)}};
  return {{"count", invalid.count},
          {"not_finite", invalid.not_finite},
          {"negative", invalid.negative},
          {"first", first}};
}

Json clamp_json(const RunStats &stats) {
  if (!(stats.clamp > 0)) return nullptr;
  return {{"limit", stats.clamp}, {"samples", stats.invalid.clamped}, {"energy_share", stats.clamped_share}};
}

/// "yes", "no", or null where no target was set.
Json target_met_json(const Report &report) {
  if (!(report.plan.target_error > 0)) return nullptr;
  return report.error.hi95 <= report.plan.target_error ? "yes" : "no";
}

Json checks_json(const std::vector<ErrorCheck> &checks) {
  Json list = Json::array();
  for (const ErrorCheck &c : checks)
    list.push_back({{"spp", c.spp}, {"wall_s", c.wall_s}, {"relmse", c.relmse}, {"lo95", c.lo95}, {"hi95", c.hi95}});
  return list;
}

/// Tiles by the half width of the interval of their mean, relative to the mean; the three worst by relMSE.
Json tiles_json(std::vector<TileError> tiles) {
  if (tiles.empty()) return nullptr;
  std::vector<double> widths;
  for (const TileError &t : tiles) widths.push_back(t.mean > 0 ? t.half_width / t.mean : 0);
  std::sort(widths.begin(), widths.end());
  const auto quantile = [&](double q) {
    return widths[static_cast<std::size_t>(q * static_cast<double>(widths.size() - 1))];
  };
  const std::size_t num_worst = std::min<std::size_t>(3, tiles.size());
  std::partial_sort(tiles.begin(), tiles.begin() + static_cast<std::ptrdiff_t>(num_worst), tiles.end(),
                    [](const TileError &a, const TileError &b) { return a.relmse > b.relmse; });
  Json worst = Json::array();
  for (std::size_t i = 0; i < num_worst; ++i)
    worst.push_back({{"x", tiles[i].x}, {"y", tiles[i].y}, {"mean", tiles[i].mean},
                     {"half_width95", tiles[i].half_width}, {"relmse", tiles[i].relmse}});
  return {{"side", 8},
          {"count", widths.size()},
          {"relative_half_width95", {{"p50", quantile(0.5)}, {"p95", quantile(0.95)}, {"max", widths.back()}}},
          {"worst", worst}};
}

/// nlohmann writes NaN and infinities as null.
Json error_json(const Report &report) {
  const ErrorEstimate &error = report.error;
  const RunStats &stats = report.stats;
  return {{"relmse_estimate", error.relmse},
          {"lo95", error.lo95},
          {"hi95", error.hi95},
          {"method", error.method},
          {"replicates", error.replicates},
          {"target", report.plan.target_error > 0 ? Json(report.plan.target_error) : Json(nullptr)},
          {"target_met", target_met_json(report)},
          {"slope", error_slope(stats.checks)},
          {"image_mean", error.image_mean},
          {"image_mean_half_width95", error.image_mean_half_width},
          {"tiles", tiles_json(report.tiles)},
          {"checks", checks_json(stats.checks)},
          {"check_s", stats.check_s}};
}

Json ranks_json(const std::vector<RankStats> &ranks) {
  Json list = Json::array();
  for (const RankStats &r : ranks)
    list.push_back({{"rank", r.rank},
                    {"threads", r.threads},
                    {"busy_s", r.busy_s},
                    {"cpu_s", r.cpu_s},
                    {"waiting_s", r.waiting_s},
                    {"communicating_s", r.communicating_s},
                    {"tiles", r.tiles},
                    {"rays", r.rays},
                    {"lost", r.lost}});
  return list;
}

}  // namespace

double mrays_per_s(const RunStats &stats) {
  return stats.wall_s > 0 ? static_cast<double>(stats.rays.total()) / stats.wall_s * 1e-6 : 0;
}

std::int64_t peak_rss_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;  // Linux counts in KiB
}

std::string replay_command(const Report &report) {
  const InvalidSamples &invalid = report.stats.invalid;
  const FrameView &frame = report.plan.frame;
  // A replicate's samples are those of a picture of its own.
  const int replicates = std::max(1, report.plan.replicates);
  const int seed = report.plan.replicates == 0
                       ? frame.seed
                       : derived_seed(frame.seed, SeedUse::kReplicate,
                                      static_cast<int>(invalid.sample % replicates));
  return fmt::format(
      "phalanx replay {} --pixel {},{} --sample {} --size {}x{} --spp {} --seed {} --max-depth {} --sampler {} "
      "--mode {} --isa {}",
      report.scene, invalid.x, invalid.y, invalid.sample / replicates, frame.width, frame.height, frame.spp, seed,
      frame.max_depth, sampler_name(frame.sampler), report.stats.mode, report.stats.isa);
}

std::string report_json(const Report &report) {
  const RunStats &stats = report.stats;
  const FrameView &frame = report.plan.frame;
  const Rect crop = report.plan.crop;
  const Json json = {
      {"version", version()},
      {"scene", report.scene},
      {"mode", stats.mode},
      {"isa", stats.isa},
      {"threads", stats.threads},
      {"ranks", stats.ranks},
      {"balance", stats.balance.empty() ? Json(nullptr) : Json(stats.balance)},
      {"imbalance", stats.per_rank.empty() ? Json(nullptr) : Json(imbalance(stats.per_rank))},
      {"per_rank", ranks_json(stats.per_rank)},
      {"width", frame.width},
      {"height", frame.height},
      {"crop", {crop.x, crop.y, crop.width, crop.height}},
      {"spp", stats.spp},
      {"samples_per_pixel", stats.samples_per_pixel},
      {"seed", frame.seed},
      {"sampler", sampler_name(frame.sampler)},
      {"max_depth", frame.max_depth},
      {"stopped_by", stats.stopped_by},
      {"resumed_spp", stats.resumed_spp},
      {"warnings", stats.warnings},
      {"time_limit_s", report.plan.time_limit_s > 0 ? Json(report.plan.time_limit_s) : Json(nullptr)},
      {"adaptive", report.plan.adaptive ? Json{{"pilot_spp", stats.pilot_spp}, {"pilot_s", stats.pilot_s}}
                                        : Json(nullptr)},
      {"wall_s", stats.wall_s},
      {"cpu_s", stats.cpu_s},
      {"setup_s", stats.setup_s},
      {"rays",
       {{"camera", stats.rays.camera},
        {"bounce", stats.rays.bounce},
        {"shadow", stats.rays.shadow}}},
      {"mrays_per_s", mrays_per_s(stats)},
      {"stages", stages_json(stats.stages)},
      {"trace_only_s", report.trace_only_s ? Json(*report.trace_only_s) : Json(nullptr)},
      {"error", error_json(report)},
      {"invalid", invalid_json(report)},
      {"clamp", clamp_json(stats)},
      {"plan", plan_summary_json(report.plan)},
      {"peak_rss_bytes", report.peak_rss_bytes},
  };
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Metadata report_metadata(const Report &report) {
  const RunStats &stats = report.stats;
  const FrameView &frame = report.plan.frame;
  const auto number = [](auto x) { return fmt::format("{}", x); };
  return {
      {"phalanx.version", version()},
      {"phalanx.scene", report.scene},
      {"phalanx.mode", stats.mode},
      {"phalanx.isa", stats.isa},
      {"phalanx.threads", number(stats.threads)},
      {"phalanx.ranks", number(stats.ranks)},
      {"phalanx.spp", number(stats.spp)},
      {"phalanx.seed", number(frame.seed)},
      {"phalanx.max_depth", number(frame.max_depth)},
      {"phalanx.stopped_by", stats.stopped_by},
      {"phalanx.wall_s", number(stats.wall_s)},
      {"phalanx.setup_s", number(stats.setup_s)},
      {"phalanx.mrays_per_s", number(mrays_per_s(stats))},
      {"phalanx.relmse_estimate", number(report.error.relmse)},
      {"phalanx.invalid", number(stats.invalid.count)},
  };
}

}  // namespace phalanx
