#include "crew.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <utility>

#include "../core/parallel.h"
#include "../core/timer.h"

namespace phalanx {
namespace {

std::int64_t nanoseconds(double seconds) { return static_cast<std::int64_t>(seconds * 1e9); }

std::int64_t thread_cpu_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

}  // namespace

bool render_lease(TileRenderer &tiles, const Plan &plan, const Work &work, int thread,
                  const std::atomic<bool> &stop, Finished &finished) {
  const double start = wall_seconds();
  const Lease &lease = work.lease;
  Film film(lease.rect, plan.aovs);
  film.set_clamp(plan.clamp);
  if (!work.film.empty()) film.set_region(lease.rect, work.film);
  const RayCounts before = tiles.rays(thread);
  for (int done = lease.first_sample; done < lease.end_sample;) {
    if (stop) return false;
    const auto n = std::min<unsigned>(
        static_cast<unsigned>(plan.samples_per_pass),
        std::bit_floor(static_cast<unsigned>(lease.end_sample - done)));
    tiles.render(lease.rect, {done, std::countr_zero(n)}, thread, film, finished.invalid);
    done += static_cast<int>(n);
  }
  const RayCounts after = tiles.rays(thread);
  finished.lease = lease;
  finished.film = film.region_bytes(lease.rect);
  finished.rays = {after.camera - before.camera, after.bounce - before.bounce,
                   after.shadow - before.shadow};
  finished.seconds = wall_seconds() - start;
  return true;
}

Crew::Crew(TileRenderer &tiles, const Plan &plan)
    : tiles_(tiles), plan_(plan), threads_(plan.threads) {
  team_ = std::thread([this] {
    try {
      parallel_for(threads_, threads_, [this](std::int64_t, int thread) { run(thread); });
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
      work_done_.notify_all();
    }
  });
}

void Crew::run(int thread) {
  for (;;) {
    const double idle_since = wall_seconds();
    Work work;
    {
      std::unique_lock lock(mutex_);
      work_came_.wait(lock, [&] { return stop_ || !work_.empty(); });
      if (stop_) return;
      work = std::move(work_.front());
      work_.pop_front();
    }
    const double start = wall_seconds();
    waiting_ns_ += nanoseconds(start - idle_since);
    Finished finished;
    const std::int64_t cpu_start = thread_cpu_ns();
    if (!render_lease(tiles_, plan_, work, thread, stop_, finished)) return;
    busy_ns_ += nanoseconds(finished.seconds);
    cpu_ns_ += thread_cpu_ns() - cpu_start;
    const std::lock_guard lock(mutex_);
    finished_.push_back(std::move(finished));
    work_done_.notify_all();
  }
}

void Crew::give(Work work) {
  const std::lock_guard lock(mutex_);
  work_.push_back(std::move(work));
  work_came_.notify_one();
}

std::vector<Finished> Crew::take(double wait_s) {
  std::unique_lock lock(mutex_);
  work_done_.wait_for(lock, std::chrono::duration<double>(wait_s),
                      [&] { return failure_ || !finished_.empty(); });
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  return std::exchange(finished_, {});
}

void Crew::stop() {
  if (!team_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    work_came_.notify_all();
  }
  team_.join();
}

}  // namespace phalanx
