// When a rendering ends. Decisions fall between passes, on figures of the whole picture: a rule for single
// pixels would stop where nothing bright has been seen yet, and darken the picture.
#pragma once
#include <vector>

#include "../core/stats.h"
#include "../plan/plan.h"

namespace phalanx {

struct BudgetState {
  int spp = 0;            // done, whole passes
  int next_spp = 0;       // what the next pass would add
  double elapsed_s = 0;
  bool at_check = false;  // checks.back() belongs to these samples, and is_error_check(spp)
  bool stop_asked = false;
};

/// Upper bounds of the error at or below the target at two checks in a row: one could be luck.
bool is_target_met(const std::vector<ErrorCheck> &checks, double target);

/// Why rendering ends now: "spp", "target", "signal", "time"; nullptr: it goes on. Time is kept by leaving
/// out the pass that would not fit, if it takes as long per sample as those before.
const char *stop_reason(const Plan &plan, const BudgetState &state,
                        const std::vector<ErrorCheck> &checks);

}  // namespace phalanx
