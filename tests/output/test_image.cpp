// Images survive a round trip as well as their format allows, and damaged ones are refused.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "output/exr.h"
#include "output/files.h"
#include "output/film_image.h"
#include "output/hdr.h"
#include "output/image_file.h"
#include "output/png.h"
#include "temp_dir.h"

using namespace phalanx;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// Smooth in places and not in others, so that run lengths of all kinds occur.
Image picture(int width, int height) {
  Image image = make_image(width, height);
  for (int c = 0; c < 3; c++) {
    std::vector<float> &plane = add_channel(image, std::string(1, "RGB"[c]));
    for (std::size_t i = 0; i < plane.size(); i++)
      plane[i] = i % 97 < 40 ? 0.25f : std::exp2(static_cast<float>((i * 7919 + c * 31) % 40) - 20);
  }
  image.metadata = {{"phalanx.mode", "wavefront"}, {"phalanx.scene", "Bücher/scene.json"}};
  return image;
}

template <typename Decode>
void check_every_truncation(const std::string &bytes, Decode decode) {
  const std::size_t step = std::max<std::size_t>(1, bytes.size() / 2000);
  for (std::size_t size = 0; size < bytes.size(); size += step)
    CHECK_THROWS_AS(decode(bytes.substr(0, size), "cut", INT64_MAX), InputError);
}

void check_metadata(const Image &image) {
  CHECK(find_metadata(image, "phalanx.mode") == "wavefront");
  CHECK(find_metadata(image, "phalanx.scene") == "Bücher/scene.json");
}

}  // namespace

TEST_CASE("exr: every bit, every channel, the window and the facts come back") {
  Image image = picture(37, 11);
  image.x = 100;
  image.y = 50;
  image.full_width = 640;
  image.full_height = 480;
  image.channels[0].values[3] = kNan;
  image.channels[1].values[4] = kInf;
  image.channels[2].values[5] = -1e-30f;
  add_channel(image, "depth.Z")[7] = 1e30f;

  const Image copy = decode_exr(encode_exr(image), "copy");
  CHECK(copy.width == 37);
  CHECK(copy.height == 11);
  CHECK(copy.x == 100);
  CHECK(copy.y == 50);
  CHECK(copy.full_width == 640);
  CHECK(copy.full_height == 480);
  REQUIRE(copy.channels.size() == 4);
  for (const Channel &channel : image.channels) {
    const Channel *other = find_channel(copy, channel.name);
    REQUIRE(other != nullptr);
    for (std::size_t i = 0; i < channel.values.size(); i++)
      REQUIRE(std::bit_cast<std::uint32_t>(channel.values[i]) ==
              std::bit_cast<std::uint32_t>(other->values[i]));
  }
  check_metadata(copy);
}

TEST_CASE("hdr: the largest channel of each pixel comes back to 1 in 500") {
  for (const auto &[width, height] : {std::pair(1, 1), {7, 3}, {8, 2}, {300, 5}, {33000, 1}}) {
    CAPTURE(width);
    const Image image = picture(width, height);
    const Image copy = decode_hdr(encode_hdr(image), "copy");
    REQUIRE(copy.width == width);
    REQUIRE(copy.height == height);
    const auto a = rgb_planes(image), b = rgb_planes(copy);
    for (std::int64_t i = 0; i < image.num_pixels(); i++) {
      const float largest = std::max({a[0][i], a[1][i], a[2][i]});
      for (int c = 0; c < 3; c++) REQUIRE(std::fabs(a[c][i] - b[c][i]) <= largest / 255);
      REQUIRE(std::max({b[0][i], b[1][i], b[2][i]}) == doctest::Approx(largest).epsilon(1.0 / 250));
    }
    check_metadata(copy);
  }
}

TEST_CASE("hdr: numbers at the edge of the format") {
  Image image = make_image(8, 1);
  for (const char *name : {"R", "G", "B"})
    add_channel(image, name) = {kNan, -1, kInf, 3e38f, 1e-45f, 0, 255.9f, 1e-37f};
  const Image copy = decode_hdr(encode_hdr(image), "copy");
  const std::vector<float> &red = copy.channels[0].values;
  CHECK(red[0] == 0);
  CHECK(red[1] == 0);
  CHECK(red[2] == 255 * 0x1p119f);
  CHECK(red[3] == 255 * 0x1p119f);
  CHECK(red[4] == 0);
  CHECK(red[5] == 0);
  CHECK(red[6] == 256);  // rounds up to the next exponent
  CHECK(red[7] == doctest::Approx(1e-37).epsilon(0.004));
}

TEST_CASE("png: colours come back to half a step of 8-bit sRGB") {
  Image image = make_image(256, 2);
  for (const char *name : {"R", "G", "B"}) {
    std::vector<float> &plane = add_channel(image, name);
    for (int i = 0; i < 512; i++) plane[i] = static_cast<float>(i) / 511;
  }
  image.metadata = picture(1, 1).metadata;
  const Image copy = decode_png(encode_png(image, 0), "copy");
  const auto srgb = [](double x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
  };
  for (int c = 0; c < 3; c++)
    for (int i = 0; i < 512; i++)
      REQUIRE(std::fabs(srgb(double{copy.channels[c].values[i]}) -
                        srgb(double{image.channels[c].values[i]})) <= 0.5001 / 255);
  check_metadata(copy);
}

