// Per-thread accounting of stages: seconds, items, lanes.
#pragma once
#include <cstdint>
#include <vector>

#include "../../kernels/scene_view.h"
#include "../core/timer.h"
#include "../core/stats.h"

namespace phalanx {

enum Stage {
  kStageGenerate,
  kStageIntersect,
  kStageResolve,
  kStageAov,
  kStageBucket,
  kStageShade,                                          // one per material kind
  kStageView = kStageShade + kNumMaterialKinds,
  kStageEscaped,
  kStageShadow,
  kStageCompact,
  kStageFilm,
  kNumStages
};

const char *stage_name(int stage);

/// Adds up what one thread spends in each stage. lap() charges the time since the last call.
class StageClock {
 public:
  explicit StageClock(int width) : width_(width) {}

  void start() { last_ = wall_seconds(); }
  /// The stage that just ended worked on `items` paths, a gang at a time, out of `slots` that it
  /// looked at.
  void lap(int stage, std::int64_t items) { lap(stage, items, items); }
  void lap(int stage, std::int64_t items, std::int64_t slots) {
    const double now = wall_seconds();
    seconds_[stage] += now - last_;
    items_[stage] += items;
    lanes_[stage] += (slots + width_ - 1) / width_ * width_;
    last_ = now;
  }
  /// Adds this thread's figures to `stages` (kNumStages entries).
  void add_to(std::vector<StageStats> &stages) const {
    for (int s = 0; s < kNumStages; ++s) {
      stages[s].seconds += seconds_[s];
      stages[s].items += items_[s];
      stages[s].lanes_active += items_[s];
      stages[s].lanes_total += lanes_[s];
    }
  }

 private:
  int width_;
  double last_ = 0;
  double seconds_[kNumStages] = {};
  std::int64_t items_[kNumStages] = {}, lanes_[kNumStages] = {};
};

}  // namespace phalanx
