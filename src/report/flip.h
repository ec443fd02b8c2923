// FLIP: how different two images look when one flips between them on a screen, 0 to 1.
//
// Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", HPG 2020; for HDR images "Visualizing Errors in Rendered High Dynamic Range
// Images", Eurographics Short Papers 2021. Viewing distance: 67 pixels per degree, the papers' own.
#pragma once
#include <string>
#include <vector>

#include "../output/image.h"

namespace phalanx {

struct FlipResult {
  double mean = 0;
  int num_exposures = 1;                         // 1 for images of limited range
  double first_exposure = 0, last_exposure = 0;  // stops
  std::vector<float> error;                      // [width * height] in [0, 1]
};

/// `image` and `reference` have one size and finite colours. With `high_dynamic_range` both are
/// tone-mapped at the exposures that the reference asks for, and the largest error counts;
/// otherwise colours are taken as shown, clamped to [0, 1].
FlipResult flip(const Image &image, const Image &reference, bool high_dynamic_range);

}  // namespace phalanx
