// Errors against two halves of a reference, and curves with intervals.
#include "convergence.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "line_fit.h"
#include "metrics.h"
#include "statistics.h"

namespace phalanx {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr int kTileSide = 16;
constexpr int kResamples = 1000;  // of the bootstrap
constexpr std::size_t kSlopePoints = 5;

double square(double x) { return x * x; }

double mean_of(const std::vector<double> &values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? kUnknown : sum / static_cast<double>(values.size());
}

double median_of(std::vector<double> values) {
  if (values.empty()) return kUnknown;
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return 0.5 * (values[(n - 1) / 2] + values[n / 2]);
}

/// Standard error of the mean.
double standard_error(const std::vector<double> &values) {
  const auto n = static_cast<double>(values.size());
  const double mean = mean_of(values);
  double squares = 0;
  for (const double v : values) squares += square(v - mean);
  return n > 1 ? std::sqrt(squares / (n * (n - 1))) : kUnknown;
}

double image_mean(const Image &image) {
  double sum = 0;
  for (const float *plane : rgb_planes(image))
    for (std::int64_t i = 0; i < image.num_pixels(); ++i) sum += double{plane[i]};
  return sum / (3.0 * static_cast<double>(image.num_pixels()));
}

double epsilon(const ReferencePair &reference) { return square(0.01 * image_mean(reference.mean)); }

/// 0 / 0 = 0.
double quotient(double a, double b) { return a == 0 ? 0 : a / b; }

}  // namespace

// ---- errors of one picture ---------------------------------------------------------------------

PictureError picture_error(const Image &x, const ReferencePair &reference) {
  const auto px = rgb_planes(x), pa = rgb_planes(reference.a), pb = rgb_planes(reference.b),
             pr = rgb_planes(reference.mean);
  const double eps = epsilon(reference);
  std::vector<double> relative(static_cast<std::size_t>(x.num_pixels()));
  PictureError error;
  for (std::int64_t i = 0; i < x.num_pixels(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double v = double{px[c][i]}, r = double{pr[c][i]};
      const double product = (v - double{pa[c][i]}) * (v - double{pb[c][i]});
      error.mse += product;
      relative[static_cast<std::size_t>(i)] += quotient(product, square(r) + eps) / 3;
    }
  error.mse /= 3.0 * static_cast<double>(x.num_pixels());
  error.relmse = mean_of(relative);
  const auto kept = static_cast<std::ptrdiff_t>(relative.size() - relative.size() / 1000);
  std::nth_element(relative.begin(), relative.begin() + kept - 1, relative.end());
  relative.resize(static_cast<std::size_t>(kept));
  error.relmse_trimmed = mean_of(relative);
  error.smape = compare_images(x, reference.mean).smape;
  return error;
}

void BiasSums::add(const Image &x, const ReferencePair &reference) {
  const auto px = rgb_planes(x), pa = rgb_planes(reference.a), pb = rgb_planes(reference.b);
  const auto size = static_cast<std::size_t>(3 * x.num_pixels());
  sum_.resize(size);
  square_.resize(size);
  for (std::int64_t i = 0; i < x.num_pixels(); ++i)
    for (int c = 0; c < 3; ++c) {
      const auto at = static_cast<std::size_t>(3 * i + c);
      const double v = double{px[c][i]};
      sum_[at] += v;
      square_[at] += (v - double{pa[c][i]}) * (v - double{pb[c][i]});
    }
  means_.push_back(phalanx::image_mean(x));
  num_++;
}

Interval95 BiasSums::squared(const ReferencePair &reference) const {
  if (num_ < 2) return {kUnknown, kUnknown, kUnknown};
  const auto pa = rgb_planes(reference.a), pb = rgb_planes(reference.b),
             pr = rgb_planes(reference.mean);
  const double eps = epsilon(reference), n = num_;
  const int width = reference.mean.width, height = reference.mean.height;
  std::vector<double> tiles;  // of equal size but at the border: their sums
  const int columns = (width + kTileSide - 1) / kTileSide;
  tiles.resize(static_cast<std::size_t>(columns) * ((height + kTileSide - 1) / kTileSide));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        const std::int64_t i = std::int64_t{y} * width + x;
        const auto at = static_cast<std::size_t>(3 * i + c);
        // Sum over pairs i != j of (x_i - a)(x_j - b).
        const double pairs = (sum_[at] - n * double{pa[c][i]}) * (sum_[at] - n * double{pb[c][i]}) - square_[at];
        tiles[static_cast<std::size_t>(y / kTileSide) * columns + x / kTileSide] +=
            quotient(pairs / (n * (n - 1)), square(double{pr[c][i]}) + eps);
      }
  const double scale = static_cast<double>(tiles.size()) / (3.0 * width * height);
  for (double &t : tiles) t *= scale;
  const double value = mean_of(tiles);
  if (tiles.size() < 2) return {value, kUnknown, kUnknown};
  const double half =
      student_t_quantile(0.05, static_cast<double>(tiles.size()) - 1) * standard_error(tiles);
  return {value, value - half, value + half};
}

