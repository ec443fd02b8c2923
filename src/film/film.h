// The film: what samples add up to.
//
// Samples of one pixel are taken in sample order, one after the other in double precision, so that a
// picture does not depend on threads, tiles, waves or on where one pass ends and the next begins.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "../../kernels/physics/vec.h"
#include "../core/stats.h"

namespace phalanx {

struct Rect {
  int x = 0, y = 0, width = 0, height = 0;
};

/// A picture with everything known about it. Pixel (x, y) of the crop window is at
/// index (y - crop.y) * crop.width + (x - crop.x); y grows downwards.
class Film {
 public:
  /// Allocates for the crop window. AOV planes exist only with `with_aovs`.
  Film(Rect crop, bool with_aovs);

  Rect crop() const { return crop_; }
  bool has_aovs() const { return !first_hits_.empty(); }
  std::int64_t num_pixels() const { return std::int64_t{crop_.width} * crop_.height; }
  static std::int64_t bytes_per_pixel(bool with_aovs);

  /// Adds `count` samples of pixel (x, y) of the full picture: samples[3 * i] is the red of sample
  /// i. A sample with a channel that is not finite, or below 0, is counted in `invalid` and left out: the
  /// pixel's sample_count() does not grow. `first_sample` is the number of sample 0. Threads may add to
  /// different pixels at the same time.
  void add_samples(int x, int y, const float *samples, int count, std::int64_t first_sample,
                   InvalidSamples &invalid);
  /// Adds `count` first-hit records of pixel (x, y): 7 floats each: albedo rgb, normal xyz, depth
  /// (metres along the ray; 0 where nothing was hit). Records that are not finite are left out.
  void add_aovs(int x, int y, const float *records, int count);

  /// Samples added from now on whose largest channel exceeds `limit` are scaled down to it, and counted with
  /// what they lose: less noise, and a picture that is too dark. 0, the default: no sample is.
  void set_clamp(float limit) { clamp_ = limit; }
  /// Sum over all samples taken of the mean of their channels.
  double energy() const;
  /// Everything known of the pixels of `region`, exactly, as bytes of this machine's order. `region` is in
  /// coordinates of the full picture and lies within the crop window.
  std::vector<std::byte> region_bytes(Rect region) const;
  /// Replaces what is known of the pixels of `region` by what region_bytes() gave. Throws
  /// std::invalid_argument if the number of bytes is not the one that such a region has.
  void set_region(Rect region, std::span<const std::byte> bytes);

  std::int64_t sample_count(std::int64_t pixel) const { return counts_[pixel]; }
  double image_mean() const;                       // over pixels and channels
  Vec3 mean(std::int64_t pixel) const;             // linear RGB radiance; 0 without samples
  /// Per channel, sample variance / n. Infinite where n < 2: nothing is known there.
  Vec3 variance_of_mean(std::int64_t pixel) const;
  Vec3 albedo(std::int64_t pixel) const;
  Vec3 normal(std::int64_t pixel) const;           // mean of unit normals, not normalised
  float depth(std::int64_t pixel) const;           // mean over samples that hit something

 private:
  std::int64_t index(int x, int y) const;
  struct Moments {           // Welford 1962, sample by sample
    double mean[3] = {0, 0, 0};
    double m2[3] = {0, 0, 0};  // sum of squared distances from the mean
  };
  struct FirstHit {
    double albedo[3] = {0, 0, 0}, normal[3] = {0, 0, 0}, depth = 0;  // sums
    std::int64_t count = 0, hits = 0;
  };
  Rect crop_;
  float clamp_ = 0;
  std::vector<Moments> moments_;
  std::vector<std::int64_t> counts_;
  std::vector<FirstHit> first_hits_;
};

}  // namespace phalanx
