// PNG and JPEG by way of stb.
#include "picture.h"

#include <fmt/format.h>
#define STBI_NO_STDIO
#include <stb/stb_image.h>

#include <climits>
#include <memory>

#include "../core/error.h"
#include "jpeg_check.h"
#include "limits.h"

namespace phalanx {
namespace {

/// Pixels in a byte at most. PNG: 1 bit a pixel under deflate. JPEG: a progressive block of 64 may cost
/// one bit.
constexpr double kMaxPngRatio = 8 * 1032, kMaxJpegRatio = 8 * 64;

/// What stb takes for one: filling may come before the first marker.
bool is_jpeg(const std::string &bytes) { return bytes.starts_with('\xff'); }

template <typename T>
using Decoded = std::unique_ptr<T, void (*)(void *)>;

}  // namespace

Picture decode_picture(const std::string &bytes, const std::string &name, std::int64_t max_pixels) {
  const auto unreadable = [&](const char *why) {
    return InputError(fmt::format("{}: not a PNG or JPEG that can be read: {}", name, why));
  };
  if (bytes.size() > INT_MAX) throw unreadable("larger than 2 GiB");
  const std::string problem = is_jpeg(bytes) ? check_jpeg(bytes) : "";
  if (!problem.empty()) throw unreadable(problem.c_str());
  const auto *data = reinterpret_cast<const stbi_uc *>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  Picture picture;
  int num_channels = 0;
  if (!stbi_info_from_memory(data, size, &picture.width, &picture.height, &num_channels))
    throw unreadable(stbi_failure_reason());
  check_image_claim(picture.width, picture.height, 1, bytes.size(),
                    is_jpeg(bytes) ? kMaxJpegRatio : kMaxPngRatio, name, max_pixels);

  const auto count =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  int width = 0, height = 0;
  if (stbi_is_16_bit_from_memory(data, size)) {
    const Decoded<stbi_us> values(
        stbi_load_16_from_memory(data, size, &width, &height, &num_channels, 4), stbi_image_free);
    if (!values) throw unreadable(stbi_failure_reason());
    picture.values16.assign(values.get(), values.get() + 4 * count);
    return picture;
  }
  const Decoded<stbi_uc> values(
      stbi_load_from_memory(data, size, &width, &height, &num_channels, 4), stbi_image_free);
  if (!values) throw unreadable(stbi_failure_reason());
  picture.pixels8.resize(count);
  for (std::size_t i = 0; i < count; i++) {
    const stbi_uc *p = values.get() + 4 * i;
    picture.pixels8[i] =
        p[0] | std::uint32_t{p[1]} << 8 | std::uint32_t{p[2]} << 16 | std::uint32_t{p[3]} << 24;
  }
  return picture;
}

}  // namespace phalanx
