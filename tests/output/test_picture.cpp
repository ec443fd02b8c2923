// PNG and JPEG as they are stored, and what is refused before stb_image sees it.
#include <doctest/doctest.h>
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include <cstdint>
#include <vector>

#include "../../src/core/error.h"
#include "../../src/output/jpeg_check.h"
#include "../../src/output/picture.h"
#include "../../src/output/png.h"

using namespace phalanx;

namespace {

void append(void *context, void *data, int size) {
  static_cast<std::string *>(context)->append(static_cast<const char *>(data),
                                              static_cast<std::size_t>(size));
}

/// 20 x 10 pixels of one colour.
std::string small_jpeg() {
  const std::vector<unsigned char> pixels(600, 90);
  std::string bytes;
  REQUIRE(stbi_write_jpg_to_func(append, &bytes, 20, 10, 3, pixels.data(), 90) != 0);
  return bytes;
}

/// Where the segment of a marker begins: at its 0xff.
std::size_t segment(const std::string &bytes, char marker) {
  const std::size_t at = bytes.find(std::string("\xff") + marker);
  REQUIRE(at != std::string::npos);
  return at;
}

std::size_t segment_size(const std::string &bytes, std::size_t at) {
  return 2 + static_cast<unsigned char>(bytes[at + 2]) * 256u +
         static_cast<unsigned char>(bytes[at + 3]);
}

std::string refusal(const std::string &bytes) {
  try {
    decode_picture(bytes, "file.jpg", 1 << 20);
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("picture: a JPEG comes back, with filling before its markers, too") {
  const std::string bytes = small_jpeg();
  for (const std::string &file : {bytes, "\xff" + bytes, bytes + "what follows the end"}) {
    const Picture picture = decode_picture(file, "file.jpg", 1 << 20);
    CHECK(picture.width == 20);
    CHECK(picture.height == 10);
    REQUIRE(picture.pixels8.size() == 200);
    CHECK(picture.values16.empty());
    for (const std::uint32_t pixel : picture.pixels8) CHECK(pixel == 0xff5a5a5au);
  }
  CHECK(refusal(bytes) == "");
  CHECK_THROWS_AS(decode_picture(bytes, "file.jpg", 199), InputError);
}

TEST_CASE("picture: a JPEG that was cut is refused wherever the cut is") {
  const std::string bytes = small_jpeg();
  for (std::size_t size = 0; size < bytes.size(); size++)
    CHECK(refusal(bytes.substr(0, size)) != "");
  CHECK(refusal(bytes.substr(0, bytes.size() - 1)) ==
        "file.jpg: not a PNG or JPEG that can be read: the file ends too early");
}

TEST_CASE("picture: Huffman tables that cannot be, or that were not defined, are refused") {
  // stb_image 2.27 writes beyond its tables, and reads what it never wrote.
  const std::string good = small_jpeg();
  CHECK(check_jpeg(good) == "");
  const std::size_t table = segment(good, '\xc4');
  std::string bad = good;
  for (std::size_t i = 0; i < 16; i++) bad[table + 5 + i] = '\xff';  // 16 x 255 codes
  CHECK(check_jpeg(bad) == "a Huffman table is not possible");
  bad = good;
  bad[table + 5] = 3;  // of one bit
  CHECK(check_jpeg(bad) == "a Huffman table is not possible");
  bad = good;
  bad[table + 4] = 0x24;  // class 2, number 4
  CHECK(check_jpeg(bad) == "a Huffman table is not possible");
  bad = good;
  bad.erase(table, segment_size(good, table));
  CHECK(check_jpeg(bad) == "a scan has no Huffman table");
  CHECK(refusal(bad) ==
        "file.jpg: not a PNG or JPEG that can be read: a scan has no Huffman table");
  bad = good;
  bad[segment(good, '\xda') + 3] = 1;  // a segment of no length
  bad[segment(good, '\xda') + 2] = 0;
  CHECK(check_jpeg(bad) == "a segment has no length");
}

TEST_CASE("picture: what is no PNG does not reach the reader of PNG") {
  CHECK_THROWS_AS(decode_png(small_jpeg(), "file.png"), InputError);
}
