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
constexpr int kReach = 3;           // of the widest window of neighbours, pixels
constexpr double kUnseen = 0.07;    // part of the interval's half width for what was not seen
constexpr double kReliable = 0.1;   // relative variance of the sum over a window
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

/// Sums over pixels: how many, their means, squares of these, variances.
struct Window {
  double n = 0, mean = 0, square = 0, variance = 0;
  void add(double m, double v) {
    n += 1;
    mean += m;
    square += m * m;
    variance += v;
  }
};

/// What a pixel is taken to be, and how much of its own mean is in that.
struct Shrunk {
  double mean = 0;
  double weight = 1;
};

/// Channel c of the pixel (x, y) of a picture of width x height. Its neighbours' spread beyond noise says how
/// far it may be from their average, its variance how far from its own mean: the posterior of normal
/// distributions. Neighbours are the eight around it, or those up to three pixels away if so few have seen
/// light that the standard error of the average is above a third of it.
Shrunk shrunk(const Planes &p, int width, int height, int x, int y, int c) {
  const auto index = [&](int u, int v) { return (static_cast<std::size_t>(v) * width + u) * 3 + c; };
  const double own = double{p.mean[index(x, y)]}, own_variance = double{p.variance[index(x, y)]};
  if (own_variance == 0) return {own, 1};
  Window w;
  bool reliable = false;
  for (int reach = 1; reach <= kReach && !reliable; ++reach) {
    w = {};
    for (int v = std::max(0, y - reach); v <= std::min(height - 1, y + reach); ++v)
      for (int u = std::max(0, x - reach); u <= std::min(width - 1, x + reach); ++u)
        if (u != x || v != y) w.add(double{p.mean[index(u, v)]}, double{p.variance[index(u, v)]});
    reliable = w.mean != 0 && w.variance <= kReliable * square(w.mean);
  }
  const double n = w.n;
  if (n < 2) return {own, 1};
  if (!reliable) return {(w.mean + own) / (n + 1), 1 / (n + 1)};
  const double average = w.mean / n;
  const double spread = (w.square - n * average * average) / (n - 1);
  const double signal = std::max(0.0, spread - w.variance / n);
  const double weight = signal / (signal + own_variance);
  return {average + weight * (own - average), weight};
}

// ---- the mean over pixels ------------------------------------------------------------------------

/// The relative variance of one replicate, summed over pixels and channels: from all replicates, and from
/// all but one; and with the pixels' own means below.
struct RelativeVariance {
  double all = 0, plain = 0;
  std::vector<double> without;  // [R]
};

void add_pixel(RelativeVariance &sum, const float *means, int count, int c, const Shrunk &pixel,
               double eps) {
  const Moments m = moments_of(means, count, c);
  const double n = count;
  if (m.squares == 0) return;
  sum.all += m.squares / (n - 1) / (square(pixel.mean) + eps);
  sum.plain += m.squares / (n - 1) / (square(m.mean) + eps);
  for (int r = 0; r < count && count > 2; ++r) {
    const double off = double{means[3 * r + c]} - m.mean;
    const double squares = std::max(0.0, m.squares - n / (n - 1) * square(off));
    const double mean = pixel.mean - pixel.weight * off / (n - 1);
    sum.without[static_cast<std::size_t>(r)] += squares / (n - 2) / (square(mean) + eps);
  }
}

/// Rows are summed apart and then in their order: the same for any number of threads.
RelativeVariance relative_variance(const Replicates &replicates, double eps, int threads) {
  const Planes planes = planes_of(replicates, threads);
  const int count = replicates.count();
  const int width = replicates.crop().width, height = replicates.crop().height;
  const RelativeVariance zero{0, 0, std::vector<double>(static_cast<std::size_t>(count))};
  std::vector<RelativeVariance> rows(static_cast<std::size_t>(height), zero);
  parallel_for(height, threads, [&](std::int64_t y, int) {
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c)
        add_pixel(rows[static_cast<std::size_t>(y)], replicates.means(y * width + x), count, c,
                  shrunk(planes, width, height, x, static_cast<int>(y), c), eps);
  });
  RelativeVariance sum = zero;
  for (const RelativeVariance &row : rows) {
    sum.all += row.all;
    sum.plain += row.plain;
    for (std::size_t r = 0; r < row.without.size(); ++r) sum.without[r] += row.without[r];
  }
  const double scale = 1 / (3.0 * static_cast<double>(replicates.num_pixels()));
  sum.all *= scale;
  sum.plain *= scale;
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

  const RelativeVariance v =
      relative_variance(replicates, square(0.01 * e.image_mean), threads);
  e.relmse = v.all / n;
  if (n < 3) return e;  // the jackknife needs a variance of two
  const double mean_without = mean_of(v.without);
  double squares = 0;
  for (const double w : v.without) squares += square(w - mean_without);
  const double standard_error = std::sqrt((n - 1) / n * squares);
  // The correction is of the order 1 / n; beyond a factor of two it would be noise.
  const double variance = std::clamp(n * v.all - (n - 1) * mean_without, 0.5 * v.all, 2 * v.all);
  e.relmse = variance / n;
  const double statistical = quotient(student_t_quantile(0.05, n - 1) * standard_error, variance);
  const double systematic = variance > 0 ? 0.5 * std::log(variance / v.plain) : 0;
  const double spread = std::hypot(statistical, systematic, kUnseen);
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
