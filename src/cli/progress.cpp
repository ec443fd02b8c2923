// Composes progress lines.
#include "progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "../report/line_fit.h"
#include "../report/report.h"
#include "text.h"

namespace phalanx {
namespace {

constexpr double kLogInterval = 5;  // seconds between lines in a log
constexpr double kEstimateInterval =
    1;  // seconds between error estimates: they read the whole film
constexpr int kBarWidth = 10;

std::string bar(double fraction) {
  const int filled = static_cast<int>(fraction * kBarWidth);
  return '[' + std::string(filled, '#') + std::string(kBarWidth - filled, '.') + ']';
}

std::string seconds(double s) { return fmt::format("{:.{}f} s", s, s < 100 ? 1 : 0); }

/// So that a long line does not wrap: an updating line must stay one line.
std::size_t terminal_columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
  return known ? size.ws_col - 1u : 79u;
}

}  // namespace

ProgressStyle progress_style(bool quiet) {
  if (quiet) return ProgressStyle::kNone;
  return isatty(STDERR_FILENO) ? ProgressStyle::kTerminal : ProgressStyle::kLog;
}

std::string progress_line(const Progress &progress, double relmse) {
  const double fraction = std::clamp(progress.fraction, 0.0, 1.0);
  std::string line = fmt::format("{} {:.0f} % | {}", bar(fraction), std::floor(fraction * 100),
                                 seconds(progress.elapsed_s));
  if (fraction > 0 && fraction < 1)
    line += fmt::format(", {} left", seconds(progress.elapsed_s * (1 - fraction) / fraction));
  line += progress.spp_total > 0
              ? fmt::format(" | {}/{} spp", progress.spp_done, progress.spp_total)
              : fmt::format(" | {} spp", progress.spp_done);
  if (progress.elapsed_s > 0)
    line += fmt::format(" | {:.1f} Mray/s",
                        static_cast<double>(progress.rays) / progress.elapsed_s * 1e-6);
  if (!std::isnan(relmse)) line += " | relMSE " + text_of_error(relmse);
  return line;
}

std::string error_line(const Progress &progress) {
  const std::vector<ErrorCheck> &checks = *progress.checks;
  const ErrorCheck &last = checks.back();
  std::string line = fmt::format("pass {} | {} | relMSE {}", last.spp, seconds(last.wall_s),
                                 text_of_error(last.relmse));
  if (!std::isnan(last.lo95))
    line += fmt::format(" [{}, {}]", text_of_error(last.lo95), text_of_error(last.hi95));
  const double slope = error_slope(checks);
  if (!std::isnan(slope)) line += fmt::format(" | slope {:.2f}", slope);
  if (progress.target_error > 0) {
    const double eta = seconds_to(checks, slope, progress.target_error);
    line += fmt::format(" | ETA to {}: {}", text_of_target(progress.target_error),
                        std::isnan(eta) ? "?" : seconds(eta));
  }
  return line + fmt::format(" | invalid {}", progress.invalid);
}

std::string summary_line(const RunStats &stats, const ErrorEstimate &error, double target) {
  std::string line = fmt::format("{} spp in {} ({} set-up) | {:.1f} Mray/s", stats.spp,
                                 seconds(stats.wall_s), seconds(stats.setup_s), mrays_per_s(stats));
  if (!std::isnan(error.relmse)) line += " | relMSE " + text_of_error(error.relmse);
  if (!std::isnan(error.lo95))
    line += fmt::format(" [{}, {}]", text_of_error(error.lo95), text_of_error(error.hi95));
  if (!stats.stopped_by.empty() && stats.stopped_by != "spp")
    line += " | stopped by " + stats.stopped_by;
  if (target > 0)
    line += fmt::format(" | target {} {}met", text_of_target(target), error.hi95 <= target ? "" : "not ");
  return line;
}

std::string ProgressDisplay::line_for(const Progress &progress, const Film &film) {
  const bool has_checks = progress.checks != nullptr && !progress.checks->empty();
  if (has_checks) {  // a line for every check; on a terminal the last one stays
    const bool is_new = progress.checks->size() > num_checks_;
    num_checks_ = progress.checks->size();
    return is_new ? error_line(progress) : "";
  }
  const bool due = progress.elapsed_s - last_line_s_ >= kLogInterval;
  if (style_ == ProgressStyle::kLog && !due) return "";
  refresh_estimate(progress, film);
  return progress_line(progress, relmse_);
}

void ProgressDisplay::refresh_estimate(const Progress &progress, const Film &film) {
  const bool due = progress.elapsed_s - estimate_s_ >= kEstimateInterval;
  if (!progress.between_passes || progress.spp_done <= estimate_spp_ || !due) return;
  relmse_ = estimate_error(film, stratified_).relmse;
  estimate_spp_ = progress.spp_done;
  estimate_s_ = progress.elapsed_s;
}

void ProgressDisplay::update(const Progress &progress, const Film &film) {
  if (style_ == ProgressStyle::kNone) return;
  const std::string line = line_for(progress, film);
  if (line.empty()) return;
  if (style_ == ProgressStyle::kTerminal)
    fmt::print(stderr, "\r{}\033[K", line.substr(0, terminal_columns()));
  else
    fmt::print(stderr, "{}\n", line);
  std::fflush(stderr);
  last_line_s_ = progress.elapsed_s;
}

void ProgressDisplay::finish(const RunStats &stats, const ErrorEstimate &error, double target) {
  if (style_ == ProgressStyle::kNone) return;
  if (style_ == ProgressStyle::kTerminal) fmt::print(stderr, "\r\033[K");
  fmt::print(stderr, "{}\n", summary_line(stats, error, target));
}

}  // namespace phalanx
