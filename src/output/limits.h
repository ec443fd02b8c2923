// How large an image a file may claim to hold, asked before anything is allocated.
#pragma once
#include <cstdint>
#include <string>

namespace phalanx {

inline constexpr std::int64_t kMaxImageSide = 1 << 20;  // pixels

/// Throws InputError unless both sides are in [1, kMaxImageSide] and width * height pixels of
/// `bytes_per_pixel` can come from a file of `file_size` bytes that is compressed at most
/// `max_ratio` times, and are at most `max_pixels`. One megabyte is always granted.
void check_image_claim(std::int64_t width, std::int64_t height, std::int64_t bytes_per_pixel,
                       std::size_t file_size, double max_ratio, const std::string &name,
                       std::int64_t max_pixels = INT64_MAX);

}  // namespace phalanx
