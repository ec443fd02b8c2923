// Refuses dimension bombs: a header of 30 bytes that asks for terabytes.
#include "limits.h"

#include <fmt/format.h>

#include "../core/error.h"

namespace phalanx {

void check_image_claim(std::int64_t width, std::int64_t height, std::int64_t bytes_per_pixel,
                       std::size_t file_size, double max_ratio, const std::string &name,
                       std::int64_t max_pixels) {
  if (width < 1 || height < 1 || width > kMaxImageSide || height > kMaxImageSide)
    throw InputError(fmt::format("{}: {} x {} pixels; each side must be in 1 to {}", name, width,
                                 height, kMaxImageSide));
  const double always_granted = 1e6;
  const double claimed = static_cast<double>(width) * static_cast<double>(height) *
                         static_cast<double>(bytes_per_pixel);
  if (claimed > always_granted + max_ratio * static_cast<double>(file_size))
    throw InputError(fmt::format("{}: damaged: claims {} x {} pixels in a file of {} bytes", name,
                                 width, height, file_size));
  if (width * height > max_pixels)
    throw InputError(
        fmt::format("{}: {} x {} pixels; there is room for {}", name, width, height, max_pixels));
}

}  // namespace phalanx
