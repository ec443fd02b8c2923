#include "jpeg_check.h"

#include <cstddef>
#include <string_view>

namespace phalanx {
namespace {

using std::size_t;

constexpr unsigned kFrameProgressive = 0xc2, kHuffman = 0xc4, kFirstRestart = 0xd0,
                   kLastRestart = 0xd7, kStart = 0xd8, kEnd = 0xd9, kScan = 0xda;

unsigned byte_at(std::string_view bytes, size_t i) { return static_cast<unsigned char>(bytes[i]); }

/// Which Huffman tables the file has defined so far.
struct JpegTables {
  bool defined[2][4] = {};  // DC and AC, by number
  bool is_progressive = false;

  /// Tables of one segment DHT: a class and number, how many codes each length has, the symbols.
  bool define(std::string_view segment) {
    while (!segment.empty()) {
      if (segment.size() < 17) return false;
      const unsigned kind = byte_at(segment, 0) >> 4, number = byte_at(segment, 0) & 15;
      if (kind > 1 || number > 3) return false;
      size_t num_symbols = 0;
      int num_free = 1;  // codes of the current length that are not taken
      for (size_t length = 1; length <= 16; length++) {
        const unsigned count = byte_at(segment, length);
        num_symbols += count;
        num_free = 2 * num_free - static_cast<int>(count);
        if (num_free < 0) return false;
      }
      if (num_symbols > 256 || segment.size() < 17 + num_symbols) return false;
      defined[kind][number] = true;
      segment.remove_prefix(17 + num_symbols);
    }
    return true;
  }

  /// The header of a scan, SOS: its components and their tables; in progressive files the range of
  /// coefficients says which of the two tables is used.
  bool allow_scan(std::string_view segment) const {
    if (segment.empty()) return false;
    const size_t num_components = byte_at(segment, 0);
    if (segment.size() != 4 + 2 * num_components) return false;
    const bool starts_at_dc = byte_at(segment, 1 + 2 * num_components) == 0;
    for (size_t i = 0; i < num_components; i++) {
      const unsigned tables = byte_at(segment, 2 + 2 * i);
      const unsigned dc = tables >> 4, ac = tables & 15;
      if (dc > 3 || ac > 3) return false;
      const bool uses_dc = !is_progressive || starts_at_dc;
      const bool uses_ac = !is_progressive || !starts_at_dc;
      if ((uses_dc && !defined[0][dc]) || (uses_ac && !defined[1][ac])) return false;
    }
    return true;
  }
};

}  // namespace

std::string check_jpeg(const std::string &bytes) {
  const std::string cut = "the file ends too early";
  JpegTables tables;
  size_t at = 0;
  while (at + 1 < bytes.size()) {
    const unsigned marker = byte_at(bytes, at + 1);
    if (byte_at(bytes, at) != 0xff || marker == 0xff) {
      at++;  // coded data, or a byte of filling
      continue;
    }
    if (marker == kEnd) return {};
    if (marker <= 1 || marker == kStart || (marker >= kFirstRestart && marker <= kLastRestart)) {
      at += 2;  // no segment: stuffing, start, restarts
      continue;
    }
    if (at + 3 >= bytes.size()) return cut;
    const size_t length = byte_at(bytes, at + 2) * 256 + byte_at(bytes, at + 3);
    if (length < 2) return "a segment has no length";
    if (at + 2 + length > bytes.size()) return cut;
    const std::string_view segment = std::string_view(bytes).substr(at + 4, length - 2);
    if (marker == kFrameProgressive) tables.is_progressive = true;
    if (marker == kHuffman && !tables.define(segment)) return "a Huffman table is not possible";
    if (marker == kScan && !tables.allow_scan(segment)) return "a scan has no Huffman table";
    at += 2 + length;
  }
  return cut;
}

}  // namespace phalanx
