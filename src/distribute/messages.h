// What ranks say to each other, as bytes.
#pragma once
#include <cstddef>
#include <span>
#include <vector>

#include "../core/stats.h"
#include "crew.h"

namespace phalanx {

enum MessageTag {
  kTagAlive = 1,   // both ways: nothing new
  kTagWork,        // rank 0 to others: a lease
  kTagFinished,    // to rank 0
  kTagFailed,      // to rank 0: cannot go on, and why
  kTagEnd,         // rank 0 to others: all is done
  kTagFarewell     // to rank 0: the last figures
};

struct FinishedMessage {
  Finished finished;
  RankStats figures;  // of the sender, so far
};
struct Farewell {
  RankStats figures;
  std::int64_t wave_bytes_per_thread = 0;
  std::vector<StageStats> stages;
};

// Readers throw std::exception for bytes that are not what they should be.
std::vector<std::byte> bytes_of(const Work &work);
Work read_work(std::span<const std::byte> bytes);
std::vector<std::byte> bytes_of(const FinishedMessage &message);
FinishedMessage read_finished(std::span<const std::byte> bytes);
std::vector<std::byte> bytes_of(const Farewell &farewell);
Farewell read_farewell(std::span<const std::byte> bytes);

}  // namespace phalanx
