// Convergence as a straight line: log error over log time.
#pragma once
#include <vector>

#include "../core/stats.h"

namespace phalanx {

struct LineFit {
  double slope = 0, intercept = 0;
};

/// Least squares of y over x with weights; NaN where all x are equal or there are fewer than two.
LineFit fit_line(const std::vector<double> &x, const std::vector<double> &y,
                 const std::vector<double> &weight);

/// Slope of log relMSE over log time of the last `most` checks, each weighted by its interval; NaN with
/// fewer than two, or where an error is 0.
double error_slope(const std::vector<ErrorCheck> &checks, int most = 5);

/// Seconds after the last check until relMSE is `target`, if it goes on falling with `slope`; 0 where it is
/// reached, NaN where the slope does not lead there.
double seconds_to(const std::vector<ErrorCheck> &checks, double slope, double target);

}  // namespace phalanx
