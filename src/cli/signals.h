// Stopping in good order: the first SIGINT or SIGTERM asks, the second one kills.
#pragma once

namespace phalanx {

/// From now on the first SIGINT or SIGTERM is only remembered. It also restores the default action
/// of both signals, so that a second one ends the program at once.
void catch_stop_signals();

/// The signal that was caught, or 0.
int stop_signal();

}  // namespace phalanx
