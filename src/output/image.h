// An image in memory: named planes of floats, and facts about it as text.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace phalanx {

struct Channel {
  std::string name;           // "R", "albedo.R", "samples"
  std::vector<float> values;  // [width * height], rows from the top
};

using Metadata = std::vector<std::pair<std::string, std::string>>;  // key, value

struct Image {
  int width = 0, height = 0;
  int x = 0, y = 0;                     // of the top left pixel in the full picture
  int full_width = 0, full_height = 0;  // of the picture this is a window of
  std::vector<Channel> channels;
  Metadata metadata;

  std::int64_t num_pixels() const { return std::int64_t{width} * height; }
};

/// An image that is a whole picture, without channels yet.
Image make_image(int width, int height);

/// Adds a channel of zeros and returns its values. References go stale when the next is added.
std::vector<float> &add_channel(Image &image, const std::string &name);

/// nullptr if there is no such channel.
const Channel *find_channel(const Image &image, const std::string &name);
/// Empty if there is no such key.
std::string find_metadata(const Image &image, const std::string &key);

/// The planes prefix + "R", "G", "B"; for prefix "" a lone "Y" serves for all three. nullptrs if
/// they are missing.
std::array<const float *, 3> rgb_planes(const Image &image, const std::string &prefix = "");

}  // namespace phalanx
