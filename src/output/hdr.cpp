// The RGBE pixel, the run-length coded scanline, and the header around them.
#include "hdr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "../core/error.h"
#include "limits.h"

namespace phalanx {
namespace {

using Rgbe = std::array<unsigned char, 4>;

// ---- pixels ------------------------------------------------------------------------------------

float clip(float x) {
  constexpr float largest = 255.0f * 0x1p119f;  // mantissa 255, exponent 127
  return x > 0 ? std::min(x, largest) : 0.0f;   // NaN gives 0
}

Rgbe rgbe_from_linear(float red, float green, float blue) {
  red = clip(red);
  green = clip(green);
  blue = clip(blue);
  int exponent = 0;
  const float largest = std::max({red, green, blue});
  std::frexp(largest, &exponent);                               // largest < 2^exponent
  if (std::ldexp(largest, 8 - exponent) >= 255.5f) exponent++;  // would round to 256
  if (largest == 0 || exponent < -127) return {0, 0, 0, 0};
  const auto mantissa = [&](float x) {
    return static_cast<unsigned char>(std::ldexp(x, 8 - exponent) + 0.5f);
  };
  return {mantissa(red), mantissa(green), mantissa(blue),
          static_cast<unsigned char>(exponent + 128)};
}

float linear_from_rgbe(unsigned char mantissa, unsigned char exponent) {
  return exponent == 0 ? 0.0f : std::ldexp(static_cast<float>(mantissa), exponent - (128 + 8));
}

// ---- scanlines ---------------------------------------------------------------------------------

/// Only scanlines of 8 to 32767 pixels can be run-length coded; others are stored as they are.
bool has_runs(int width) { return width >= 8 && width < 32768; }

/// One component of a scanline. A code above 128 repeats the next byte code - 128 times; a code up
/// to 128 is followed by that many bytes.
void append_runs(std::string &out, const std::vector<Rgbe> &row, int component) {
  const auto value = [&](std::size_t i) { return static_cast<char>(row[i][component]); };
  const auto run_length = [&](std::size_t i) {
    std::size_t n = 1;
    while (n < 127 && i + n < row.size() && value(i + n) == value(i)) n++;
    return n;
  };
  std::size_t i = 0;
  while (i < row.size()) {
    if (const std::size_t run = run_length(i); run >= 4) {
      out += static_cast<char>(128 + run);
      out += value(i);
      i += run;
      continue;
    }
    std::size_t end = i;
    while (end < row.size() && end - i < 128 && run_length(end) < 4) end++;
    out += static_cast<char>(end - i);
    for (; i < end; i++) out += value(i);
  }
}

void append_scanline(std::string &out, const std::vector<Rgbe> &row) {
  const std::size_t width = row.size();
  if (!has_runs(static_cast<int>(width))) {
    for (const Rgbe &pixel : row) out.append(pixel.begin(), pixel.end());
    return;
  }
  out += {2, 2, static_cast<char>(width >> 8), static_cast<char>(width & 0xff)};
  for (int component = 0; component < 4; component++) append_runs(out, row, component);
}

/// Reads bytes in order and throws at the end of the file.
class Reader {
 public:
  Reader(const std::string &bytes, const std::string &name) : bytes_(bytes), name_(name) {}

  [[noreturn]] void damaged(const std::string &why) const {
    throw InputError(fmt::format("{}: not an HDR that can be read: {}", name_, why));
  }
  unsigned char next() {
    if (at_ >= bytes_.size()) damaged("the file ends too early");
    return static_cast<unsigned char>(bytes_[at_++]);
  }
  std::string line() {
    const std::size_t end = bytes_.find('\n', at_);
    if (end == std::string::npos) damaged("the header has no end");
    const std::string text = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    return text;
  }
  bool starts_coded_scanline(int width) const {
    return has_runs(width) && at_ + 4 <= bytes_.size() && bytes_[at_] == 2 &&
           bytes_[at_ + 1] == 2 && (bytes_[at_ + 2] & 0x80) == 0;
  }

