// Pictures as they are stored: PNG and JPEG, 8 or 16 bits a channel, not decoded from sRGB.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace phalanx {

struct Picture {
  int width = 0, height = 0;
  // RGBA, rows from the top; grey is repeated, alpha without one is full. One of the two is empty.
  std::vector<std::uint32_t> pixels8;   // [width * height] red in the lowest byte
  std::vector<std::uint16_t> values16;  // [width * height * 4] PNG only
};

/// `name` is for messages. Throws InputError for a file that is damaged or cut, that claims more pixels
/// than it can hold, or more than `max_pixels`.
Picture decode_picture(const std::string &bytes, const std::string &name, std::int64_t max_pixels);

}  // namespace phalanx
