// Everything `phalanx diff` says about two images, as one value.
#pragma once
#include <optional>
#include <string>

#include "flip.h"
#include "metrics.h"
#include "welch.h"

namespace phalanx {

struct Comparison {
  std::string image, reference;  // paths
  ImageErrors errors;
  std::optional<FlipResult> flip;
  std::string why_no_flip;
  std::optional<WelchTest> welch;
  std::string why_no_welch;
};

/// FLIP is of limited range if `limited_range` (both images were PNG), of high range otherwise.
Comparison compare(const Image &image, const Image &reference, bool limited_range);

/// A page for people, ending with a newline.
std::string comparison_text(const Comparison &comparison);
/// The same facts as JSON; what is not known is null. Ends with a newline.
std::string comparison_json(const Comparison &comparison);

}  // namespace phalanx
