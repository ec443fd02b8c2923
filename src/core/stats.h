// What a run measured: the figures behind --report, the progress line and the benches.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace phalanx {

/// Samples that were no radiance, by kind, and where the first one was. First is the lowest sample number,
/// then the lowest y, then the lowest x: the same for any order of tiles. Samples that --clamp has cut are counted
/// beside them.
struct InvalidSamples {
  std::int64_t count = 0;    // not_finite + negative
  int x = -1, y = -1;        // pixel of the full picture; -1 while count is 0
  std::int64_t sample = -1;
  std::int64_t not_finite = 0;
  std::int64_t negative = 0;  // finite, but a channel is below 0
  std::int64_t clamped = 0;
  double clamped_energy = 0;  // taken off them, sum over samples of the mean of the channels

  enum class Kind { kNotFinite, kNegative };
  void add(int pixel_x, int pixel_y, std::int64_t sample_number, Kind kind = Kind::kNotFinite);
  void merge(const InvalidSamples &other);
};

/// One stage of a schedule, summed over threads. utilisation = lanes_active / lanes_total.
struct StageStats {
  std::string name;
  double seconds = 0;
  std::int64_t items = 0, lanes_active = 0, lanes_total = 0;
};

struct RayCounts {
  std::int64_t camera = 0, bounce = 0, shadow = 0;
  std::int64_t total() const { return camera + bounce + shadow; }
};

/// What one rank did. Seconds are a thread's, on average over the rank's threads.
struct RankStats {
  int rank = 0, threads = 1;
  double busy_s = 0;           // rendering, wall clock
  double cpu_s = 0;            // of busy_s: less where others use the machine, too
  double waiting_s = 0;        // for a tile to render
  double communicating_s = 0;  // packing, sending and receiving, on a thread of its own
  std::int64_t tiles = 0;      // leases that came back
  std::int64_t rays = 0;       // of those leases
  bool lost = false;           // it stopped answering before the end
};

/// Largest busy_s over their mean; 1 where nothing was rendered. Ranks that were lost do not count.
double imbalance(const std::vector<RankStats> &ranks);

/// What was known of the error after some passes. relMSE with its 95 % interval.
struct ErrorCheck {
  int spp = 0;
  double wall_s = 0;           // since rendering started
  double relmse = 0, lo95 = 0, hi95 = 0;
};

struct RunStats {
  std::string mode, isa;
  int threads = 1, ranks = 1;
  std::string balance;         // how tiles were shared among ranks; empty: they were not
  std::vector<RankStats> per_rank;  // empty: rendered without leases
  int resumed_spp = 0;         // samples of each pixel that came from a checkpoint
  std::vector<std::string> warnings;
  int spp = 0;                 // done, for every pixel
  std::string stopped_by;      // "spp", "time", "target" or "signal"
  double setup_s = 0;          // reading, building, Embree commit
  double wall_s = 0, cpu_s = 0;  // rendering alone
  RayCounts rays;
  std::vector<StageStats> stages;
  InvalidSamples invalid;
  double clamp = 0;             // limit that samples were cut to; 0: none
  double clamped_share = 0;     // of the light of the picture, taken off by it, in [0, 1]
  std::vector<ErrorCheck> checks;  // with replicates: see is_error_check, and at the end
  double check_s = 0;              // spent on them, part of wall_s
  double samples_per_pixel = 0;    // mean over pixels: spp, unless sampling is adaptive
  double pilot_s = 0;              // adaptive: part of wall_s
  int pilot_spp = 0;               // adaptive: samples that only chose where others go
  std::int64_t wave_bytes_per_thread = 0;  // everything a thread allocates beyond scene and film
};

}  // namespace phalanx
