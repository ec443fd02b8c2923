// Do samples follow the density that claims to describe them? Chi-square fits with known error rates.
//
// STABILITY B1. Every statistical test of tests/physics rejects at alpha(), which is Sidak's
// correction of 0.01 for kSuiteTests tests: all of them together raise a false alarm with
// probability 0.01 at most, over the choice of the seeds; the seeds are fixed.
// Power with the default 10^6 samples, at that level: a density that is wrong by +-d in every
// other cell is found with probability 0.99 from d = 1.3 % on 10 x 20 cells and 2.9 % on 64 x 128.
// The environment variable PHALANX_LONG_TESTS takes 4 * 10^6 samples and halves both.
#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace phalanx::check {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr int kSuiteTests = 4000;  // at least as many as tests/physics makes

/// Level of one test such that `tests` independent ones reject at `level` together.
double sidak(double level, int tests);
double alpha();
/// P(|Z| > |z|) of a standard normal variable.
double normal_two_sided(double z);
/// Samples of a statistical test.
int num_samples();
/// |a - b| / |b|. (doctest::Approx adds 1 to the scale: of small numbers it forgives everything.)
inline double relative_error(double a, double b) { return std::fabs(a - b) / std::fabs(b); }

/// Mean and standard error of numbers that come one by one (Welford).
class Mean {
 public:
  void add(double x) {
    n_ += 1;
    const double d = x - mean_;
    mean_ += d / static_cast<double>(n_);
    m2_ += d * (x - mean_);
  }
  double mean() const { return mean_; }
  double variance() const { return m2_ / static_cast<double>(n_ - 1); }
  double standard_error() const { return std::sqrt(variance() / static_cast<double>(n_)); }
  /// Two-sided p-value of `expected` being the true mean. `slack`: a difference that is forgiven.
  double p(double expected, double slack = 0) const {
    const double off = std::fmax(std::fabs(mean_ - expected) - slack, 0);
    return off == 0 ? 1 : normal_two_sided(off / standard_error());
  }

 private:
  std::int64_t n_ = 0;
  double mean_ = 0, m2_ = 0;
};

// ---- integrals ----------------------------------------------------------------------------------

/// Adaptive Simpson over [a, b]; stops at absolute error `eps` or after `depth` halvings.
template <typename F>
double integrate(const F &f, double a, double b, double eps, int depth) {
  struct Local {
    const F &f;
    double refine(double a, double b, double fa, double fm, double fb, double whole, double eps,
                  int depth) const {
      const double m = 0.5 * (a + b), fl = f(0.5 * (a + m)), fr = f(0.5 * (m + b));
      const double left = (m - a) / 6 * (fa + 4 * fl + fm),
                   right = (b - m) / 6 * (fm + 4 * fr + fb);
      const double error = left + right - whole;
      if (depth <= 0 || std::fabs(error) <= 15 * eps) return left + right + error / 15;
      return refine(a, m, fa, fl, fm, left, eps / 2, depth - 1) +
             refine(m, b, fm, fr, fb, right, eps / 2, depth - 1);
    }
  };
  const double fa = f(a), fm = f(0.5 * (a + b)), fb = f(b);
  return Local{f}.refine(a, b, fa, fm, fb, (b - a) / 6 * (fa + 4 * fm + fb), eps, depth);
}

/// Adaptive Simpson over a rectangle.
template <typename F>
double integrate(const F &f, double x0, double x1, double y0, double y1, double eps, int depth) {
  const auto row = [&](double x) {
    return integrate([&](double y) { return f(x, y); }, y0, y1, eps / (x1 - x0), depth);
  };
  return integrate(row, x0, x1, eps, depth);
}

// ---- fits ---------------------------------------------------------------------------------------

/// A rectangle of parameters, such as (cos theta, phi), cut into cells of equal size.
struct Grid {
  int nx, ny;
  double x0, x1, y0, y1;
  int cells() const { return nx * ny; }
};

inline Grid hemisphere_grid(int nx, int ny) { return {nx, ny, 0, 1, 0, 2 * kPi}; }
inline Grid sphere_grid(int nx, int ny) { return {nx, ny, -1, 1, 0, 2 * kPi}; }
inline double azimuth(double x, double y) {
  const double phi = std::atan2(y, x);
  return phi < 0 ? phi + 2 * kPi : phi;
}

/// How often samples fell into each cell of a grid, and how many were no samples at all.
class Histogram {
 public:
  explicit Histogram(Grid grid) : grid_(grid), counts_(static_cast<std::size_t>(grid.cells())) {}
  /// Points outside the grid by less than 10^-3 of its size (rounding) count in the nearest cell.
  void add(double x, double y);
  void add_invalid() { total_ += 1; }
  const Grid &grid() const { return grid_; }
  const std::vector<std::int64_t> &counts() const { return counts_; }
  std::int64_t total() const { return total_; }
  std::int64_t outside() const { return outside_; }

 private:
  Grid grid_;
  std::vector<std::int64_t> counts_;
  std::int64_t total_ = 0, outside_ = 0;
};

/// Integral of density(x, y) over each cell. Large cells are cut so that narrow features are seen.
template <typename F>
std::vector<double> cell_masses(const Grid &grid, const F &density) {
  constexpr int kLeastRows = 64;
  constexpr double kError = 1e-5;  // of the sum
  const int cut_x = (kLeastRows + grid.nx - 1) / grid.nx, nx = grid.nx * cut_x;
  const int cut_y = (kLeastRows + grid.ny - 1) / grid.ny, ny = grid.ny * cut_y;
  const double dx = (grid.x1 - grid.x0) / nx, dy = (grid.y1 - grid.y0) / ny;
  std::vector<double> masses(static_cast<std::size_t>(grid.cells()));
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      masses[static_cast<std::size_t>(i / cut_x * grid.ny + j / cut_y)] +=
          integrate(density, grid.x0 + i * dx, grid.x0 + (i + 1) * dx, grid.y0 + j * dy,
                    grid.y0 + (j + 1) * dy, kError / (nx * ny), 6);
  return masses;
}

struct Fit {
  double p = 0;  // of the chi-square test; 0 where samples fell where none may
  double statistic = 0;
  int dof = 0;
  double mass = 0;         // integral of the density
  double lost = 0;         // fraction of samples that were invalid: 1 - mass is expected
  std::int64_t stray = 0;  // samples in the worst cell of mass 0
  bool accepted() const { return p >= alpha(); }
  std::string text() const;
};

/// Pearson's test. Cells that expect fewer than 5 samples are pooled, smallest first; invalid
/// samples are a cell of their own that expects 1 - sum of masses; a cell of mass 0 with more than
/// 10^-5 of the samples, or as many outside the grid, fails.
Fit chi_square_fit(const Histogram &observed, const std::vector<double> &masses);

}  // namespace phalanx::check
