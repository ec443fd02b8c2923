// Replicates: the same picture several times over, each with scrambles of its own, so that their spread
// tells the error of their mean.
//
// The samples of one Sobol sequence are spread evenly, so their variance says little about the error
// of their mean. Means of independent randomizations of the sequence do tell it (Owen, "Error
// estimation for quasi-Monte Carlo", arXiv 2501.00150).
#pragma once
#include <cstdint>
#include <vector>

#include "film.h"

namespace phalanx {

/// Means of every pixel over each of `count` replicates. Kept in single precision: they tell an error,
/// the picture is in the film.
class Replicates {
 public:
  /// `count` >= 2.
  Replicates(Rect crop, int count);

  /// With what estimate_error() needs while it runs: mean and variance of three channels.
  static std::int64_t bytes_per_pixel(int count) {
    return count == 0 ? 0 : std::int64_t{count} * 3 * 4 + 2 * 3 * 4;
  }
  Rect crop() const { return crop_; }
  int count() const { return count_; }
  std::int64_t num_pixels() const { return std::int64_t{crop_.width} * crop_.height; }

  /// Adds `num` samples of pixel (x, y) of the full picture to `replicate`, which has `before` already.
  /// samples[3 * i] is the red of sample i; those that are not finite are left out. Threads may add
  /// to different pixels at the same time.
  void add_samples(int x, int y, int replicate, const float *samples, int num, std::int64_t before);

  /// [count * 3] linear RGB means, replicate after replicate. Pixels are numbered as in Film.
  const float *means(std::int64_t pixel) const { return &means_[static_cast<std::size_t>(pixel * count_ * 3)]; }

 private:
  Rect crop_;
  int count_;
  std::vector<float> means_;  // [num_pixels * count * 3]
};

}  // namespace phalanx
