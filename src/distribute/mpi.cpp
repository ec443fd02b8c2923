// The one file that knows MPI. Without it (PHALANX_MPI is OFF) a program is always alone.
#include "ranks.h"

#include <cstdlib>
#include <cstring>

#include "../core/crc32c.h"
#include "../core/error.h"
#include "../core/timer.h"

#ifdef PHALANX_MPI
#define OMPI_SKIP_MPICXX 1  // the C++ bindings of old are not used
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <list>
#include <thread>
#endif

namespace phalanx {
namespace {

int number_in(const char *variable) {
  const char *const text = std::getenv(variable);
  return text != nullptr ? std::atoi(text) : -1;
}

/// Open MPI; MPICH and Intel MPI; srun --mpi=pmix. At least 0 under a launcher, else -1.
int rank_in_environment() {
  for (const char *variable : {"OMPI_COMM_WORLD_RANK", "PMI_RANK", "PMIX_RANK"})
    if (const int rank = number_in(variable); rank >= 0) return rank;
  return -1;
}

}  // namespace

int launched_rank() { return rank_in_environment() > 0 ? rank_in_environment() : 0; }

#ifdef PHALANX_MPI

namespace {
constexpr std::size_t kPiece = 64u << 20;  // counts of MPI are ints
constexpr double kFlushSeconds = 5;

/// Nothing if the checksum at the end is not the one of the rest.
std::optional<Message> without_checksum(Message message) {
  std::vector<std::byte> &bytes = message.bytes;
  std::uint32_t crc = 0;
  if (bytes.size() < sizeof crc) return std::nullopt;
  std::memcpy(&crc, bytes.data() + bytes.size() - sizeof crc, sizeof crc);
  bytes.resize(bytes.size() - sizeof crc);
  if (crc32c(bytes) != crc) return std::nullopt;
  return message;
}
}  // namespace

struct Ranks::Library {
  struct Sending {
    int to;
    MPI_Request request;
    std::vector<std::byte> bytes;
  };
  std::list<Sending> sending;
  std::list<Sending> abandoned;  // to lost ranks: their memory belongs to MPI for ever
  struct Receiving {
    MPI_Request request;
    Message message;
  };
  std::list<Receiving> receiving;  // what a lost rank has begun stays here

