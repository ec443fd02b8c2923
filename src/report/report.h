// The report of a run: one value, written as JSON for scripts and as metadata into images.
#pragma once
#include <optional>
#include <string>

#include "../output/image.h"
#include "../plan/plan.h"
#include "estimate.h"
#include "../core/stats.h"

namespace phalanx {

struct Report {
  std::string scene;  // path as given
  const Plan &plan;
  RunStats stats;
  ErrorEstimate error;
  std::optional<double> trace_only_s;  // Embree alone on the same rays; only if it was measured
  std::int64_t peak_rss_bytes = 0;
  std::vector<TileError> tiles = {};  // only with replicates
};

/// Rays of all kinds per second of rendering, in millions.
double mrays_per_s(const RunStats &stats);

/// The most memory this process has held.
std::int64_t peak_rss_bytes();

/// The command that shows the path of the first invalid sample, if there is one.
std::string replay_command(const Report &report);

/// JSON with every key always present; numbers that are not known are null. Ends with a newline.
std::string report_json(const Report &report);

/// The scalar facts of the same report, keys prefixed with "phalanx.".
Metadata report_metadata(const Report &report);

}  // namespace phalanx
