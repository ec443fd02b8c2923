// Schedules timed against each other on the same samples: what was measured, and how it is told.
//
// Runs are taken in turn (A B C D A B C D ...), so that run i of two schedules is a pair: whatever
// slows the machine for a while slows both, and their ratio hardly changes.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "../film/film.h"
#include "../plan/options.h"
#include "../core/stats.h"

namespace phalanx {

// ---- statistics --------------------------------------------------------------------------------

struct Spread {
  double median = 0, min = 0, max = 0;
};

/// Of at least one value. The median of an even number is the mean of the middle two.
Spread spread_of(std::vector<double> values);

/// A median with its interval. `coverage` is the probability, known without any assumption about the
/// distribution (sign test), that [lo, hi] holds the true median: at least 0.95 where that can be
/// had. Fewer than 6 values cannot give it: then [lo, hi] is their range and coverage is below 0.95.
struct MedianInterval {
  double median = 0, lo = 0, hi = 0;
  double coverage = 0;
};

MedianInterval median_interval(std::vector<double> values);

/// Of base[i] / time[i]: how many times as fast as `base`. Both have the same length, at least 1.
MedianInterval paired_speed_up(const std::vector<double> &base, const std::vector<double> &time);

double geometric_mean(const std::vector<double> &values);

/// Pixels whose mean, variance or sample count has any different bit.
struct FilmDifferences {
  std::int64_t num_pixels = 0, num_different = 0;
  double largest_relative = 0;  // max |x - r| / max(|x|, |r|), each over a pixel's channels
};

/// The films have the same crop window.
FilmDifferences film_differences(const Film &film, const Film &reference);

// ---- what was measured -------------------------------------------------------------------------

/// All runs of one schedule. Rays, items and lanes are the same in each; seconds are not.
struct ScheduleRuns {
  Mode mode = Mode::kWavefront;
  int threads = 1;
  std::vector<RunStats> runs;
  FilmDifferences differences;  // from depth-first; of the run that differed most
};

struct SceneComparison {
  std::string scene;  // path as given
  std::string isa;
  int width = 0, height = 0, spp = 0, max_depth = 0, wave_size = 0, tile_size = 0;
  double setup_s = 0;
  std::vector<ScheduleRuns> schedules;  // with the same number of threads and of runs each
  std::vector<ScheduleRuns> scaling;    // wavefront with other numbers of threads
};

/// Of the time spent in SIMD stages, the share of lanes at work. NaN for the scalar schedules.
double lane_utilisation(const ScheduleRuns &schedule);

/// True unless a schedule that must have the bits of depth-first has not: all but recursive.
bool has_equal_bits(const SceneComparison &comparison);

// ---- how it is told ----------------------------------------------------------------------------

/// Tables for people: schedules, stages of the wavefront, thread scaling. Ends with a newline.
std::string compare_text(const SceneComparison &comparison);
/// Over several scenes: geometric means of the speed-ups, and the lowest. Empty for one scene.
std::string compare_summary_text(const std::vector<SceneComparison> &comparisons);
/// The same facts and every single time, for scripts. Unknown numbers are null. Ends with a newline.
std::string compare_json(const std::vector<SceneComparison> &comparisons);

}  // namespace phalanx
