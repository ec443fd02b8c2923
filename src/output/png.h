// PNG: 8 bits a channel, sRGB, with facts as tEXt chunks.
#pragma once
#include <string>

#include "image.h"

namespace phalanx {

/// R, G and B times 2^exposure, through the sRGB curve. What a PNG cannot hold is clipped: values
/// above white, below black, and NaN, which becomes black.
std::string encode_png(const Image &image, double exposure);

/// R, G and B, linear: the sRGB curve undone. Alpha is ignored. `name` is for messages.
/// Throws InputError for a file that is damaged, or that claims more pixels than it can hold.
Image decode_png(const std::string &bytes, const std::string &name,
                 std::int64_t max_pixels = INT64_MAX);

}  // namespace phalanx
