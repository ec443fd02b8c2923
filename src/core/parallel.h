// Threads: OpenMP wrapped once. Every worker computes with the same floating-point mode.
#pragma once
#include <cstdint>
#include <functional>

namespace phalanx {

/// All the threads that OpenMP offers.
int max_threads();

/// Calls work(index, thread) for every index in [0, count), dynamically, on `threads` threads
/// (>= 1). Denormals are flushed to zero in all of them alike. The first exception is rethrown here.
void parallel_for(std::int64_t count, int threads,
                  const std::function<void(std::int64_t index, int thread)> &work);

/// Denormals to zero (FTZ and DAZ) for the calling thread while this lives.
class FlushDenormals {
 public:
  FlushDenormals();
  ~FlushDenormals();

 private:
  unsigned saved_;
};

}  // namespace phalanx
