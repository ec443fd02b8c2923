// FLIP in its three steps: filter as the eye does, compare colours, compare edges and points.
#include "flip.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flip_color.h"

namespace phalanx {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kPixelsPerDegree = 0.7 * 3840 / 0.7 * (kPi / 180);  // 0.7 m from a 4K screen
constexpr double kColorExponent = 0.7;                               // q_c
constexpr double kColorKnee = 0.4;        // p_c, of the largest colour difference ...
constexpr double kErrorAtKnee = 0.95;     // ... which is given this error, p_t
constexpr double kFeatureWidth = 0.082;   // degrees, w
constexpr double kFeatureExponent = 0.5;  // q_f

using Plane = std::vector<float>;
using Colors = std::vector<Vec3>;
using Kernel = std::vector<float>;  // 2 * radius + 1 weights

struct Size {
  int width, height;
  std::size_t num_pixels() const { return static_cast<std::size_t>(width) * height; }
};

// ---- filters -----------------------------------------------------------------------------------

/// `width` values with `radius` copies of the border value on either side.
Plane padded(const float *values, int width, int radius) {
  Plane row(static_cast<std::size_t>(radius), values[0]);
  row.insert(row.end(), values, values + width);
  row.insert(row.end(), static_cast<std::size_t>(radius), values[width - 1]);
  return row;
}

/// Rows with one kernel, then columns with the other; the border pixel is repeated outwards.
Plane convolve(const Plane &in, Size size, const Kernel &along_x, const Kernel &along_y) {
  Plane rows(in.size(), 0.0f), out(in.size(), 0.0f);
  const int radius_x = static_cast<int>(along_x.size() / 2);
  const int radius_y = static_cast<int>(along_y.size() / 2);
  const std::size_t width = static_cast<std::size_t>(size.width);
  for (int y = 0; y < size.height; y++) {
    const Plane source = padded(in.data() + y * width, size.width, radius_x);
    float *row = rows.data() + y * width;
    for (std::size_t k = 0; k < along_x.size(); k++)
      for (std::size_t x = 0; x < width; x++) row[x] += along_x[k] * source[x + k];
  }
  for (int y = 0; y < size.height; y++)
    for (int k = -radius_y; k <= radius_y; k++) {
      const float *row = rows.data() + std::clamp(y + k, 0, size.height - 1) * width;
      const float weight = along_y[k + radius_y];
      for (std::size_t x = 0; x < width; x++) out[y * width + x] += weight * row[x];
    }
  return out;
}

template <typename Weight>
Kernel make_kernel(int radius, Weight weight) {
  Kernel kernel;
  for (int k = -radius; k <= radius; k++) kernel.push_back(static_cast<float>(weight(k)));
  return kernel;
}

/// Contrast sensitivity of one opponent channel: two Gaussians in degrees, table 1 of the paper.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity kAchromatic{1, 0.0047, 0, 1e-5};
constexpr Sensitivity kRedGreen{1, 0.0053, 0, 1e-5};
constexpr Sensitivity kBlueYellow{34.1, 0.04, 13.5, 0.025};

/// Each Gaussian is separable; their sum is not, so they are filtered one by one and added.
Plane filter_as_seen(const Plane &in, Size size, const Sensitivity &s) {
  const double widest = kBlueYellow.b1;
  const int radius =
      static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * kPi * kPi)) * kPixelsPerDegree));
  const auto gaussian = [&](double b) {
    return make_kernel(radius, [b](int k) {
      const double degrees = k / kPixelsPerDegree;
      return std::exp(-kPi * kPi * degrees * degrees / b);
    });
  };
  const auto sum_of = [](const Kernel &kernel) {
    double sum = 0;
    for (const float weight : kernel) sum += double{weight};
    return sum;
  };
  const Kernel first = gaussian(s.b1), second = gaussian(s.b2);
  const double height1 = s.a1 * std::sqrt(kPi / s.b1), height2 = s.a2 * std::sqrt(kPi / s.b2);
  const double total = height1 * std::pow(sum_of(first), 2) + height2 * std::pow(sum_of(second), 2);

  const auto scaled = [](Kernel kernel, double factor) {
    for (float &weight : kernel) weight = static_cast<float>(double{weight} * factor);
    return kernel;
  };
  Plane out = convolve(in, size, scaled(first, height1 / total), first);
  if (s.a2 == 0) return out;
  const Plane more = convolve(in, size, scaled(second, height2 / total), second);
  for (std::size_t i = 0; i < out.size(); i++) out[i] += more[i];
  return out;
}

