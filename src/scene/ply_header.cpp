#include "ply_header.h"

#include <array>
#include <charconv>
#include <string_view>
#include <utility>

namespace phalanx {
namespace {

using std::size_t;

constexpr size_t kMaxLine = 4096;         // characters in a line of the header
constexpr size_t kMaxDeclarations = 256;  // elements, and properties of an element

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypeNames = {{
    {"char", PlyType::kInt8},
    {"int8", PlyType::kInt8},
    {"uchar", PlyType::kUint8},
    {"uint8", PlyType::kUint8},
    {"short", PlyType::kInt16},
    {"int16", PlyType::kInt16},
    {"ushort", PlyType::kUint16},
    {"uint16", PlyType::kUint16},
    {"int", PlyType::kInt32},
    {"int32", PlyType::kInt32},
    {"uint", PlyType::kUint32},
    {"uint32", PlyType::kUint32},
    {"float", PlyType::kFloat32},
    {"float32", PlyType::kFloat32},
    {"double", PlyType::kFloat64},
    {"float64", PlyType::kFloat64},
}};

bool find_type(std::string_view name, PlyType &type) {
  for (const auto &[known, value] : kTypeNames)
    if (known == name) {
      type = value;
      return true;
    }
  return false;
}

std::string printable(std::string_view text) {
  std::string out = "'";
  for (char c : text.substr(0, 60)) out += c >= 32 && c < 127 ? c : '?';
  return out + "'";
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> words;
  for (size_t at = 0; at < line.size();) {
    at = line.find_first_not_of(" \t", at);
    if (at == line.npos) break;
    const size_t end = std::min(line.find_first_of(" \t", at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

std::string parse_format(const std::vector<std::string_view> &words, PlyHeader &header) {
  if (words.size() != 3 || words[2] != "1.0") return "expected a format with version 1.0";
  if (words[1] == "ascii")
    header.format = PlyFormat::kAscii;
  else if (words[1] == "binary_little_endian")
    header.format = PlyFormat::kLittleEndian;
  else if (words[1] == "binary_big_endian")
    header.format = PlyFormat::kBigEndian;
  else
    return "unknown format " + printable(words[1]) +
           ": expected ascii, binary_little_endian or binary_big_endian";
  return {};
}

std::string parse_element(const std::vector<std::string_view> &words, PlyHeader &header) {
  PlyElement element;
  if (words.size() != 3) return "expected 'element NAME COUNT'";
  const std::string_view count = words[2];
  const auto result = std::from_chars(count.data(), count.data() + count.size(), element.count);
  if (result.ec != std::errc() || result.ptr != count.data() + count.size() || element.count < 0)
    return printable(count) + " is not a number of elements";
  element.name = words[1];
  for (const PlyElement &other : header.elements)
    if (other.name == element.name) return "element " + printable(element.name) + " comes twice";
  if (header.elements.size() == kMaxDeclarations) return "more than 256 elements";
  header.elements.push_back(std::move(element));
  return {};
}

std::string parse_property(const std::vector<std::string_view> &words, PlyHeader &header) {
  if (header.elements.empty()) return "a property before the first element";
  PlyProperty property;
  property.is_list = words.size() > 1 && words[1] == "list";
  if (words.size() != (property.is_list ? 5u : 3u))
    return "expected 'property TYPE NAME' or 'property list TYPE TYPE NAME'";
  const size_t type_at = property.is_list ? 3 : 1;
  if (!find_type(words[type_at], property.type)) return "unknown type " + printable(words[type_at]);
  if (property.is_list) {
    if (!find_type(words[2], property.count_type)) return "unknown type " + printable(words[2]);
    if (property.count_type == PlyType::kFloat32 || property.count_type == PlyType::kFloat64)
      return "the length of a list must have a whole-number type";
  }
  property.name = words.back();
  PlyElement &element = header.elements.back();
  if (element.find(property.name) >= 0)
    return "property " + printable(property.name) + " comes twice";
  if (element.properties.size() == kMaxDeclarations) return "more than 256 properties";
  element.properties.push_back(std::move(property));
  return {};
}

/// One line of the header; `ends` is set by end_header.
std::string parse_line(std::string_view line, PlyHeader &header, bool &has_format, bool &ends) {
  const std::vector<std::string_view> words = split(line);
  if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return {};
  if (words[0] == "format") {
    has_format = true;
    return parse_format(words, header);
  }
  if (words[0] == "element") return parse_element(words, header);
  if (words[0] == "property") return parse_property(words, header);
  if (words[0] == "end_header") {
    ends = true;
    return has_format ? std::string() : "the header has no format";
  }
  return "unknown header line " + printable(line);
}

std::string check_counts(const PlyHeader &header, size_t file_size) {
  auto left = static_cast<std::int64_t>(file_size - header.size);
  if (header.format == PlyFormat::kAscii) ++left;  // the last line may lack its end
  for (const PlyElement &element : header.elements) {
    const std::int64_t row = element.min_row_bytes(header.format);
    if (row > 0 && element.count > left / row)
      return "the header promises " + std::to_string(element.count) + " x " +
             printable(element.name) + ", but the file has only " + std::to_string(file_size) +
             " bytes: truncated?";
    left -= row * element.count;
  }
  return {};
}

}  // namespace

int ply_type_size(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat32:
      return 4;
    case PlyType::kFloat64:
      return 8;
  }
  return 8;
}

std::int64_t PlyElement::min_row_bytes(PlyFormat format) const {
  std::int64_t bytes = 0;
  for (const PlyProperty &property : properties)
    bytes += format == PlyFormat::kAscii
                 ? 2
                 : ply_type_size(property.is_list ? property.count_type : property.type);
  return bytes;
}

int PlyElement::find(const std::string &property) const {
  for (size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return static_cast<int>(i);
  return -1;
}

std::string parse_ply_header(const std::string &bytes, PlyHeader &header, int &error_line) {
  const std::string_view text = bytes;
  error_line = 1;
  const size_t first_end = text.substr(0, 16).find_first_of("\r\n");
  if (first_end == text.npos || text.substr(0, first_end) != "ply")
    return "not a PLY file: the first line must be 'ply'";
  // Line ends as in the first line: after the header every byte counts.
  const bool is_crlf = text.substr(first_end, 2) == "\r\n";
  const std::string_view line_end = is_crlf ? "\r\n" : text.substr(first_end, 1);
  size_t at = first_end + line_end.size();
  bool has_format = false, ends = false;
  for (header.num_lines = 1; !ends;) {
    error_line = ++header.num_lines;
    const size_t end = text.substr(at, kMaxLine).find(line_end);
    if (end == text.npos) return "the header does not end: no 'end_header' line";
    const std::string problem = parse_line(text.substr(at, end), header, has_format, ends);
    if (!problem.empty()) return problem;
    at += end + line_end.size();
  }
  header.size = at;
  return check_counts(header, bytes.size());
}

}  // namespace phalanx
