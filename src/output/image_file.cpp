// Picks the codec.
#include "image_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>

#include "../core/error.h"
#include "exr.h"
#include "files.h"
#include "hdr.h"
#include "png.h"

namespace phalanx {
namespace {

std::string extension_of(const std::string &path) {
  std::string extension = std::filesystem::path(path).extension();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::optional<ImageFormat> format_of_extension(const std::string &extension) {
  if (extension == ".exr") return ImageFormat::kExr;
  if (extension == ".hdr") return ImageFormat::kHdr;
  if (extension == ".png") return ImageFormat::kPng;
  return std::nullopt;
}

std::string encode(const Image &image, ImageFormat format, double exposure) {
  switch (format) {
    case ImageFormat::kExr:
      return encode_exr(image);
    case ImageFormat::kHdr:
      return encode_hdr(image);
    case ImageFormat::kPng:
      return encode_png(image, exposure);
  }
  return "";
}

}  // namespace

bool is_image_path(const std::string &path) {
  return format_of_extension(extension_of(path)).has_value();
}

ImageFormat image_format(const std::string &path) {
  const std::string extension = extension_of(path);
  if (const auto format = format_of_extension(extension)) return *format;
  if (extension.empty() && is_device(path)) return ImageFormat::kPng;
  throw InputError(
      fmt::format("{}: {}; an image's name ends in .exr, .hdr or .png", path,
                  extension.empty() ? "no extension" : "unknown extension " + extension));
}

void write_image(const std::string &path, const Image &image, double exposure) {
  write_file(path, encode(image, image_format(path), exposure));
}

Image read_image(const std::string &path, std::int64_t max_pixels) {
  const ImageFormat format = image_format(path);
  const std::string bytes = read_file(path);
  switch (format) {
    case ImageFormat::kExr:
      return decode_exr(bytes, path, max_pixels);
    case ImageFormat::kHdr:
      return decode_hdr(bytes, path, max_pixels);
    case ImageFormat::kPng:
      return decode_png(bytes, path, max_pixels);
  }
  return {};
}

}  // namespace phalanx
