// Who renders what: tiles are leased to ranks, sample after sample, until all have enough.
//
// A lease says: tile, first sample, end. What comes back is a function of those alone, so a lease may be
// given out again at any time, and the first answer is as good as any other. The book knows neither
// messages nor clocks; callers say what time it is.
#pragma once
#include <cstdint>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include "../film/film.h"

namespace phalanx {

struct Lease {
  std::int64_t id = -1;
  Rect rect;
  std::int32_t first_sample = 0, end_sample = 0;  // of each pixel
};

/// A part of the picture whose pixels all have the same samples.
struct BookTile {
  Rect rect;
  int owner = -1;      // the only rank that gets it; -1: any
  int samples = 0;     // that its pixels have
};

class LeaseBook {
 public:
  struct Terms {
    int samples = 16;         // of a pixel at a time; leases are multiples, but for the last
    double longest_s = 0.3;   // so that little is lost with a rank, or when a signal comes
    double smallest_s = 2e-3; // a tile is not split to get below this,
    double message_s = 5e-5;  // nor below this times all threads: rank 0 has to keep up
    double even_s = 10;       // with more than this left, no tile gets far ahead of others
    int smallest_side = 8;    // pixels
    std::int64_t first_id = 1;  // of leases; books in use one after the other must not share any
    double overdue_s = 2;     // a lease this old may be given to a second rank, if nothing else is left
  };

  /// threads[r] (>= 1) says how many leases rank r works on at the same time.
  LeaseBook(std::vector<BookTile> tiles, std::vector<int> threads, Terms terms);

  /// All tiles are to have this many samples. May grow.
  void set_target(int samples);

  /// Something for `rank` to do: of its own tiles or of those for any rank, one with the fewest samples;
  /// among those the most expensive. Nothing if there is nothing left for it.
  std::optional<Lease> grant(int rank, double now);

  /// A lease came back after `seconds` of work. False if somebody else was faster: ignore the answer.
  bool commit(std::int64_t id, double seconds);

  /// The rank is gone: its leases and its tiles are free for others.
  void lose(int rank);
  /// It was not: it takes part again. Its tiles stay free.
  void find(int rank);
  bool is_lost(int rank) const { return lost_[static_cast<std::size_t>(rank)]; }

  /// Every tile has the samples of the target.
  bool done() const { return num_done_ == tiles_.size(); }
  /// Seconds until all leased and free work is done, for all threads that are left together; 0 while
  /// nothing is known.
  double seconds_left() const;
  /// True while tiles wait that `rank` may take; then it pays to give it work in advance.
  bool is_plentiful(int rank) const;
  /// Work that nobody has been given yet.
  bool has_free() const;

  const std::vector<BookTile> &tiles() const { return tiles_; }
  int fewest_samples() const;
  double samples_done() const { return samples_done_; }     // of all pixels together
  double samples_wanted() const;

 private:
  struct Order {  // the first in a pool is leased next
    int samples;
    double minus_cost;
    std::int32_t tile;
    auto operator<=>(const Order &) const = default;
  };
  struct Pool {
    std::set<Order> free;
    double samples = 0;  // pixels times samples that its free tiles still need
  };
  struct Holder {
    int rank;
    double since;
  };
  struct Outstanding {
    Lease lease;
    std::int32_t tile;
    std::vector<Holder> holders;
  };

  static double area(Rect r) { return static_cast<double>(r.width) * r.height; }
  Pool &pool_of(int owner);
  const Pool *pool_for(int rank) const;
  int threads_of_pool(const Pool *pool, int rank) const;
  Order order_of(std::int32_t tile) const;
  void make_free(std::int32_t tile);
  void take(std::int32_t tile);
  void split(std::int32_t tile);
  double pixel_sample_s() const;
  double cost_of_sample(std::int32_t tile) const;
  double shortest_s() const;
  std::optional<Lease> grant_again(int rank, double now);

  std::vector<BookTile> tiles_;
  std::vector<double> sample_s_;  // of a tile: seconds that one sample of all its pixels takes; 0: unknown
  std::vector<int> threads_;
  std::vector<bool> lost_;
  Terms terms_;
  std::vector<Pool> pools_;       // of each rank; the last one is for all
  std::unordered_map<std::int64_t, Outstanding> outstanding_;
  int target_ = 0;
  std::size_t num_done_ = 0;
  std::int64_t next_id_;
  double area_ = 0, samples_done_ = 0, outstanding_samples_ = 0;
  double timed_samples_ = 0, timed_s_ = 0;
};

}  // namespace phalanx