TEST_CASE("png: exposure is in stops; what does not fit is clipped") {
  Image image = make_image(5, 1);
  for (const char *name : {"R", "G", "B"}) add_channel(image, name) = {0.25f, 1e9f, -1, kNan, kInf};
  const Image shown = decode_png(encode_png(image, 2), "shown");
  const std::vector<float> expected = {1, 1, 0, 0, 1};
  CHECK(shown.channels[0].values == expected);
}

TEST_CASE("png: text chunks have the checksum that other programs expect") {
  Image image = make_image(1, 1);
  for (const char *name : {"R", "G", "B"}) add_channel(image, name);
  image.metadata = {{"Title", "box"}};
  const std::string chunk("\0\0\0\x09tEXtTitle\0box\xc1\x17\x70\x15", 21);
  CHECK(encode_png(image, 0).find(chunk) != std::string::npos);
}

TEST_CASE("images: a file cut anywhere is refused") {
  const Image image = picture(40, 6);
  check_every_truncation(encode_hdr(image), decode_hdr);  // stb_image 2.27 never came back
  check_every_truncation(encode_exr(image), decode_exr);
  const std::string png = encode_png(image, 0);
  check_every_truncation(png.substr(0, png.size() - 12), decode_png);  // IEND itself may be missing
}

TEST_CASE("images: a header that promises too much is refused before memory is taken") {
  const std::string hdr = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 900000 +X 900000\n";
  CHECK_THROWS_AS(decode_hdr(hdr, "bomb"), InputError);
  CHECK_THROWS_AS(decode_hdr("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y -5 +X 8\n", "bomb"),
                  InputError);

  std::string png = encode_png(picture(4, 4), 0);
  png.replace(16, 8, std::string("\0\x0f\0\0\0\x0f\0\0", 8));  // 983040 x 983040
  CHECK_THROWS_AS(decode_png(png, "bomb"), InputError);

  std::string exr = encode_exr(picture(4, 4));
  const std::size_t window = exr.find("box2i", exr.find("dataWindow")) + 6 + 4;
  exr.replace(window + 8, 8, std::string("\0\0\x0e\0\0\0\x0e\0", 8));
  CHECK_THROWS_AS(decode_exr(exr, "bomb"), InputError);
}

TEST_CASE("images: the extension picks the format, others are refused by name") {
  CHECK(image_format("a.b/c.EXR") == ImageFormat::kExr);
  CHECK(image_format("x.hdr") == ImageFormat::kHdr);
  CHECK(image_format("x.png") == ImageFormat::kPng);
  CHECK(image_format("/dev/null") == ImageFormat::kPng);
  CHECK_THROWS_WITH_AS(image_format("x.jpg"),
                       "x.jpg: unknown extension .jpg; an image's name ends in .exr, .hdr or .png",
                       InputError);
  CHECK_THROWS_AS(image_format("x"), InputError);
}

TEST_CASE("images: a full device is a write error in every format") {
  const TempDir dir;
  for (const char *name : {"a.exr", "a.hdr", "a.png"}) {
    std::filesystem::create_symlink("/dev/full", dir / name);
    CHECK_THROWS_AS(write_image(dir / name, picture(8, 8), 0), WriteError);
  }
}

TEST_CASE("images: layers of a film") {
  Film film({3, 4, 2, 1}, true);
  InvalidSamples invalid;
  const float samples[] = {1, 2, 3, 3, 4, 5};
  const float first_hit[] = {0.5f, 0.25f, 0, 0, 0, 1, 9};
  film.add_samples(4, 4, samples, 2, 0, invalid);
  film.add_aovs(4, 4, first_hit, 1);
  const Image image = image_from_film(film, 10, 20, layers_from_list("all"));
  CHECK(image.x == 3);
  CHECK(image.full_height == 20);
  CHECK(find_channel(image, "R")->values[1] == 2);
  CHECK(find_channel(image, "B")->values[1] == 4);
  CHECK(find_channel(image, "samples")->values == std::vector<float>{0, 2});
  CHECK(find_channel(image, "variance.G")->values[1] == 1);
  CHECK(find_channel(image, "albedo.G")->values[1] == 0.25f);
  CHECK(find_channel(image, "normal.Z")->values[1] == 1);
  CHECK(find_channel(image, "depth.Z")->values[1] == 9);
  CHECK(image.channels.size() == 14);
  CHECK(image_from_film(film, 10, 20, {}).channels.size() == 3);
}

TEST_CASE("images: unknown layers are named") {
  CHECK(layers_from_list("albedo,depth").depth);
  CHECK_FALSE(layers_from_list("samples,variance").need_first_hits());
  CHECK_THROWS_AS(layers_from_list("albedo,colour"), InputError);
  CHECK_THROWS_AS(layers_from_list(","), InputError);
}