Interval95 BiasSums::image_mean(const ReferencePair &reference, int spp) const {
  if (num_ < 2) return {kUnknown, kUnknown, kUnknown};
  const double r = phalanx::image_mean(reference.mean);
  const double bias = mean_of(means_) / r - 1;
  const double own = square(standard_error(means_));
  const double of_reference = reference.spp > 0 ? own * num_ * spp / (2.0 * reference.spp) : 0;
  const double half = student_t_quantile(0.05, num_ - 1) * std::sqrt(own + of_reference) / std::fabs(r);
  return {bias, bias - half, bias + half};
}

// ---- derived figures ---------------------------------------------------------------------------

std::string Curve::name() const { return std::string(mode_name(mode)) + ", " + sampler; }

namespace {

/// A curve of some of the runs: log seconds and log relMSE at each checkpoint.
struct Line {
  std::vector<double> log_s, log_error;
};

Line line_of(const Curve &curve, const std::vector<std::size_t> &runs) {
  Line line;
  for (std::size_t k = 0; k < curve.runs.front().size(); ++k) {
    std::vector<double> seconds, errors;
    for (const std::size_t r : runs) {
      seconds.push_back(curve.runs[r][k].wall_s);
      errors.push_back(curve.runs[r][k].error.relmse);
    }
    line.log_s.push_back(std::log(median_of(seconds)));
    line.log_error.push_back(std::log(mean_of(errors)));  // NaN below 0: drowned in the reference's noise
  }
  return line;
}

/// y at `x` between points of falling or rising xs; NaN outside.
double interpolate(const std::vector<double> &xs, const std::vector<double> &ys, double x) {
  for (std::size_t k = 0; k + 1 < xs.size(); ++k) {
    const double lo = std::min(xs[k], xs[k + 1]), hi = std::max(xs[k], xs[k + 1]);
    if (!(x >= lo && x <= hi)) continue;
    return hi > lo ? ys[k] + (ys[k + 1] - ys[k]) * (x - xs[k]) / (xs[k + 1] - xs[k]) : ys[k];
  }
  return kUnknown;
}

double log_seconds_to(const Line &line, double log_error) {
  return interpolate(line.log_error, line.log_s, log_error);
}
double log_error_at(const Line &line, double log_s) {
  return interpolate(line.log_s, line.log_error, log_s);
}

/// Spread of the mean error of a checkpoint, on the logarithm.
double log_width(const Curve &curve, std::size_t k) {
  std::vector<double> errors;
  for (const auto &run : curve.runs) errors.push_back(run[k].error.relmse);
  const double width = standard_error(errors) / mean_of(errors);
  return width > 0 ? width : 1;
}

double slope_of(const Line &line, const std::vector<double> &weights) {
  const std::size_t n = line.log_s.size(), first = n - std::min(n, kSlopePoints);
  const auto tail = [&](const std::vector<double> &v) {
    return std::vector<double>(v.begin() + static_cast<std::ptrdiff_t>(first), v.end());
  };
  return fit_line(tail(line.log_s), tail(line.log_error), tail(weights)).slope;
}

std::vector<std::size_t> all_runs(const Curve &curve) {
  std::vector<std::size_t> runs(curve.runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r) runs[r] = r;
  return runs;
}

/// `figure` of all runs, with the interval that the percentiles of resampled runs give (Efron and
/// Tibshirani, "An Introduction to the Bootstrap", 1993, chapter 13). NaN where more than one in twenty
/// resamplings knows no figure.
Interval95 bootstrap(std::size_t num_runs,
                   const std::function<double(const std::vector<std::size_t> &)> &figure) {
  std::vector<std::size_t> runs(num_runs);
  for (std::size_t r = 0; r < num_runs; ++r) runs[r] = r;
  Interval95 result{figure(runs), kUnknown, kUnknown};
  std::mt19937 random(1);
  std::vector<double> values;
  for (int i = 0; i < kResamples; ++i) {
    for (std::size_t &r : runs) r = random() % num_runs;
    const double value = figure(runs);
    if (!std::isnan(value)) values.push_back(value);
  }
  if (std::isnan(result.value) || values.size() < kResamples * 19 / 20) return result;
  std::sort(values.begin(), values.end());
  const auto at = [&](double q) {
    return values[static_cast<std::size_t>(std::lround(q * static_cast<double>(values.size() - 1)))];
  };
  return {result.value, at(0.025), at(0.975)};
}

CurvePoint point_of(const Curve &curve, std::size_t k) {
  const auto each = [&](auto get) {
    std::vector<double> values;
    for (const auto &run : curve.runs) {
      const double v = static_cast<double>(get(run[k]));
      if (!std::isnan(v)) values.push_back(v);
    }
    return values;
  };
  CurvePoint p;
  p.spp = curve.runs.front()[k].spp;
  p.samples_per_pixel = mean_of(each([](const RunPoint &r) { return r.samples_per_pixel; }));
  p.wall_s = median_of(each([](const RunPoint &r) { return r.wall_s; }));
  p.cpu_s = median_of(each([](const RunPoint &r) { return r.cpu_s; }));
  p.rays = median_of(each([](const RunPoint &r) { return r.rays; }));
  p.relmse_trimmed = mean_of(each([](const RunPoint &r) { return r.error.relmse_trimmed; }));
  p.mse = mean_of(each([](const RunPoint &r) { return r.error.mse; }));
  p.smape = mean_of(each([](const RunPoint &r) { return r.error.smape; }));
  p.flip = mean_of(each([](const RunPoint &r) { return r.flip; }));
  p.estimate = mean_of(each([](const RunPoint &r) { return r.estimate; }));
  const std::vector<double> errors = each([](const RunPoint &r) { return r.error.relmse; });
  const double mean = mean_of(errors), n = static_cast<double>(errors.size());
  const double spread = n > 1 ? student_t_quantile(0.05, n - 1) * quotient(standard_error(errors), mean) : kUnknown;
  p.relmse = {mean, mean * std::exp(-spread), mean * std::exp(spread)};
  p.efficiency = 1 / (mean * p.wall_s);
  p.coverage = mean_of(each([&](const RunPoint &r) {
    return std::isnan(r.lo95) ? kUnknown : r.lo95 <= mean && mean <= r.hi95 ? 1.0 : 0.0;
  }));
  return p;
}

}  // namespace

