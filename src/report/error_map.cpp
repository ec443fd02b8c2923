#include "error_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "../core/srgb.h"

namespace phalanx {
namespace {

/// sRGB of the scale at equal steps, after matplotlib's "inferno" (Smith and van der Walt, 2015, CC0).
constexpr std::array<std::array<double, 3>, 6> kScale = {{{0, 0, 4},
                                                          {66, 10, 104},
                                                          {147, 38, 103},
                                                          {221, 81, 58},
                                                          {252, 165, 10},
                                                          {252, 255, 164}}};

double colour(double t, int c) {
  const double at = std::clamp(t, 0.0, 1.0) * (kScale.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), kScale.size() - 2);
  const auto channel = static_cast<std::size_t>(c);
  const double srgb = kScale[k][channel] + (at - static_cast<double>(k)) * (kScale[k + 1][channel] - kScale[k][channel]);
  return linear_from_srgb(srgb / 255);
}

}  // namespace

void ErrorMap::add(const Image &x, const Image &reference) {
  width_ = x.width;
  height_ = x.height;
  num_++;
  squares_.resize(static_cast<std::size_t>(x.num_pixels()));
  const auto px = rgb_planes(x), pr = rgb_planes(reference);
  double mean = 0;
  for (int c = 0; c < 3; ++c)
    for (std::int64_t i = 0; i < x.num_pixels(); ++i) mean += double{pr[c][i]};
  mean /= 3.0 * static_cast<double>(x.num_pixels());
  const double eps = std::pow(0.01 * mean, 2);
  for (int c = 0; c < 3; ++c)
    for (std::int64_t i = 0; i < x.num_pixels(); ++i) {
      const double r = double{pr[c][i]}, off = double{px[c][i]} - r;
      if (off != 0) squares_[static_cast<std::size_t>(i)] += off * off / (r * r + eps) / 3;
    }
}

Image ErrorMap::image() const {
  Image image = make_image(width_, height_);
  for (int c = 0; c < 3; ++c) {
    std::vector<float> &plane = add_channel(image, std::string(1, "RGB"[c]));
    for (std::size_t i = 0; i < plane.size(); ++i) {
      const double error = std::sqrt(squares_[i] / std::max(num_, 1));
      plane[i] = static_cast<float>(colour(error > 0 ? 1 + 0.5 * std::log10(error) : 0, c));
    }
  }
  return image;
}

}  // namespace phalanx
