// The ranks of one run: this process and those that mpirun started beside it. All that is known of MPI is
// in mpi.cpp.
//
// Collective calls are for the start: after a rank was lost they would never return. From then on ranks
// only send, without waiting, and look what has arrived.
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace phalanx {

struct Message {
  int from = 0, tag = 0;
  std::vector<std::byte> bytes;
};

/// The number of this process among those that a launcher (mpirun, srun) started, from the environment
/// alone: known before anything is initialised. 0 for a process that was started on its own.
int launched_rank();

/// Only one thread may call this.
class Ranks {
 public:
  /// Started on its own: rank 0 of 1, and MPI is not touched. Started by a launcher: initialises MPI.
  /// Throws InputError if several were launched and this program was built without MPI.
  Ranks();
  /// Ends MPI; waits for the other ranks, but not for those that were lost.
  ~Ranks();
  Ranks(const Ranks &) = delete;
  Ranks &operator=(const Ranks &) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }

  // For the start, by all ranks in the same order.

  /// Rank 0's bytes arrive in `bytes` of the others.
  void broadcast(std::span<std::byte> bytes);
  /// On rank 0: everybody's bytes, by rank. On others: nothing.
  std::vector<std::vector<std::byte>> gather(std::span<const std::byte> bytes);

  // Afterwards.

  /// Returns at once. A checksum goes along.
  void send(int to, int tag, std::vector<std::byte> bytes);
  /// What has arrived, if anything. Messages that were damaged are dropped, and counted.
  std::optional<Message> receive();
  int num_damaged() const { return num_damaged_; }
  /// Seconds spent in send() and receive().
  double seconds() const { return seconds_; }
  /// What was sent to a lost rank and has not left is no longer waited for.
  void give_up(int rank);
  /// Waits until what was sent has left, but for `at_most_s`.
  void flush(double at_most_s);
  /// If MPI does not end within `seconds` from now, because ranks were lost, the process does, with
  /// `exit_code`.
  void limit_ending(double seconds, int exit_code);

 private:
  struct Library;
  std::unique_ptr<Library> library_;  // none: alone
  int rank_ = 0, size_ = 1;
  int num_damaged_ = 0;
  double seconds_ = 0;
};

}  // namespace phalanx
