// Where a renderer errs: a picture of relative errors.
#pragma once
#include <vector>

#include "../output/image.h"

namespace phalanx {

/// Root mean square, over runs and channels, of each pixel's relative error.
class ErrorMap {
 public:
  /// Pictures of one size. eps as in ImageErrors::relmse.
  void add(const Image &x, const Image &reference);
  /// Colours from black (0.01 and less) over violet and orange to light yellow (1 and more), on a logarithmic
  /// scale; linear, so that a PNG shows them as meant.
  Image image() const;

 private:
  int width_ = 0, height_ = 0, num_ = 0;
  std::vector<double> squares_;  // [pixels]
};

}  // namespace phalanx
