// Radiance HDR: RGBE pixels, run-length encoded (G. Ward, "Real Pixels", Graphics Gems II, 1991).
//
// Our own reader and writer: stb_image 2.27 never returns from a truncated file, and
// stb_image_write truncates instead of rounding and wraps around beyond 2^127.
#pragma once
#include <string>

#include "image.h"

namespace phalanx {

/// R, G and B with a common exponent: the largest channel is exact to 1 in 512. What RGBE cannot
/// hold is clipped: below 1e-38 and NaN to 0, above 1.7e38 to that. Facts become comment lines.
std::string encode_hdr(const Image &image);

/// R, G and B. `name` is for messages. Throws InputError for a damaged file.
Image decode_hdr(const std::string &bytes, const std::string &name,
                 std::int64_t max_pixels = INT64_MAX);

}  // namespace phalanx
