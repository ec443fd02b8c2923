// Looking things up in an image.
#include "image.h"

namespace phalanx {

Image make_image(int width, int height) {
  Image image;
  image.width = image.full_width = width;
  image.height = image.full_height = height;
  return image;
}

std::vector<float> &add_channel(Image &image, const std::string &name) {
  image.channels.push_back({name, std::vector<float>(image.num_pixels(), 0.0f)});
  return image.channels.back().values;
}

const Channel *find_channel(const Image &image, const std::string &name) {
  for (const Channel &channel : image.channels)
    if (channel.name == name) return &channel;
  return nullptr;
}

std::string find_metadata(const Image &image, const std::string &key) {
  for (const auto &[name, value] : image.metadata)
    if (name == key) return value;
  return "";
}

std::array<const float *, 3> rgb_planes(const Image &image, const std::string &prefix) {
  const Channel *red = find_channel(image, prefix + "R");
  const Channel *green = find_channel(image, prefix + "G");
  const Channel *blue = find_channel(image, prefix + "B");
  if (prefix.empty() && !red && !green && !blue) red = green = blue = find_channel(image, "Y");
  if (!red || !green || !blue) return {nullptr, nullptr, nullptr};
  return {red->values.data(), green->values.data(), blue->values.data()};
}

}  // namespace phalanx