// ---- colours -----------------------------------------------------------------------------------

std::array<Plane, 3> opponent_planes(const Colors &linear) {
  std::array<Plane, 3> planes;
  for (Plane &plane : planes) plane.resize(linear.size());
  for (std::size_t i = 0; i < linear.size(); i++) {
    const Vec3 c = ycxcz_from_linear(linear[i]);
    planes[0][i] = c.x;
    planes[1][i] = c.y;
    planes[2][i] = c.z;
  }
  return planes;
}

Vec3 clamp_to_unit(Vec3 c) {
  return vec3(clamp_to(c.x, 0, 1), clamp_to(c.y, 0, 1), clamp_to(c.z, 0, 1));
}

/// What the eye sees of an image at this distance, in Lab.
Colors perceived_colors(const std::array<Plane, 3> &opponent, Size size) {
  const Plane achromatic = filter_as_seen(opponent[0], size, kAchromatic);
  const Plane red_green = filter_as_seen(opponent[1], size, kRedGreen);
  const Plane blue_yellow = filter_as_seen(opponent[2], size, kBlueYellow);
  Colors colors(size.num_pixels());
  for (std::size_t i = 0; i < colors.size(); i++)
    colors[i] = hunt_lab_from_linear(
        clamp_to_unit(linear_from_ycxcz(vec3(achromatic[i], red_green[i], blue_yellow[i]))));
  return colors;
}

double color_error(Vec3 a, Vec3 b) {
  static const double largest =
      std::pow(hyab(hunt_lab_from_linear(vec3(0, 1, 0)), hunt_lab_from_linear(vec3(0, 0, 1))),
               kColorExponent);
  const double difference = std::pow(hyab(a, b), kColorExponent);
  const double knee = kColorKnee * largest;
  if (difference < knee) return kErrorAtKnee * difference / knee;
  return kErrorAtKnee + (difference - knee) / (largest - knee) * (1 - kErrorAtKnee);
}

// ---- edges and points --------------------------------------------------------------------------

struct FeatureKernels {
  Kernel smooth, edge, point;
};

FeatureKernels feature_kernels() {
  const double sd = 0.5 * kFeatureWidth * kPixelsPerDegree;
  const int radius = static_cast<int>(std::ceil(3 * sd));
  const auto gaussian = [sd](int k) { return std::exp(-k * k / (2 * sd * sd)); };
  FeatureKernels kernels{
      make_kernel(radius, gaussian), make_kernel(radius, [&](int k) { return -k * gaussian(k); }),
      make_kernel(radius, [&](int k) { return (k * k / (sd * sd) - 1) * gaussian(k); })};
  // Positive and negative weights each sum to one.
  for (Kernel *kernel : {&kernels.smooth, &kernels.edge, &kernels.point}) {
    double positive = 0, negative = 0;
    for (const float weight : *kernel)
      (weight > 0 ? positive : negative) += std::fabs(double{weight});
    for (float &weight : *kernel)
      weight =
          static_cast<float>(double{weight} / (weight > 0 ? positive : std::max(negative, 1e-30)));
  }
  return kernels;
}

Plane magnitude(const Plane &x, const Plane &y) {
  Plane out(x.size());
  for (std::size_t i = 0; i < x.size(); i++) out[i] = std::hypot(x[i], y[i]);
  return out;
}

struct Features {
  Plane edges, points;
};

