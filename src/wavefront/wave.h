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

/// The columns of a wave, with the bytes that each costs a path; `plan` says what the scene uses.
std::vector<Column> wave_columns(const Plan &plan);

}  // namespace phalanx