 private:
  const std::string &bytes_;
  const std::string &name_;
  std::size_t at_ = 0;
};

void read_runs(Reader &reader, std::vector<Rgbe> &row, int component) {
  std::size_t i = 0;
  while (i < row.size()) {
    const unsigned char code = reader.next();
    const std::size_t count = code > 128 ? code - 128 : code;
    if (count == 0 || count > row.size() - i) reader.damaged("a run leaves its scanline");
    const bool repeat = code > 128;
    unsigned char value = repeat ? reader.next() : 0;
    for (std::size_t k = 0; k < count; k++) {
      if (!repeat) value = reader.next();
      row[i++][component] = value;
    }
  }
}

void read_scanline(Reader &reader, std::vector<Rgbe> &row) {
  const int width = static_cast<int>(row.size());
  if (!reader.starts_coded_scanline(width)) {
    for (Rgbe &pixel : row)
      for (unsigned char &byte : pixel) byte = reader.next();
    return;
  }
  reader.next();
  reader.next();
  const int high = reader.next();
  if (high * 256 + reader.next() != width) reader.damaged("a scanline has another width");
  for (int component = 0; component < 4; component++) read_runs(reader, row, component);
}

// ---- the header --------------------------------------------------------------------------------

std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::string header(const Image &image) {
  std::string text = "#?RADIANCE\n";
  for (const auto &[key, value] : image.metadata)
    text += fmt::format("# {}={}\n", one_line(key), one_line(value));
  return text + fmt::format("FORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
}

Image read_header(Reader &reader) {
  const std::string signature = reader.line();
  if (signature != "#?RADIANCE" && signature != "#?RGBE")
    reader.damaged("no #?RADIANCE at its start");
  Metadata metadata;
  bool known_format = false;
  for (std::string line = reader.line(); !line.empty(); line = reader.line()) {
    if (line == "FORMAT=32-bit_rle_rgbe") known_format = true;
    const std::size_t equals = line.find('=');
    if (line.starts_with("# ") && equals != std::string::npos)
      metadata.emplace_back(line.substr(2, equals - 2), line.substr(equals + 1));
  }
  if (!known_format) reader.damaged("only FORMAT=32-bit_rle_rgbe is supported");
  Image image;
  const std::string size = reader.line();
  if (std::sscanf(size.c_str(), "-Y %9d +X %9d", &image.height, &image.width) != 2)
    reader.damaged("expected \"-Y height +X width\", found \"" + size.substr(0, 40) + '"');
  image.full_width = image.width;
  image.full_height = image.height;
  image.metadata = metadata;
  return image;
}

}  // namespace

std::string encode_hdr(const Image &image) {
  const auto planes = rgb_planes(image);
  std::string bytes = header(image);
  std::vector<Rgbe> row(static_cast<std::size_t>(image.width));
  for (int y = 0; y < image.height; y++) {
    for (int x = 0; x < image.width; x++) {
      const std::int64_t i = std::int64_t{y} * image.width + x;
      row[x] = rgbe_from_linear(planes[0][i], planes[1][i], planes[2][i]);
    }
    append_scanline(bytes, row);
  }
  return bytes;
}

Image decode_hdr(const std::string &bytes, const std::string &name, std::int64_t max_pixels) {
  Reader reader(bytes, name);
  Image image = read_header(reader);
  const double max_ratio = 127.0 / 2;  // a run of 127 equal bytes takes two
  check_image_claim(image.width, image.height, 4, bytes.size(), max_ratio, name, max_pixels);
  for (const char *channel : {"R", "G", "B"}) add_channel(image, channel);

  std::vector<Rgbe> row(static_cast<std::size_t>(image.width));
  for (int y = 0; y < image.height; y++) {
    read_scanline(reader, row);
    for (int x = 0; x < image.width; x++)
      for (int c = 0; c < 3; c++)
        image.channels[c].values[std::int64_t{y} * image.width + x] =
            linear_from_rgbe(row[x][c], row[x][3]);
  }
  return image;
}

}  // namespace phalanx
