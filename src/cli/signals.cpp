// The variables that a signal handler may write: the one global state of the program.
#include "signals.h"

#include <atomic>
#include <csignal>
#include <cstdint>
#include <ctime>

namespace phalanx {
namespace {

constexpr std::int64_t kOneSignal = 200'000'000;  // nanoseconds

std::atomic<int> caught = 0;
std::atomic<bool> snapshot = false;
std::atomic<std::int64_t> caught_at = 0;
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
              std::atomic<std::int64_t>::is_always_lock_free);  // or a handler must not use them

std::int64_t nanoseconds() {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return std::int64_t{t.tv_sec} * 1'000'000'000 + t.tv_nsec;
}

void set_action(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  sigaddset(&action.sa_mask, SIGINT);
  sigaddset(&action.sa_mask, SIGTERM);
  action.sa_flags = SA_RESTART;  // writes and reads go on
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void on_signal(int signal) {
  if (caught == 0) {
    caught_at = nanoseconds();
    caught = signal;
  } else if (nanoseconds() - caught_at > kOneSignal) {
    set_action(SIG_DFL);
    std::raise(signal);  // takes effect when this handler returns
  }
}

void on_snapshot(int) { snapshot = true; }

}  // namespace

void catch_stop_signals() {
  set_action(on_signal);
  struct sigaction action = {};
  action.sa_handler = on_snapshot;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;
  sigaction(SIGUSR1, &action, nullptr);
}

bool snapshot_requested() { return snapshot.exchange(false); }

int stop_signal() { return caught; }

}  // namespace phalanx
