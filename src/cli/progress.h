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

/// `64 spp in 12.3 s (0.4 s set-up) | 8.3 Mray/s | relMSE 3.1e-3 [2.7e-3, 3.6e-3]`
std::string summary_line(const RunStats &stats, const ErrorEstimate &error);

class ProgressDisplay {
 public:
  ProgressDisplay(ProgressStyle style, bool stratified) : style_(style), stratified_(stratified) {}

  void update(const Progress &progress, const Film &film);
  /// Clears the updating line and prints the summary.
  void finish(const RunStats &stats, const ErrorEstimate &error);

 private:
  void refresh_estimate(const Progress &progress, const Film &film);

  ProgressStyle style_;
  bool stratified_;
  double last_line_s_ = 0;  // elapsed time of the last line in a log
  int estimate_spp_ = 0;    // whole passes the estimate knows of
  double estimate_s_ = 0;   // elapsed time at the last estimate
  double relmse_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace phalanx
