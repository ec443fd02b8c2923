// How far a rendering is, on stderr: one updating line on a terminal, a plain line now and then in a
// log file.
#pragma once
#include <limits>
#include <string>

#include "../render/render.h"
#include "../report/estimate.h"

namespace phalanx {

enum class ProgressStyle { kNone, kTerminal, kLog };

/// For stderr as it is: a terminal or not.
ProgressStyle progress_style(bool quiet);

/// `[####....] 45 % | 12.3 s, 15 s left | 128/256 spp | 8.3 Mray/s | relMSE 3.1e-3`; what is not
/// known (spp_total 0, relmse NaN) is left out.
std::string progress_line(const Progress &progress, double relmse);

/// `pass 512 | 41.2 s | relMSE 3.1e-3 [2.7e-3, 3.6e-3] | slope -1.02 | ETA to 1e-3: 88 s | invalid 0`, of the
/// last check of the error: samples per pixel, seconds since rendering started, slope of log relMSE over
/// log seconds, seconds from then until the target is expected to be met ("?" where the slope does not lead
/// there). What is not known is left out. `progress.checks` is not empty.
std::string error_line(const Progress &progress);

/// `64 spp in 12.3 s (0.4 s set-up) | 8.3 Mray/s | relMSE 3.1e-3 [2.7e-3, 3.6e-3]`
/// and with limits other than samples ` | stopped by target` and ` | target 1e-3 met`.
std::string summary_line(const RunStats &stats, const ErrorEstimate &error, double target = 0);

class ProgressDisplay {
 public:
  ProgressDisplay(ProgressStyle style, bool stratified) : style_(style), stratified_(stratified) {}

  void update(const Progress &progress, const Film &film);
  /// Clears the updating line and prints the summary.
  void finish(const RunStats &stats, const ErrorEstimate &error, double target);

 private:
  /// The line to print now; empty: none.
  std::string line_for(const Progress &progress, const Film &film);
  void refresh_estimate(const Progress &progress, const Film &film);

  ProgressStyle style_;
  bool stratified_;
  double last_line_s_ = 0;  // elapsed time of the last line in a log
  std::size_t num_checks_ = 0;  // of which lines were printed
  int estimate_spp_ = 0;    // whole passes the estimate knows of
  double estimate_s_ = 0;   // elapsed time at the last estimate
  double relmse_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace phalanx
