// The contract with scripts: the keys of --report.
#include "report.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <nlohmann/json.hpp>

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

Json invalid_json(const InvalidSamples &invalid) {
  Json first = nullptr;
  if (invalid.count > 0) first = {{"x", invalid.x}, {"y", invalid.y}, {"sample", invalid.sample}};
  return {{"count", invalid.count}, {"first", first}};
}

/// nlohmann writes NaN and infinities as null.
Json error_json(const ErrorEstimate &error) {
  return {{"relmse_estimate", error.relmse},
          {"lo95", error.lo95},
          {"hi95", error.hi95},
          {"method", error.method}};
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
      {"seed", frame.seed},
      {"max_depth", frame.max_depth},
      {"stopped_by", stats.stopped_by},
      {"resumed_spp", stats.resumed_spp},
      {"warnings", stats.warnings},
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
      {"error", error_json(report.error)},
      {"invalid", invalid_json(stats.invalid)},
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
