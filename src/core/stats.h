// What a run measured: the figures behind --report, the progress line and the benches.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace phalanx {

/// Samples that were not finite numbers: how many, and where the first one was. First is the lowest
/// sample number, then the lowest y, then the lowest x: the same for any order of tiles.
struct InvalidSamples {
  std::int64_t count = 0;
  int x = -1, y = -1;        // pixel of the full picture; -1 while count is 0
  std::int64_t sample = -1;

  void add(int pixel_x, int pixel_y, std::int64_t sample_number);
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

/// What was known of the error after some passes. relMSE with its 95 % interval.
struct ErrorCheck {
  int spp = 0;
  double wall_s = 0;           // since rendering started
  double relmse = 0, lo95 = 0, hi95 = 0;
};

struct RunStats {
  std::string mode, isa;
  int threads = 1, ranks = 1;
  int spp = 0;                 // done, for every pixel
  std::string stopped_by;      // "spp", "time", "target" or "signal"
  double setup_s = 0;          // reading, building, Embree commit
  double wall_s = 0, cpu_s = 0;  // rendering alone
  RayCounts rays;
  std::vector<StageStats> stages;
  InvalidSamples invalid;
  std::vector<ErrorCheck> checks;  // with replicates: see is_error_check, and at the end
  double check_s = 0;              // spent on them, part of wall_s
  double samples_per_pixel = 0;    // mean over pixels: spp, unless sampling is adaptive
  double pilot_s = 0;              // adaptive: part of wall_s
  int pilot_spp = 0;               // adaptive: samples that only chose where others go
  std::int64_t wave_bytes_per_thread = 0;  // everything a thread allocates beyond scene and film
};

}  // namespace phalanx
