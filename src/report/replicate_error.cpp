// The error of a picture from the spread of its replicates.
#include <algorithm>
#include <cmath>
#include <vector>

#include "../core/parallel.h"
#include "estimate.h"
#include "statistics.h"

namespace phalanx {
namespace {

constexpr int kTileSide = 8;
constexpr int kReach = 3;  // of the filter for denominators: windows of 7 x 7 pixels
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

double square(double x) { return x * x; }

/// a / b for a, b >= 0, with 0 / 0 = 0.
double quotient(double a, double b) { return a == 0 ? 0 : a / b; }

/// Mean of R numbers and the sum of their squared distances from it.
struct Moments {
  double mean = 0, squares = 0;
};

/// Of channel c of the means of a pixel.
Moments moments_of(const float *means, int count, int c) {
  Moments m;
  for (int r = 0; r < count; ++r) m.mean += double{means[3 * r + c]};
  m.mean /= count;
  for (int r = 0; r < count; ++r) m.squares += square(double{means[3 * r + c]} - m.mean);
  return m;
}

/// Half the 95 % interval of the mean of R independent numbers.
double half_width(const std::vector<double> &values) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += square(v - mean);
  return student_t_quantile(0.05, n - 1) * std::sqrt(squares / (n * (n - 1)));
}

/// Mean of the picture per replicate: a sum over pixels and channels, row after row.
std::vector<double> image_means(const Replicates &replicates) {
  const int count = replicates.count();
  std::vector<double> sums(static_cast<std::size_t>(count));
  for (std::int64_t i = 0; i < replicates.num_pixels(); ++i) {
    const float *means = replicates.means(i);
    for (int r = 0; r < count; ++r)
      for (int c = 0; c < 3; ++c) sums[static_cast<std::size_t>(r)] += double{means[3 * r + c]};
  }
  for (double &sum : sums) sum /= 3.0 * static_cast<double>(replicates.num_pixels());
  return sums;
}

double mean_of(const std::vector<double> &values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// ---- denominators --------------------------------------------------------------------------------

/// Per channel of every pixel: the mean of the replicates, and the variance of that mean.
struct Planes {
  std::vector<float> mean, variance;  // [num_pixels * 3]
};

Planes planes_of(const Replicates &replicates, int threads) {
  const int count = replicates.count(), width = replicates.crop().width;
  const auto size = static_cast<std::size_t>(replicates.num_pixels() * 3);
  Planes p{std::vector<float>(size), std::vector<float>(size)};
  parallel_for(replicates.crop().height, threads, [&](std::int64_t y, int) {
    for (std::int64_t i = y * width; i < (y + 1) * width; ++i)
      for (int c = 0; c < 3; ++c) {
        const Moments m = moments_of(replicates.means(i), count, c);
        p.mean[static_cast<std::size_t>(3 * i + c)] = static_cast<float>(m.mean);
        p.variance[static_cast<std::size_t>(3 * i + c)] =
            static_cast<float>(m.squares / (count * (count - 1.0)));
      }
  });
  return p;
}

/// Sums over a window of pixels: how many, their means, squares of these, variances.
struct Window {
  double n = 0, mean = 0, square = 0, variance = 0;
  void add(const Window &w, double sign) {
    n += sign * w.n;
    mean += sign * w.mean;
    square += sign * w.square;
    variance += sign * w.variance;
  }
  /// Lee's filter: the pixel's own mean where neighbours differ by more than noise, theirs where they do not.
  double filtered(double own) const {
    const double average = mean / n, noise = variance / n;
    const double spread = std::max(0.0, (square - n * average * average) / std::max(1.0, n - 1));
    const double weight = spread > noise ? 1 - noise / spread : 0;
    return average + weight * (own - average);
  }
};

/// 1 / (r^2 + eps) for channel c of the pixels of row y, r the filtered mean.
std::vector<double> row_weights(const Planes &p, int width, int height, int y, int c, double eps) {
  std::vector<Window> columns(static_cast<std::size_t>(width));
  for (int v = std::max(0, y - kReach); v <= std::min(height - 1, y + kReach); ++v)
    for (int x = 0; x < width; ++x) {
      const std::size_t at = (static_cast<std::size_t>(v) * width + x) * 3 + c;
      const double m = double{p.mean[at]};
      columns[static_cast<std::size_t>(x)].add({1, m, m * m, double{p.variance[at]}}, 1);
    }
  std::vector<double> weights(static_cast<std::size_t>(width));
  for (int x = 0; x < width; ++x) {
    Window window;
    for (int u = std::max(0, x - kReach); u <= std::min(width - 1, x + kReach); ++u)
      window.add(columns[static_cast<std::size_t>(u)], 1);
    const double own = double{p.mean[(static_cast<std::size_t>(y) * width + x) * 3 + c]};
    weights[static_cast<std::size_t>(x)] = 1 / (square(window.filtered(own)) + eps);
  }
  return weights;
}

// ---- numerators ----------------------------------------------------------------------------------

/// The variance of the mean of R replicates, weighted and summed over pixels and channels: from all
/// replicates, and what it would be if one had not been there.
struct WeightedVariance {
  double all = 0;
  std::vector<double> without;  // [R]
};

void add_pixel(WeightedVariance &sum, const float *means, int count, int c, double weight) {
  const Moments m = moments_of(means, count, c);
  const double n = count;
  if (m.squares == 0) return;
  sum.all += weight * m.squares / (n * (n - 1));
  for (int r = 0; r < count; ++r) {
    const double off = double{means[3 * r + c]} - m.mean;
    sum.without[static_cast<std::size_t>(r)] +=
        weight * (m.squares - n / (n - 1) * square(off)) / (n * (n - 2));
  }
}

/// Rows are summed apart and then in their order: the same for any number of threads.
WeightedVariance weighted_variance(const Replicates &replicates, double eps, int threads) {
  const Planes planes = planes_of(replicates, threads);
  const int count = replicates.count();
  const int width = replicates.crop().width, height = replicates.crop().height;
  const WeightedVariance zero{0, std::vector<double>(static_cast<std::size_t>(count))};
  std::vector<WeightedVariance> rows(static_cast<std::size_t>(height), zero);
  parallel_for(height, threads, [&](std::int64_t y, int) {
    for (int c = 0; c < 3; ++c) {
      const std::vector<double> weights =
          row_weights(planes, width, height, static_cast<int>(y), c, eps);
      for (int x = 0; x < width; ++x)
        add_pixel(rows[static_cast<std::size_t>(y)], replicates.means(y * width + x), count, c,
                  weights[static_cast<std::size_t>(x)]);
    }
  });
  WeightedVariance sum = zero;
  for (const WeightedVariance &row : rows) {
    sum.all += row.all;
    for (std::size_t r = 0; r < row.without.size(); ++r) sum.without[r] += row.without[r];
  }
  const double scale = 1 / (3.0 * static_cast<double>(replicates.num_pixels()));
  sum.all *= scale;
  for (double &w : sum.without) w *= scale;
  return sum;
}

}  // namespace

ErrorEstimate estimate_error(const Replicates &replicates, int threads) {
  const double n = replicates.count();
  ErrorEstimate e{kUnknown, kUnknown, kUnknown, "replicates", replicates.count(), kUnknown, kUnknown};
  if (replicates.num_pixels() == 0) return e;
  const std::vector<double> means = image_means(replicates);
  e.image_mean = mean_of(means);
  e.image_mean_half_width = half_width(means);

  const WeightedVariance v = weighted_variance(replicates, square(0.01 * e.image_mean), threads);
  e.relmse = v.all;
  if (n < 3) return e;  // the jackknife needs a variance of two
  const double mean_without = mean_of(v.without);
  double squares = 0;
  for (const double w : v.without) squares += square(w - mean_without);
  const double standard_error = std::sqrt((n - 1) / n * squares);
  const double spread = quotient(student_t_quantile(0.05, n - 1) * standard_error, v.all);
  e.lo95 = e.relmse * std::exp(-spread);
  e.hi95 = e.relmse * std::exp(spread);
  return e;
}

std::vector<TileError> tile_errors(const Replicates &replicates) {
  const Rect crop = replicates.crop();
  const int count = replicates.count();
  const double eps = square(0.01 * mean_of(image_means(replicates)));
  std::vector<TileError> tiles;
  for (int y0 = 0; y0 < crop.height; y0 += kTileSide)
    for (int x0 = 0; x0 < crop.width; x0 += kTileSide) {
      TileError tile{crop.x + x0, crop.y + y0};
      std::vector<double> means(static_cast<std::size_t>(count));
      const int x1 = std::min(x0 + kTileSide, crop.width), y1 = std::min(y0 + kTileSide, crop.height);
      const double values = 3.0 * (x1 - x0) * (y1 - y0);
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
          const float *pixel = replicates.means(std::int64_t{y} * crop.width + x);
          for (int c = 0; c < 3; ++c) {
            const Moments m = moments_of(pixel, count, c);
            tile.relmse += quotient(m.squares / (count - 1.0) / count, square(m.mean) + eps) / values;
            for (int r = 0; r < count; ++r)
              means[static_cast<std::size_t>(r)] += double{pixel[3 * r + c]} / values;
          }
        }
      tile.mean = mean_of(means);
      tile.half_width = half_width(means);
      tiles.push_back(tile);
    }
  return tiles;
}

}  // namespace phalanx
