// Image files by their extension: .exr, .hdr, .png.
#pragma once
#include <string>

#include "image.h"

namespace phalanx {

enum class ImageFormat { kExr, kHdr, kPng };

/// By extension, in any case. A device or a pipe without an extension (/dev/stdout) takes PNG.
/// Throws InputError for an extension that is not known, naming those that are.
ImageFormat image_format(const std::string &path);

/// True if the extension of `path` is one of ours.
bool is_image_path(const std::string &path);

/// `exposure` in stops is used by PNG alone. Throws WriteError; see write_file().
void write_image(const std::string &path, const Image &image, double exposure);

/// Throws InputError for what is missing, damaged, not an image, or larger than `max_pixels`.
Image read_image(const std::string &path, std::int64_t max_pixels = INT64_MAX);

}  // namespace phalanx
