#include "budget.h"

namespace phalanx {

bool is_target_met(const std::vector<ErrorCheck> &checks, double target) {
  if (checks.size() < 2) return false;
  return checks.back().hi95 <= target && checks[checks.size() - 2].hi95 <= target;
}

const char *stop_reason(const Plan &plan, const BudgetState &state,
                        const std::vector<ErrorCheck> &checks) {
  if (state.spp >= plan.spp) return "spp";
  if (plan.target_error > 0 && state.at_check && is_target_met(checks, plan.target_error))
    return "target";
  if (state.stop_asked) return "signal";
  const double pass_s = state.elapsed_s / state.spp * state.next_spp;
  if (plan.time_limit_s > 0 && state.elapsed_s + pass_s > plan.time_limit_s) return "time";
  return nullptr;
}

}  // namespace phalanx
