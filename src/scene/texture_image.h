// The texels of an image file, as kernels read them.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace phalanx {

struct TextureImage {
  int width = 0, height = 0;
  // Rows from the top. One of the two is empty.
  std::vector<std::uint32_t>
      bytes;                  // [width * height] red in the lowest byte, then green, blue, alpha
  std::vector<float> floats;  // [width * height * 4] linear
};

/// Reads a PNG, JPEG, HDR or EXR. Files of 8 bits a channel stay bytes, as they are stored; others become
/// floats, decoded if `srgb` says so. At most max_bytes and max_floats of each may come out.
/// Throws InputError for what cannot be read, is too large, or holds numbers that are not finite.
TextureImage read_texture_image(const std::string &path, bool srgb, std::int64_t max_bytes,
                                std::int64_t max_floats);

}  // namespace phalanx