CurveFigures curve_figures(const Curve &curve, const std::vector<double> &targets) {
  CurveFigures figures;
  if (curve.runs.empty() || curve.runs.front().empty()) return figures;
  std::vector<double> weights;
  for (std::size_t k = 0; k < curve.runs.front().size(); ++k) {
    figures.points.push_back(point_of(curve, k));
    weights.push_back(1 / square(log_width(curve, k)));
  }
  const std::size_t n = curve.runs.size();
  figures.slope = bootstrap(n, [&](const auto &runs) { return slope_of(line_of(curve, runs), weights); });
  for (const double target : targets)
    figures.seconds_to.push_back(bootstrap(n, [&](const auto &runs) {
      return std::exp(log_seconds_to(line_of(curve, runs), std::log(target)));
    }));
  return figures;
}

Versus versus(const Curve &first, const Curve &curve) {
  Versus v;
  const std::size_t n = std::min(first.runs.size(), curve.runs.size());
  const Line a = line_of(first, all_runs(first)), b = line_of(curve, all_runs(curve));
  const double log_error = std::max(*std::min_element(a.log_error.begin(), a.log_error.end()),
                                    *std::min_element(b.log_error.begin(), b.log_error.end()));
  const double log_s = std::min(a.log_s.back(), b.log_s.back());
  v.at_error = std::exp(log_error);
  v.at_s = std::exp(log_s);
  // A resampled curve may end short of the error that all runs reach: its last error then counts.
  const auto to_error = [&](const Line &line) {
    const double least = *std::min_element(line.log_error.begin(), line.log_error.end());
    return log_seconds_to(line, std::max(log_error, least));
  };
  v.speed_up = bootstrap(n, [&](const auto &runs) {
    return std::exp(to_error(line_of(first, runs)) - to_error(line_of(curve, runs)));
  });
  const auto at_time = [&](const Line &line) {
    return log_error_at(line, std::min(log_s, line.log_s.back()));
  };
  v.error_ratio = bootstrap(n, [&](const auto &runs) {
    return std::exp(at_time(line_of(curve, runs)) - at_time(line_of(first, runs)));
  });
  return v;
}

std::vector<double> default_targets(const std::vector<Curve> &curves) {
  double most = 0, least = 1e300;
  for (const Curve &curve : curves)
    for (const double log_error : line_of(curve, all_runs(curve)).log_error) {
      if (std::isnan(log_error)) continue;
      most = std::max(most, std::exp(log_error));
      least = std::min(least, std::exp(log_error));
    }
  std::vector<double> targets;
  for (int k = 3; k >= -12; --k)
    if (const double target = std::pow(10.0, k); target <= most && target >= least)
      targets.push_back(target);
  return targets;
}

}  // namespace phalanx