  void forget_sent() {
    for (auto s = sending.begin(); s != sending.end();) {
      int sent = 0;
      MPI_Test(&s->request, &sent, MPI_STATUS_IGNORE);
      s = sent ? sending.erase(s) : std::next(s);
    }
  }
};

Ranks::Ranks() {
  if (rank_in_environment() < 0) return;
  // Shared memory is read by copying through it, not out of a process that may be gone meanwhile.
  setenv("OMPI_MCA_btl_vader_single_copy_mechanism", "none", 0);
  setenv("OMPI_MCA_btl_vader_eager_limit", "65536", 0);  // a tile goes in one piece
  setenv("OMPI_MCA_btl_vader_max_send_size", "65536", 0);
  // No barrier before the end: with lost ranks it may never open.
  setenv("OMPI_MCA_async_mpi_finalize", "1", 0);
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  library_ = std::make_unique<Library>();
}

Ranks::~Ranks() {
  if (!library_) return;
  flush(kFlushSeconds);
  MPI_Finalize();
  // What could not be sent still belongs to MPI.
  static_cast<void>(library_.release());
}

void Ranks::broadcast(std::span<std::byte> bytes) {
  if (!library_) return;
  for (std::size_t at = 0; at < bytes.size(); at += kPiece) {
    const auto piece = bytes.subspan(at, std::min(kPiece, bytes.size() - at));
    MPI_Bcast(piece.data(), static_cast<int>(piece.size()), MPI_BYTE, 0, MPI_COMM_WORLD);
  }
}

std::vector<std::vector<std::byte>> Ranks::gather(std::span<const std::byte> bytes) {
  if (!library_) return {{bytes.begin(), bytes.end()}};
  const int count = static_cast<int>(bytes.size());
  std::vector<int> counts(static_cast<std::size_t>(size_)), offsets(counts.size());
  MPI_Gather(&count, 1, MPI_INT, counts.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  int total = 0;
  for (std::size_t r = 0; r < counts.size() && rank_ == 0; ++r) {
    offsets[r] = total;
    total += counts[r];
  }
  std::vector<std::byte> all(static_cast<std::size_t>(total));
  MPI_Gatherv(bytes.data(), count, MPI_BYTE, all.data(), counts.data(), offsets.data(), MPI_BYTE, 0,
              MPI_COMM_WORLD);
  std::vector<std::vector<std::byte>> each;
  for (std::size_t r = 0; r < counts.size() && rank_ == 0; ++r)
    each.emplace_back(all.begin() + offsets[r], all.begin() + offsets[r] + counts[r]);
  return each;
}

void Ranks::send(int to, int tag, std::vector<std::byte> bytes) {
  const double start = wall_seconds();
  const std::uint32_t crc = crc32c(bytes);
  const auto *const end = reinterpret_cast<const std::byte *>(&crc);
  bytes.insert(bytes.end(), end, end + sizeof crc);
  library_->forget_sent();
  Library::Sending &s = library_->sending.emplace_back();
  s.to = to;
  s.bytes = std::move(bytes);
  MPI_Isend(s.bytes.data(), static_cast<int>(s.bytes.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD,
            &s.request);
  seconds_ += wall_seconds() - start;
}

/// Long messages come in pieces that their sender has to hand over: they are begun, and looked at again.
std::optional<Message> Ranks::receive() {
  if (!library_) return std::nullopt;
  const double start = wall_seconds();
  int arrived = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &arrived, &status);
  if (arrived) {
    int count = 0;
    MPI_Get_count(&status, MPI_BYTE, &count);
    Library::Receiving &r = library_->receiving.emplace_back();
    r.message = {status.MPI_SOURCE, status.MPI_TAG,
                 std::vector<std::byte>(static_cast<std::size_t>(count))};
    MPI_Irecv(r.message.bytes.data(), count, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG,
              MPI_COMM_WORLD, &r.request);
  }
  std::optional<Message> message;
  for (auto r = library_->receiving.begin(); r != library_->receiving.end() && !message;) {
    int is_complete = 0;
    MPI_Test(&r->request, &is_complete, MPI_STATUS_IGNORE);
    const auto next = std::next(r);
    if (is_complete) {
      message = without_checksum(std::move(r->message));
      if (!message) ++num_damaged_;
      library_->receiving.erase(r);
    }
    r = next;
  }
  if (message || arrived) seconds_ += wall_seconds() - start;
  return message;
}

void Ranks::give_up(int rank) {
  for (auto s = library_->sending.begin(); s != library_->sending.end();) {
    const auto next = std::next(s);
    if (s->to == rank)
      library_->abandoned.splice(library_->abandoned.end(), library_->sending, s);
    s = next;
  }
}

void Ranks::flush(double at_most_s) {
  if (!library_) return;
  const double start = wall_seconds();
  for (;;) {
    library_->forget_sent();
    if (library_->sending.empty() || wall_seconds() - start > at_most_s) return;
    usleep(200);
  }
}

void Ranks::limit_ending(double seconds, int exit_code) {
  if (!library_) return;
  std::thread([=] {
    usleep(static_cast<useconds_t>(seconds * 1e6));
    _exit(exit_code);
  }).detach();
}

#else

struct Ranks::Library {};

Ranks::Ranks() {
  const bool several = number_in("OMPI_COMM_WORLD_SIZE") > 1 || number_in("PMI_SIZE") > 1 ||
                       rank_in_environment() > 0;
  if (several)
    throw InputError("several ranks were launched, but this program was built without MPI "
                     "(CMake option PHALANX_MPI)");
}
Ranks::~Ranks() = default;
void Ranks::broadcast(std::span<std::byte>) {}
std::vector<std::vector<std::byte>> Ranks::gather(std::span<const std::byte> bytes) {
  return {{bytes.begin(), bytes.end()}};
}
void Ranks::send(int, int, std::vector<std::byte>) {}  // there is nobody
std::optional<Message> Ranks::receive() { return std::nullopt; }
void Ranks::give_up(int) {}
void Ranks::flush(double) {}
void Ranks::limit_ending(double, int) {}

#endif

}  // namespace phalanx
