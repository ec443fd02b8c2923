// "film": the picture, its reconstruction filter and what part of it is rendered.
#include "read_scene.h"

namespace phalanx {

namespace {

constexpr int kMaxSide = 65536;         // pixels
constexpr double kMaxPixels = 1 << 30;  // pixel indices fit int32 with room to spare
constexpr Range kFilterSize = {0.01, 16, "pixels"};

void read_filter(const Node &node, Source &source, FilmDescription &film) {
  ObjectReader object(node, source);
  int type = film.filter;
  object.choice("type",
                {{"box", kBoxFilter},
                 {"gaussian", kGaussianFilter},
                 {"blackman_harris", kBlackmanHarrisFilter}},
                type);
  if (!object.ok()) return;
  film.filter = static_cast<FilterKind>(type);
  if (film.filter == kBoxFilter) film.filter_radius = 0.5;  // one pixel wide
  object.number("radius", kFilterSize, film.filter_radius);
  if (film.filter == kGaussianFilter) object.number("sigma", kFilterSize, film.filter_sigma);
  object.finish(film.filter == kBoxFilter        ? "a box filter"
                : film.filter == kGaussianFilter ? "a gaussian filter"
                                                 : "a blackman_harris filter");
}

/// [x, y, width, height] in pixels, inside the picture.
void read_crop(const Node &node, Source &source, FilmDescription &film) {
  if (node.value->kind != JsonKind::kArray || node.value->items().size() != 4) {
    return source.expected(node, "four whole numbers [x, y, width, height]");
  }
  std::array<int, 4> crop = {};
  bool good = true;
  for (std::size_t i = 0; i < 4; i++) {
    const int least = i < 2 ? 0 : 1;
    good &= check_integer(node.item(i), least, kMaxSide, source, crop[i]);
  }
  if (!good) return;
  if (crop[0] + crop[2] > film.width || crop[1] + crop[3] > film.height) {
    return source.error(node, "the crop reaches to (" + std::to_string(crop[0] + crop[2]) + ", " +
                                  std::to_string(crop[1] + crop[3]) +
                                  "), outside of the picture of " + std::to_string(film.width) +
                                  " x " + std::to_string(film.height) + " pixels");
  }
  film.crop = crop;
}

}  // namespace

FilmDescription read_film(const Node &node, Source &source) {
  FilmDescription film;
  ObjectReader object(node, source);
  object.integer("width", 1, kMaxSide, film.width);
  object.integer("height", 1, kMaxSide, film.height);
  const bool known_size = object.ok();
  if (static_cast<double>(film.width) * film.height > kMaxPixels) {
    object.error("width x height is more than 2^30 pixels");
  }
  if (const auto filter = object.find("filter")) read_filter(*filter, source, film);
  const auto crop = object.find("crop");
  if (crop && known_size) read_crop(*crop, source, film);
  object.number("exposure", {-64, 64, "stops"}, film.exposure);
  object.finish("film");
  return film;
}

}  // namespace phalanx
