#include "filter.h"

#include <cmath>
#include <numbers>

namespace phalanx {
namespace {

/// Filter weight at x in [-radius, radius].
double weight(const FilmDescription &film, double x) {
  switch (film.filter) {
    case kBoxFilter: return 1;
    case kGaussianFilter: return std::exp(-0.5 * x * x / (film.filter_sigma * film.filter_sigma));
    case kBlackmanHarrisFilter: {
      const double t = 2 * std::numbers::pi * (0.5 + 0.5 * x / film.filter_radius);
      return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) -
             0.01168 * std::cos(3 * t);
    }
  }
  return 1;
}

}  // namespace

std::vector<float> filter_offsets(const FilmDescription &film) {
  constexpr int kSteps = 1 << 16;
  std::vector<double> sum(kSteps + 1, 0.0);  // trapezoids of the weight
  const double step = 2 * film.filter_radius / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double x = -film.filter_radius + i * step;
    sum[i + 1] = sum[i] + 0.5 * (weight(film, x) + weight(film, x + step));
  }
  std::vector<float> offsets(PHALANX_FILTER_CELLS + 1);
  int i = 0;
  for (int cell = 0; cell <= PHALANX_FILTER_CELLS; ++cell) {
    const double target = sum.back() * cell / PHALANX_FILTER_CELLS;
    while (i < kSteps - 1 && sum[i + 1] < target) ++i;
    const double width = sum[i + 1] - sum[i];
    const double within = width > 0 ? (target - sum[i]) / width : 0;
    offsets[cell] = static_cast<float>(-film.filter_radius + (i + within) * step);
  }
  return offsets;
}

}  // namespace phalanx
