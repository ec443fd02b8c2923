// A thread's wave: the columns that the plan asks for, in one allocation.
#pragma once
#include <cstdint>

#include "../../kernels/path_view.h"
#include "../core/aligned.h"
#include "../plan/plan.h"

namespace phalanx {

/// Columns of a wave of `capacity` paths. What the plan left out is one gang long: kernels never get
/// a null pointer, and never touch it.
class Wave {
 public:
  explicit Wave(const Plan &plan);

  const WaveView &view() const { return view_; }
  std::int64_t bytes() const { return static_cast<std::int64_t>(arena_.bytes()); }
  /// Frees all slots.
  void clear();

 private:
  Arena arena_;
  WaveView view_ = {};
};

}  // namespace phalanx
