// Field by field, with the names used everywhere else.
#include "plan_json.h"

#include <nlohmann/json.hpp>

namespace phalanx {
namespace {

using Json = nlohmann::ordered_json;

Json left_out_json(const std::vector<LeftOut> &items) {
  Json list = Json::array();
  for (const LeftOut &item : items)
    list.push_back({{"feature", item.feature},
                    {"reason", item.reason},
                    {"bytes_per_path", item.bytes_per_path}});
  return list;
}

Json columns_json(const std::vector<Column> &columns) {
  Json list = Json::array();
  for (const Column &column : columns)
    list.push_back({{"name", column.name}, {"bytes", column.bytes}});
  return list;
}

}  // namespace

Json plan_summary_json(const Plan &plan) {
  return {{"kernels", plan.kernels},
          {"left_out", left_out_json(plan.left_out)},
          {"bytes_per_path", plan.bytes_per_path()}};
}

Json plan_json(const Plan &plan, const MemoryPlan &memory) {
  const Rect crop = plan.crop;
  Json json = {{"width", plan.frame.width},
               {"height", plan.frame.height},
               {"crop", {crop.x, crop.y, crop.width, crop.height}},
               {"spp", plan.spp},
               {"time_limit_s", plan.time_limit_s},
               {"target_error", plan.target_error},
               {"replicates", plan.replicates},
               {"adaptive", plan.adaptive},
               {"seed", plan.frame.seed},
               {"max_depth", plan.frame.max_depth},
               {"threads", plan.threads},
               {"wave_size", plan.wave_size},
               {"tile_size", plan.tile_size},
               {"samples_per_pass", plan.samples_per_pass}};
  json.update(plan_summary_json(plan));
  json["columns"] = columns_json(plan.columns);
  json["wave_bytes_per_thread"] = plan.wave_bytes();
  json["memory_bytes"] = {{"scene", memory.scene},
                          {"film", memory.film},
                          {"waves", memory.waves},
                          {"accel_estimate", memory.accel_estimate},
                          {"replicates", memory.replicates},
                          {"pilot", memory.pilot},
                          {"total", memory.total()}};
  return json;
}

}  // namespace phalanx
