#include "texture_image.h"

#include <fmt/format.h>

#include <cmath>

#include "../core/error.h"
#include "../core/srgb.h"
#include "../output/files.h"
#include "../output/image_file.h"
#include "../output/picture.h"

namespace phalanx {
namespace {

/// Leaves room for sums and products in single precision.
constexpr float kMaxTexel = 1e36f;

std::vector<float> floats_of(const std::vector<std::uint16_t> &values, bool srgb) {
  std::vector<float> floats(values.size());
  for (std::size_t i = 0; i < values.size(); i++) {
    const double value = values[i] / 65535.0;
    const bool is_alpha = i % 4 == 3;
    floats[i] = static_cast<float>(srgb && !is_alpha ? linear_from_srgb(value) : value);
  }
  return floats;
}

/// R, G, B (or Y) and, if there is one, A.
std::vector<float> floats_of(const Image &image, const std::string &path) {
  const std::array<const float *, 3> rgb = rgb_planes(image);
  const Channel *const alpha = find_channel(image, "A");
  if (rgb[0] == nullptr) throw InputError(fmt::format("{}: expected channels R, G, B or Y", path));
  const auto count = static_cast<std::size_t>(image.num_pixels());
  std::vector<float> floats(4 * count, 1.0f);
  for (std::size_t i = 0; i < count; i++) {
    for (std::size_t c = 0; c < 3; c++) floats[4 * i + c] = rgb[c][i];
    if (alpha != nullptr) floats[4 * i + 3] = alpha->values[i];
  }
  return floats;
}

void check_floats(const TextureImage &image, const std::string &path) {
  for (std::size_t i = 0; i < image.floats.size(); i++) {
    if (std::fabs(image.floats[i]) <= kMaxTexel) continue;
    const std::size_t pixel = i / 4, width = static_cast<std::size_t>(image.width);
    throw InputError(
        fmt::format("{}: {} at pixel ({}, {}); numbers must be finite and at most 1e36", path,
                    image.floats[i], pixel % width, pixel / width));
  }
}

bool is_float_file(const std::string &path) {
  return is_image_path(path) && image_format(path) != ImageFormat::kPng;
}

}  // namespace

TextureImage read_texture_image(const std::string &path, bool srgb, std::int64_t max_bytes,
                                std::int64_t max_floats) {
  TextureImage texture;
  if (is_float_file(path)) {
    const Image image = read_image(path, max_floats / 4);
    texture.width = image.width;
    texture.height = image.height;
    texture.floats = floats_of(image, path);
    check_floats(texture, path);
    return texture;
  }
  Picture picture = decode_picture(read_file(path), path, max_bytes);
  texture.width = picture.width;
  texture.height = picture.height;
  texture.bytes = std::move(picture.pixels8);
  if (static_cast<std::int64_t>(picture.values16.size()) > max_floats)
    throw InputError(fmt::format("{}: {} x {} pixels of 16 bits; there is room for {}", path,
                                 texture.width, texture.height, max_floats / 4));
  texture.floats = floats_of(picture.values16, srgb);
  return texture;
}

}  // namespace phalanx
