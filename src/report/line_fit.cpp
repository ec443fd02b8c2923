// Weighted least squares, and what follows from it.
#include "line_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace phalanx {
namespace {
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
}

LineFit fit_line(const std::vector<double> &x, const std::vector<double> &y,
                 const std::vector<double> &weight) {
  double sum = 0, mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sum += weight[i];
    mean_x += weight[i] * x[i];
    mean_y += weight[i] * y[i];
  }
  mean_x /= sum;
  mean_y /= sum;
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += weight[i] * (x[i] - mean_x) * (x[i] - mean_x);
    xy += weight[i] * (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (x.size() < 2 || !(xx > 0)) return {kUnknown, kUnknown};
  return {xy / xx, mean_y - xy / xx * mean_x};
}

double error_slope(const std::vector<ErrorCheck> &checks, int most) {
  std::vector<double> x, y, weight;
  const std::size_t first = checks.size() - std::min(checks.size(), static_cast<std::size_t>(most));
  for (std::size_t i = first; i < checks.size(); ++i) {
    const ErrorCheck &c = checks[i];
    if (!(c.relmse > 0) || !(c.wall_s > 0)) return kUnknown;
    x.push_back(std::log(c.wall_s));
    y.push_back(std::log(c.relmse));
    const double width = c.lo95 > 0 ? std::log(c.hi95 / c.lo95) : 1;
    weight.push_back(1 / std::max(width * width, 1e-6));
  }
  return fit_line(x, y, weight).slope;
}

double seconds_to(const std::vector<ErrorCheck> &checks, double slope, double target) {
  if (checks.empty() || std::isnan(checks.back().relmse)) return kUnknown;
  const ErrorCheck &last = checks.back();
  if (last.relmse <= target) return 0;
  if (!(slope < -0.1)) return kUnknown;
  return last.wall_s * (std::pow(last.relmse / target, -1 / slope) - 1);
}

}  // namespace phalanx
