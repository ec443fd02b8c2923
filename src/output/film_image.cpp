// Copies what the film knows into planes.
#include "film_image.h"

#include <fmt/format.h>

#include <sstream>

#include "../core/error.h"

namespace phalanx {
namespace {

/// Adds three planes of a vector quantity, named by `names`.
template <typename Quantity>
void add_vector(Image &image, const std::string &prefix, const char *names, Quantity quantity) {
  const std::size_t first = image.channels.size();
  for (int c = 0; c < 3; c++) add_channel(image, prefix + names[c]);
  for (std::int64_t i = 0; i < image.num_pixels(); i++) {
    const Vec3 v = quantity(i);
    image.channels[first].values[i] = v.x;
    image.channels[first + 1].values[i] = v.y;
    image.channels[first + 2].values[i] = v.z;
  }
}

template <typename Quantity>
void add_scalar(Image &image, const std::string &name, Quantity quantity) {
  std::vector<float> &values = add_channel(image, name);
  for (std::int64_t i = 0; i < image.num_pixels(); i++) values[i] = static_cast<float>(quantity(i));
}

}  // namespace

Layers layers_from_list(const std::string &list) {
  Layers layers;
  std::istringstream names(list);
  for (std::string name; std::getline(names, name, ',');) {
    if (name == "all")
      layers = {true, true, true, true, true};
    else if (name == "albedo")
      layers.albedo = true;
    else if (name == "normal")
      layers.normal = true;
    else if (name == "depth")
      layers.depth = true;
    else if (name == "samples")
      layers.samples = true;
    else if (name == "variance")
      layers.variance = true;
    else
      throw InputError(
          fmt::format("--aov: unknown layer \"{}\"; known are albedo, normal, depth, "
                      "samples, variance and all",
                      name));
  }
  if (!layers.any()) throw InputError("--aov: the list is empty");
  return layers;
}

Image image_from_film(const Film &film, int full_width, int full_height, const Layers &layers) {
  const Rect crop = film.crop();
  Image image = make_image(crop.width, crop.height);
  image.x = crop.x;
  image.y = crop.y;
  image.full_width = full_width;
  image.full_height = full_height;
  using Pixel = std::int64_t;
  add_vector(image, "", "RGB", [&](Pixel i) { return film.mean(i); });
  if (layers.albedo) add_vector(image, "albedo.", "RGB", [&](Pixel i) { return film.albedo(i); });
  if (layers.normal) add_vector(image, "normal.", "XYZ", [&](Pixel i) { return film.normal(i); });
  if (layers.depth) add_scalar(image, "depth.Z", [&](Pixel i) { return film.depth(i); });
  if (layers.samples) add_scalar(image, "samples", [&](Pixel i) { return film.sample_count(i); });
  if (layers.variance)
    add_vector(image, "variance.", "RGB", [&](Pixel i) { return film.variance_of_mean(i); });
  return image;
}

}  // namespace phalanx
