// PNG by way of stb, with our own tEXt chunks around it.
#include "png.h"

#include <fmt/format.h>
#define STBI_NO_STDIO
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>
#include <memory>

#include "../core/error.h"
#include "../core/srgb.h"
#include "limits.h"

namespace phalanx {
namespace {

constexpr std::size_t kSignatureBytes = 8;
constexpr std::size_t kEndChunkBytes = 12;  // IEND: length, type, checksum
constexpr std::size_t kZerosAfterKey = 5;   // iTXt: end of key, no compression, no language
constexpr double kMaxDeflateRatio = 1032;   // of the method itself

// ---- chunks ------------------------------------------------------------------------------------

std::uint32_t checksum(const std::string &bytes) {  // CRC-32, PNG specification annex D
  static const std::array<std::uint32_t, 256> table = [] {
    std::array<std::uint32_t, 256> t{};
    for (std::uint32_t n = 0; n < 256; n++) {
      std::uint32_t c = n;
      for (int k = 0; k < 8; k++) c = (c & 1) ? 0xedb88320u ^ (c >> 1) : c >> 1;
      t[n] = c;
    }
    return t;
  }();
  std::uint32_t crc = 0xffffffffu;
  for (const char byte : bytes)
    crc = table[(crc ^ static_cast<unsigned char>(byte)) & 0xff] ^ (crc >> 8);
  return crc ^ 0xffffffffu;
}

std::string big_endian(std::uint32_t n) {
  return {static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8),
          static_cast<char>(n)};
}

std::uint32_t from_big_endian(const std::string &bytes, std::size_t at) {
  std::uint32_t n = 0;
  for (std::size_t i = 0; i < 4; i++) n = (n << 8) | static_cast<unsigned char>(bytes[at + i]);
  return n;
}

std::string chunk(const std::string &type, const std::string &data) {
  const std::string body = type + data;
  return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(checksum(body));
}

/// tEXt is Latin-1; what goes beyond ASCII is UTF-8 in an iTXt: not compressed, no language.
std::string text_chunks(const Metadata &metadata) {
  std::string chunks;
  for (const auto &[key, value] : metadata) {
    const bool ascii = std::all_of(value.begin(), value.end(), [](char c) { return c >= 0; });
    chunks += ascii ? chunk("tEXt", key.substr(0, 79) + std::string(1, '\0') + value)
                    : chunk("iTXt", key.substr(0, 79) + std::string(kZerosAfterKey, '\0') + value);
  }
  return chunks;
}

Metadata read_text_chunks(const std::string &bytes) {
  Metadata metadata;
  std::size_t at = kSignatureBytes;
  while (at + 12 <= bytes.size()) {
    const std::size_t length = from_big_endian(bytes, at);
    if (length > bytes.size() - at - 12) break;
    const bool is_latin = bytes.compare(at + 4, 4, "tEXt") == 0;
    if (is_latin || bytes.compare(at + 4, 4, "iTXt") == 0) {
      const std::string text = bytes.substr(at + 8, length);
      const std::string separator(is_latin ? 1 : kZerosAfterKey, '\0');
      const std::size_t end_of_key = text.find(separator);
      if (end_of_key != std::string::npos)
        metadata.emplace_back(text.substr(0, end_of_key),
                              text.substr(end_of_key + separator.size()));
    }
    at += length + 12;
  }
  return metadata;
}

// ---- pixels ------------------------------------------------------------------------------------

unsigned char byte_from_linear(double x) {
  if (!(x > 0)) return 0;  // NaN too
  return static_cast<unsigned char>(srgb_from_linear(std::min(x, 1.0)) * 255 + 0.5);
}

void append(void *context, void *data, int size) {
  static_cast<std::string *>(context)->append(static_cast<const char *>(data),
                                              static_cast<std::size_t>(size));
}

}  // namespace

std::string encode_png(const Image &image, double exposure) {
  const std::int64_t row_bytes = std::int64_t{image.width} * 3 + 1;
  if (row_bytes * image.height > INT_MAX)
    throw WriteError(
        fmt::format("a PNG of {} x {} pixels is more than its writer can hold (2 GiB); "
                    "write an EXR",
                    image.width, image.height));
  const auto planes = rgb_planes(image);
  const double scale = std::exp2(exposure);
  std::vector<unsigned char> pixels(static_cast<std::size_t>(image.num_pixels()) * 3);
  for (std::size_t i = 0; i < pixels.size(); i++)
    pixels[i] = byte_from_linear(double{planes[i % 3][i / 3]} * scale);

  std::string bytes;
  if (!stbi_write_png_to_func(append, &bytes, image.width, image.height, 3, pixels.data(),
                              image.width * 3) ||
      bytes.size() < kEndChunkBytes)
    throw MemoryError("out of memory while compressing a PNG");
  bytes.insert(bytes.size() - kEndChunkBytes, text_chunks(image.metadata));
  return bytes;
}

Image decode_png(const std::string &bytes, const std::string &name, std::int64_t max_pixels) {
  const auto damaged = [&](const char *why) {
    return InputError(fmt::format("{}: not a PNG that can be read: {}", name, why));
  };
  if (!bytes.starts_with("\x89PNG")) throw damaged("it does not begin as one");
  if (bytes.size() > INT_MAX) throw damaged("larger than 2 GiB");
  const auto *data = reinterpret_cast<const stbi_uc *>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, num_channels = 0;
  if (!stbi_info_from_memory(data, size, &width, &height, &num_channels))
    throw damaged(stbi_failure_reason());
  check_image_claim(width, height, 1, bytes.size(), 8 * kMaxDeflateRatio, name,
                    max_pixels);  // 1 bit a pixel

  const std::unique_ptr<stbi_us, void (*)(void *)> pixels(
      stbi_load_16_from_memory(data, size, &width, &height, &num_channels, 3), stbi_image_free);
  if (!pixels) throw damaged(stbi_failure_reason());

  Image image = make_image(width, height);
  image.metadata = read_text_chunks(bytes);
  for (int c = 0; c < 3; c++) {
    std::vector<float> &plane = add_channel(image, std::string(1, "RGB"[c]));
    for (std::size_t i = 0; i < plane.size(); i++)
      plane[i] = static_cast<float>(linear_from_srgb(pixels.get()[3 * i + c] / 65535.0));
  }
  return image;
}

}  // namespace phalanx
