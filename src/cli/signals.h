// Stopping in good order: the first SIGINT or SIGTERM asks, the second one kills.
#pragma once

namespace phalanx {

/// From now on the first SIGINT or SIGTERM is only remembered; the next one ends the program at
/// once. Signals within a fifth of a second count as one: timeout(1) and job managers send a signal
/// to the process and to its group.
void catch_stop_signals();

/// The signal that was caught, or 0.
int stop_signal();

/// Has SIGUSR1 arrived since the last call? Only after catch_stop_signals(); before it ends the program.
bool snapshot_requested();

}  // namespace phalanx
