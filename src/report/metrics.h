// How far an image is from a reference.
#pragma once
#include <cstdint>
#include <string>

#include "../output/image.h"

namespace phalanx {

/// Numbers of an image that should not be there, counted over its colour channels.
struct Anomalies {
  std::int64_t nan = 0, inf = 0, negative = 0;
};

/// x is the image, r the reference. All sums are in double precision, over all three channels of all
/// pixels that are finite in both; the others are counted and left out. Where a quotient is 0 / 0
/// the error is 0.
struct ImageErrors {
  std::int64_t num_pixels = 0;     // compared
  std::int64_t num_left_out = 0;   // not finite in one image or in both
  std::int64_t num_different = 0;  // pixels with any different bit, of all
  Anomalies image, reference;
  double mean_image = 0, mean_reference = 0;
  double mse = 0;                // mean (x - r)^2
  double relmse = 0;             // mean (x - r)^2 / (r^2 + eps), eps = (0.01 mean r)^2: scale-free
  double relmse_literature = 0;  // the same with eps = 0.01
  double relmse_trimmed = 0;     // relmse without the 0.1 % of pixels where it is largest
  double smape = 0;              // mean 2 |x - r| / (|x| + |r| + 1e-3 mean r), in [0, 2]
  double p50 = 0, p95 = 0, p999 = 0, max = 0;  // of a pixel's relative error, sqrt of its relmse
};

/// Throws InputError if the sizes differ or one has no colour. Names come from the callers.
ImageErrors compare_images(const Image &image, const Image &reference);

/// |x - r| per channel, and the relative error of each pixel in the channel "error.relative".
Image difference_image(const Image &image, const Image &reference);

Anomalies find_anomalies(const Image &image);

}  // namespace phalanx
