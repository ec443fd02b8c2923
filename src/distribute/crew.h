// The threads of a rank that render: they take leases from a list and put what came out on another.
#pragma once
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "../render/tile_renderer.h"
#include "lease_book.h"

namespace phalanx {

/// A lease, and what the film knows of the tile so far: nothing before its first sample.
struct Work {
  Lease lease;
  std::vector<std::byte> film;  // Film::region_bytes(), or empty
};

/// What it came to: a function of the work alone.
struct Finished {
  Lease lease;
  std::vector<std::byte> film;
  RayCounts rays;
  InvalidSamples invalid;
  double seconds = 0;           // of one thread
};

/// Renders a lease, on thread `thread` of `tiles`. False if `stop` came true meanwhile.
bool render_lease(TileRenderer &tiles, const Plan &plan, const Work &work, int thread,
                  const std::atomic<bool> &stop, Finished &finished);

class Crew {
 public:
  /// Starts plan.threads threads. `tiles` and `plan` have to outlive it.
  Crew(TileRenderer &tiles, const Plan &plan);
  ~Crew() { stop(); }
  Crew(const Crew &) = delete;
  Crew &operator=(const Crew &) = delete;

  void give(Work work);
  /// What has been finished since the last call; waits up to `wait_s` if that is nothing. Rethrows what
  /// went wrong in a thread.
  std::vector<Finished> take(double wait_s);
  /// Leaves unfinished leases; returns when all threads have ended, at most a pass of a tile later.
  void stop();

  double busy_s() const { return busy_ns_ * 1e-9 / threads_; }        // mean over the threads
  double cpu_s() const { return cpu_ns_ * 1e-9 / threads_; }
  double waiting_s() const { return waiting_ns_ * 1e-9 / threads_; }

 private:
  void run(int thread);

  TileRenderer &tiles_;
  const Plan &plan_;
  const int threads_;
  std::mutex mutex_;
  std::condition_variable work_came_, work_done_;
  std::deque<Work> work_;
  std::vector<Finished> finished_;
  std::exception_ptr failure_;
  std::atomic<bool> stop_ = false;
  std::atomic<std::int64_t> busy_ns_ = 0, cpu_ns_ = 0, waiting_ns_ = 0;
  std::thread team_;
};

}  // namespace phalanx
