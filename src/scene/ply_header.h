// The header of a PLY file: which elements follow, and how they are written.
// Format: G. Turk, "The PLY Polygon File Format", 1994.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace phalanx {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

/// Bytes of one value in a binary file: 1, 2, 4 or 8.
int ply_type_size(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::kFloat32;  // of the value, or of the items of a list
  bool is_list = false;
  PlyType count_type = PlyType::kUint8;  // lists: a whole-number type
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;  // rows, >= 0
  std::vector<PlyProperty> properties;

  /// The fewest bytes that a row takes: lists empty; in text two characters a property.
  std::int64_t min_row_bytes(PlyFormat format) const;
  /// Position among the properties, -1 if there is none of that name.
  int find(const std::string &property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;  // in the order of the file, names different
  std::size_t size = 0;              // bytes up to the first row
  int num_lines = 0;
};

/// Reads the header. Counts are compared with the size of the file: what cannot be there is refused
/// before anything is allocated for it. Returns an empty string, or what is wrong in `error_line`.
std::string parse_ply_header(const std::string &bytes, PlyHeader &header, int &error_line);

}  // namespace phalanx
