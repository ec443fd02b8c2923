#include "statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <numeric>

#include "../report/statistics.h"

namespace phalanx::check {
namespace {

constexpr double kSuiteLevel = 0.01;
constexpr double kLeastExpected = 5;
constexpr double kStrayShare = 1e-5;
constexpr double kIntegralError = 3e-5;  // of a density over all cells

/// Index of the cell of `x` in n cells of [lo, hi], or -1.
int cell_of(double x, double lo, double hi, int n) {
  constexpr double kRounding = 1e-3;
  const double t = (x - lo) / (hi - lo);
  if (!(t >= -kRounding && t <= 1 + kRounding)) return -1;
  return std::clamp(static_cast<int>(t * n), 0, n - 1);
}

/// Sum of (O - E)^2 / E over cells of at least kLeastExpected, and how many those are.
class Pearson {
 public:
  void add(double observed, double expected) {
    observed_ += observed;
    expected_ += expected;
    if (expected_ < kLeastExpected) return;  // waits for the next cell
    close();
  }
  /// What still waits joins no one: it is too small to say anything, unless it is crowded.
  void finish() {
    if (expected_ > 0 || observed_ > 0) {
      expected_ = std::max(expected_, 1.0);
      close();
    }
  }
  double sum = 0;
  int cells = 0;

 private:
  void close() {
    sum += (observed_ - expected_) * (observed_ - expected_) / expected_;
    cells += 1;
    observed_ = expected_ = 0;
  }
  double observed_ = 0, expected_ = 0;
};

}  // namespace

double sidak(double level, int tests) { return -std::expm1(std::log1p(-level) / tests); }
double alpha() { return sidak(kSuiteLevel, kSuiteTests); }
double normal_two_sided(double z) { return std::erfc(std::fabs(z) / std::sqrt(2.0)); }
int num_samples() { return std::getenv("PHALANX_LONG_TESTS") != nullptr ? 4000000 : 1000000; }

void Histogram::add(double x, double y) {
  total_ += 1;
  const int i = cell_of(x, grid_.x0, grid_.x1, grid_.nx);
  const int j = cell_of(y, grid_.y0, grid_.y1, grid_.ny);
  if (i < 0 || j < 0)
    outside_ += 1;
  else
    counts_[static_cast<std::size_t>(i * grid_.ny + j)] += 1;
}

Fit chi_square_fit(const Histogram &observed, const std::vector<double> &masses) {
  Fit fit;
  const double n = static_cast<double>(observed.total());
  fit.mass = std::accumulate(masses.begin(), masses.end(), 0.0);
  std::int64_t invalid = observed.total() - observed.outside();
  std::vector<std::size_t> order(masses.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return masses[a] < masses[b]; });
  Pearson pearson;
  fit.stray = observed.outside();
  for (const std::size_t cell : order) {
    const std::int64_t count = observed.counts()[cell];
    invalid -= count;
    if (!(masses[cell] > 0)) {
      fit.stray = std::max(fit.stray, count);
      continue;
    }
    pearson.add(static_cast<double>(count), n * masses[cell]);
  }
  pearson.finish();
  fit.lost = static_cast<double>(invalid) / n;
  const double lost = static_cast<double>(invalid), due = std::max(n * (1 - fit.mass), 0.0);
  if (lost > 0 || due > kIntegralError * n) {
    // What the integral may be wrong by is not held against the samples.
    const double error = std::max(std::fabs(lost - due) - kIntegralError * n, 0.0);
    pearson.add(std::max(due, kLeastExpected) + error, std::max(due, kLeastExpected));
  }
  fit.statistic = pearson.sum;
  fit.dof = std::max(pearson.cells - 1, 1);
  fit.p = chi_square_upper(fit.statistic, fit.dof);
  if (static_cast<double>(fit.stray) > std::max(kStrayShare * n, 1.0)) fit.p = 0;
  return fit;
}

std::string Fit::text() const {
  return fmt::format(
      "p = {:.3g}, chi2 = {:.1f} with {} dof, density integrates to {:.6f}, lost {:.6f}, {} stray",
      p, statistic, dof, mass, lost, stray);
}

}  // namespace phalanx::check
