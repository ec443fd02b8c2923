// The one variable that a signal handler may write.
#include "signals.h"

#include <csignal>

namespace phalanx {
namespace {

volatile std::sig_atomic_t caught = 0;

void set_action(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;  // writes and reads go on
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

void remember(int signal) {
  caught = signal;
  set_action(SIG_DFL);
}

}  // namespace

void catch_stop_signals() { set_action(remember); }

int stop_signal() { return caught; }

}  // namespace phalanx
