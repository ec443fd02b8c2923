// Error metrics as fixed in the project's definitions: film values, double sums, no clamping.
#include "metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "../../kernels/physics/lang.h"
#include "../core/error.h"

namespace phalanx {
namespace {

using Planes = std::array<const float *, 3>;

struct Pair {
  Planes x, r;
  std::int64_t num_pixels;
};

Pair pair_up(const Image &image, const Image &reference) {
  if (image.width != reference.width || image.height != reference.height)
    throw InputError(fmt::format("the images differ in size: {} x {} and {} x {}", image.width,
                                 image.height, reference.width, reference.height));
  const Pair pair{rgb_planes(image), rgb_planes(reference), image.num_pixels()};
  if (!pair.x[0] || !pair.r[0]) throw InputError("an image without channels R, G, B or Y");
  return pair;
}

bool all_finite(const Pair &pair, std::int64_t i) {
  for (int c = 0; c < 3; c++)
    if (!is_finite(pair.x[c][i]) || !is_finite(pair.r[c][i])) return false;
  return true;
}

bool same_bits(const Pair &pair, std::int64_t i) {
  for (int c = 0; c < 3; c++)
    if (std::bit_cast<std::uint32_t>(pair.x[c][i]) != std::bit_cast<std::uint32_t>(pair.r[c][i]))
      return false;
  return true;
}

/// a / b for a, b >= 0, with 0 / 0 = 0.
double quotient(double a, double b) { return a == 0 ? 0 : a / b; }

double square(double x) { return x * x; }

/// Mean over the channels of (x - r)^2 / (r^2 + eps).
double relative_squared_error(const Pair &pair, std::int64_t i, double eps) {
  double sum = 0;
  for (int c = 0; c < 3; c++) {
    const double x = double{pair.x[c][i]}, r = double{pair.r[c][i]};
    sum += quotient(square(x - r), square(r) + eps);
  }
  return sum / 3;
}

/// The smallest value that is not exceeded by the fraction q. `values` is sorted and not empty.
double quantile(const std::vector<double> &values, double q) {
  const auto rank = static_cast<std::size_t>(std::ceil(q * static_cast<double>(values.size())));
  return values[std::min(values.size(), std::max<std::size_t>(rank, 1)) - 1];
}

double mean(const std::vector<double> &values, std::size_t count) {
  double sum = 0;
  for (std::size_t i = 0; i < count; i++) sum += values[i];
  return count ? sum / static_cast<double>(count) : 0;
}

void count_pixels(const Pair &pair, ImageErrors &errors) {
  for (std::int64_t i = 0; i < pair.num_pixels; i++) {
    if (!same_bits(pair, i)) errors.num_different++;
    if (!all_finite(pair, i)) {
      errors.num_left_out++;
      continue;
    }
    errors.num_pixels++;
    for (int c = 0; c < 3; c++) {
      errors.mean_image += double{pair.x[c][i]};
      errors.mean_reference += double{pair.r[c][i]};
    }
  }
  const double num_values = 3.0 * static_cast<double>(std::max<std::int64_t>(errors.num_pixels, 1));
  errors.mean_image /= num_values;
  errors.mean_reference /= num_values;
}

double epsilon(const ImageErrors &errors) { return square(0.01 * errors.mean_reference); }

}  // namespace

Anomalies find_anomalies(const Image &image) {
  Anomalies found;
  for (const float *plane : rgb_planes(image)) {
    if (!plane) continue;
    for (std::int64_t i = 0; i < image.num_pixels(); i++) {
      if (std::isnan(plane[i]))
        found.nan++;
      else if (std::isinf(plane[i]))
        found.inf++;
      else if (plane[i] < 0)
        found.negative++;
    }
  }
  return found;
}

ImageErrors compare_images(const Image &image, const Image &reference) {
  const Pair pair = pair_up(image, reference);
  ImageErrors errors;
  errors.image = find_anomalies(image);
  errors.reference = find_anomalies(reference);
  count_pixels(pair, errors);
  if (errors.num_pixels == 0) return errors;

  std::vector<double> relative;  // per pixel
  relative.reserve(static_cast<std::size_t>(errors.num_pixels));
  for (std::int64_t i = 0; i < pair.num_pixels; i++) {
    if (!all_finite(pair, i)) continue;
    relative.push_back(relative_squared_error(pair, i, epsilon(errors)));
    errors.relmse_literature += relative_squared_error(pair, i, 0.01);
    for (int c = 0; c < 3; c++) {
      const double x = pair.x[c][i], r = pair.r[c][i];
      errors.mse += square(x - r) / 3;
      errors.smape += quotient(2 * std::fabs(x - r), std::fabs(x) + std::fabs(r) +
                                                         1e-3 * std::fabs(errors.mean_reference)) /
                      3;
    }
  }
  const auto n = static_cast<double>(errors.num_pixels);
  errors.mse /= n;
  errors.smape /= n;
  errors.relmse_literature /= n;
  errors.relmse = mean(relative, relative.size());

  std::sort(relative.begin(), relative.end());
  errors.relmse_trimmed = mean(relative, relative.size() - relative.size() / 1000);
  errors.p50 = std::sqrt(quantile(relative, 0.5));
  errors.p95 = std::sqrt(quantile(relative, 0.95));
  errors.p999 = std::sqrt(quantile(relative, 0.999));
  errors.max = std::sqrt(relative.back());
  return errors;
}

Image difference_image(const Image &image, const Image &reference) {
  const Pair pair = pair_up(image, reference);
  ImageErrors errors;
  count_pixels(pair, errors);

  Image difference = make_image(image.width, image.height);
  for (int c = 0; c < 3; c++) {
    std::vector<float> &plane = add_channel(difference, std::string(1, "RGB"[c]));
    for (std::int64_t i = 0; i < pair.num_pixels; i++)
      plane[i] = std::fabs(pair.x[c][i] - pair.r[c][i]);
  }
  std::vector<float> &plane = add_channel(difference, "error.relative");
  for (std::int64_t i = 0; i < pair.num_pixels; i++)
    plane[i] = static_cast<float>(std::sqrt(relative_squared_error(pair, i, epsilon(errors))));
  return difference;
}

}  // namespace phalanx
