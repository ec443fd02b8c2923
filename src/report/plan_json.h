// The plan as JSON: a part of --report, and all of `phalanx plan --json`.
#pragma once
#include <nlohmann/json_fwd.hpp>

#include "../plan/plan.h"

namespace phalanx {

/// What the report says of a plan: kernels, what was left out and why, bytes a path.
nlohmann::ordered_json plan_summary_json(const Plan &plan);

/// Everything about a plan and its memory.
nlohmann::ordered_json plan_json(const Plan &plan, const MemoryPlan &memory);

}  // namespace phalanx
