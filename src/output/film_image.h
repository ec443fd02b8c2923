// From film to image: colour, and the layers a user asked for.
#pragma once
#include <string>

#include "../film/film.h"
#include "image.h"

namespace phalanx {

/// What an EXR holds beside R, G and B.
struct Layers {
  bool albedo = false;    // albedo.R/G/B of the first hit
  bool normal = false;    // normal.X/Y/Z of the first hit, world space, mean of unit vectors
  bool depth = false;     // depth.Z, metres along the camera ray
  bool samples = false;   // samples: finite samples of the pixel
  bool variance = false;  // variance.R/G/B of the pixel's mean (not of its samples)

  bool any() const { return albedo || normal || depth || samples || variance; }
  /// True if the renderer has to record first hits.
  bool need_first_hits() const { return albedo || normal || depth; }
};

/// A comma-separated list of the names above, or "all". Throws InputError for other names.
Layers layers_from_list(const std::string &list);

/// The film's window of a picture of full_width x full_height pixels.
Image image_from_film(const Film &film, int full_width, int full_height, const Layers &layers);

}  // namespace phalanx