Features find_features(Plane achromatic, Size size) {
  static const FeatureKernels kernels = feature_kernels();
  for (float &y : achromatic) y = (y + 16) / 116;
  return {magnitude(convolve(achromatic, size, kernels.edge, kernels.smooth),
                    convolve(achromatic, size, kernels.smooth, kernels.edge)),
          magnitude(convolve(achromatic, size, kernels.point, kernels.smooth),
                    convolve(achromatic, size, kernels.smooth, kernels.point))};
}

double feature_error(const Features &a, const Features &b, std::size_t i) {
  const double difference =
      std::max(std::fabs(a.edges[i] - b.edges[i]), std::fabs(a.points[i] - b.points[i]));
  return std::pow(difference / std::sqrt(2.0), kFeatureExponent);
}

// ---- the whole ---------------------------------------------------------------------------------

/// FLIP of two images in linear colours from 0 to 1.
Plane flip_of_shown(const Colors &image, const Colors &reference, Size size) {
  const auto opponent_x = opponent_planes(image), opponent_r = opponent_planes(reference);
  const Colors color_x = perceived_colors(opponent_x, size);
  const Colors color_r = perceived_colors(opponent_r, size);
  const Features features_x = find_features(opponent_x[0], size);
  const Features features_r = find_features(opponent_r[0], size);
  Plane error(size.num_pixels());
  for (std::size_t i = 0; i < error.size(); i++)
    error[i] = static_cast<float>(std::pow(color_error(color_x[i], color_r[i]),
                                           1 - feature_error(features_x, features_r, i)));
  return error;
}

Colors colors_of(const Image &image) {
  const auto planes = rgb_planes(image);
  Colors colors(static_cast<std::size_t>(image.num_pixels()));
  for (std::size_t i = 0; i < colors.size(); i++)
    colors[i] = vec3(planes[0][i], planes[1][i], planes[2][i]);
  return colors;
}

template <typename Show>
Colors shown(Colors colors, Show show) {
  for (Vec3 &c : colors) c = show(c);
  return colors;
}

/// From the exposure that brings the brightest pixel to 85 % of white to the one that brings the
/// median there; pixels without light do not count. Steps of at most one stop.
void choose_exposures(const Colors &reference, FlipResult &result) {
  std::vector<float> luminances;
  for (const Vec3 c : reference)
    if (luminance(c) > 0) luminances.push_back(luminance(c));
  if (luminances.empty()) return;  // a black reference: exposure 0
  std::sort(luminances.begin(), luminances.end());
  const std::size_t n = luminances.size();
  const double median = (double{luminances[(n - 1) / 2]} + double{luminances[n / 2]}) / 2;
  const double target = aces_inverse(0.85);
  result.first_exposure = std::log2(target / double{luminances.back()});
  result.last_exposure = std::log2(target / median);
  result.num_exposures =
      std::max(2, static_cast<int>(std::ceil(result.last_exposure - result.first_exposure)));
}

double exposure(const FlipResult &result, int i) {
  if (result.num_exposures < 2) return result.first_exposure;
  return result.first_exposure +
         i * (result.last_exposure - result.first_exposure) / (result.num_exposures - 1);
}

}  // namespace

FlipResult flip(const Image &image, const Image &reference, bool high_dynamic_range) {
  const Size size{image.width, image.height};
  const Colors x = colors_of(image), r = colors_of(reference);
  FlipResult result;
  result.error.assign(size.num_pixels(), 0.0f);
  if (high_dynamic_range) choose_exposures(r, result);
  for (int i = 0; i < result.num_exposures; i++) {
    const auto scale = static_cast<float>(std::exp2(exposure(result, i)));
    const auto show = [&](Vec3 c) {
      return high_dynamic_range ? aces_tone_map(c * scale) : clamp_to_unit(c);
    };
    const Plane error = flip_of_shown(shown(x, show), shown(r, show), size);
    for (std::size_t k = 0; k < error.size(); k++)
      result.error[k] = std::max(result.error[k], error[k]);
  }
  for (const float e : result.error) result.mean += double{e};
  result.mean /= static_cast<double>(result.error.size());
  return result;
}

}  // namespace phalanx
