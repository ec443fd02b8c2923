// The error estimate: a ratio of sums over tiles, with the spread between tiles as its uncertainty.
#include "estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "statistics.h"

namespace phalanx {
namespace {

constexpr int kTileSide = 16;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

bool has_two_samples_everywhere(const Film &film) {
  for (std::int64_t i = 0; i < film.num_pixels(); i++)
    if (film.sample_count(i) < 2) return false;
  return film.num_pixels() > 0;
}

double relative_variance(double variance, double mean, double eps) {
  return variance == 0 ? 0 : variance / (mean * mean + eps);
}

double relative_variance(const Film &film, std::int64_t pixel, double eps) {
  const Vec3 variance = film.variance_of_mean(pixel), mean = film.mean(pixel);
  return (relative_variance(double{variance.x}, double{mean.x}, eps) +
          relative_variance(double{variance.y}, double{mean.y}, eps) +
          relative_variance(double{variance.z}, double{mean.z}, eps)) /
         3;
}

struct Tile {
  double sum = 0;  // of the relative variances of its pixels
  double num_pixels = 0;
};

std::vector<Tile> tiles_of(const Film &film, double eps) {
  const Rect crop = film.crop();
  const int columns = (crop.width + kTileSide - 1) / kTileSide;
  const int rows = (crop.height + kTileSide - 1) / kTileSide;
  std::vector<Tile> tiles(static_cast<std::size_t>(columns) * rows);
  for (std::int64_t i = 0; i < film.num_pixels(); i++) {
    const auto x = static_cast<int>(i % crop.width), y = static_cast<int>(i / crop.width);
    Tile &tile = tiles[static_cast<std::size_t>(y / kTileSide) * columns + x / kTileSide];
    tile.sum += relative_variance(film, i, eps);
    tile.num_pixels++;
  }
  return tiles;
}

/// Standard error of sum / num_pixels over tiles of unequal size (ratio estimator, Cochran 1977,
/// 6.3).
double standard_error(const std::vector<Tile> &tiles, double ratio, double num_pixels) {
  double squares = 0;
  for (const Tile &tile : tiles) {
    const double residual = tile.sum - ratio * tile.num_pixels;
    squares += residual * residual;
  }
  const auto n = static_cast<double>(tiles.size());
  return std::sqrt(squares * n / (n - 1)) / num_pixels;
}

}  // namespace

ErrorEstimate estimate_error(const Film &film, bool stratified) {
  ErrorEstimate estimate{
      kUnknown, kUnknown, kUnknown,
      stratified ? "sample variance (an upper bound for Sobol points)" : "sample variance"};
  if (!has_two_samples_everywhere(film)) return estimate;

  const double eps = std::pow(0.01 * film.image_mean(), 2);
  const std::vector<Tile> tiles = tiles_of(film, eps);
  double sum = 0;
  for (const Tile &tile : tiles) sum += tile.sum;
  const auto num_pixels = static_cast<double>(film.num_pixels());
  estimate.relmse = sum / num_pixels;
  if (tiles.size() < 2) return estimate;

  const double dof = static_cast<double>(tiles.size()) - 1;
  const double spread = estimate.relmse == 0
                            ? 0
                            : student_t_quantile(0.05, dof) *
                                  standard_error(tiles, estimate.relmse, num_pixels) /
                                  estimate.relmse;
  estimate.lo95 = estimate.relmse * std::exp(-spread);
  estimate.hi95 = estimate.relmse * std::exp(spread);
  return estimate;
}

}  // namespace phalanx
