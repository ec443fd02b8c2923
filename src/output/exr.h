// OpenEXR: every channel as 32-bit float, ZIP, facts as string attributes. The only file that keeps
// everything: layers, numbers of any size, the window of a cropped picture.
#pragma once
#include <string>

#include "image.h"

namespace phalanx {

std::string encode_exr(const Image &image);

/// All channels of the first part, of whatever type, as floats; string attributes as metadata.
/// `name` is for messages. Throws InputError for a damaged file, subsampled channels and deep data.
Image decode_exr(const std::string &bytes, const std::string &name,
                 std::int64_t max_pixels = INT64_MAX);

}  // namespace phalanx
