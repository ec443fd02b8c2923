// The numbers of a PLY file, one after another, from text or binary of either byte order.
#pragma once
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "number_text.h"
#include "ply_header.h"

namespace phalanx {

template <class T>
double decode(const char *at, bool swap_bytes) {
  char raw[sizeof(T)];
  for (std::size_t i = 0; i < sizeof(T); ++i) raw[i] = at[swap_bytes ? sizeof(T) - 1 - i : i];
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return static_cast<double>(value);
}

inline double decode(PlyType type, const char *at, bool swap_bytes) {
  switch (type) {
    case PlyType::kInt8:
      return decode<std::int8_t>(at, false);
    case PlyType::kUint8:
      return decode<std::uint8_t>(at, false);
    case PlyType::kInt16:
      return decode<std::int16_t>(at, swap_bytes);
    case PlyType::kUint16:
      return decode<std::uint16_t>(at, swap_bytes);
    case PlyType::kInt32:
      return decode<std::int32_t>(at, swap_bytes);
    case PlyType::kUint32:
      return decode<std::uint32_t>(at, swap_bytes);
    case PlyType::kFloat32:
      return decode<float>(at, swap_bytes);
    case PlyType::kFloat64:
      return decode<double>(at, swap_bytes);
  }
  return 0;
}

/// Hands out the numbers of the file one after another. Every number is a double: it holds all
/// PLY types exactly.
class PlyNumbers {
 public:
  PlyNumbers(const std::string &bytes, const PlyHeader &header)
      : at_(bytes.data() + header.size),
        end_(bytes.data() + bytes.size()),
        format_(header.format),
        line_(header.num_lines) {}

  /// The line of the number read last; 0 in binary files.
  int line() const { return format_ == PlyFormat::kAscii ? line_ : 0; }
  const std::string &problem() const { return problem_; }

  /// In text a row is a line: goes to the next one that is not empty.
  bool begin_row() {
    if (format_ != PlyFormat::kAscii) return true;
    ++line_;
    return skip_blanks();
  }
  /// In text: what is left of the line belongs to no property; such rows are counted.
  void end_row() {
    if (format_ != PlyFormat::kAscii) return;
    while (at_ < end_ && is_blank(*at_)) ++at_;
    if (at_ < end_ && !is_line_end(*at_) && num_long_rows_++ == 0) first_long_line_ = line_;
    while (at_ < end_ && !is_line_end(*at_)) ++at_;
    if (at_ < end_ && *at_ == '\r') ++at_;
    if (at_ < end_ && *at_ == '\n') ++at_;
  }
  std::int64_t num_long_rows() const { return num_long_rows_; }
  int first_long_line() const { return first_long_line_; }

  bool next(PlyType type, double &value) {
    if (format_ == PlyFormat::kAscii) return next_in_text(value);
    const int size = ply_type_size(type);
    if (end_ - at_ < size) return fail("the file ends here: truncated?");
    value = decode(type, at_, format_ == PlyFormat::kBigEndian);
    at_ += size;
    return true;
  }

  /// The length of a list, compared with what is left of the file.
  bool next_count(const PlyProperty &list, std::int64_t &count) {
    double value = 0;
    if (!next(list.count_type, value)) return false;
    const int item = format_ == PlyFormat::kAscii ? 1 : ply_type_size(list.type);
    if (!(value >= 0) || value != std::floor(value))
      return fail("a list has a length that is not a whole number");
    if (value > static_cast<double>((end_ - at_) / item))
      return fail("a list is longer than the file: truncated?");
    count = static_cast<std::int64_t>(value);
    return true;
  }

  /// Steps over `count` values of one type.
  bool skip(PlyType type, std::int64_t count) {
    if (format_ != PlyFormat::kAscii) return skip_bytes(ply_type_size(type), count);
    for (double ignored; count > 0; --count)
      if (!next_in_text(ignored)) return false;
    return true;
  }
  bool skip_bytes(std::int64_t size, std::int64_t count) {
    if (size > 0 && count > (end_ - at_) / size) return fail("the file ends here: truncated?");
    at_ += size * count;
    return true;
  }

  std::int64_t num_bytes_left() {
    if (format_ == PlyFormat::kAscii) skip_blanks();
    return end_ - at_;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t'; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

  bool fail(const char *problem) {
    problem_ = problem;
    return false;
  }

  /// Skips blanks, and line ends at the begin of a row.
  bool skip_blanks() {
    while (at_ < end_) {
      if (*at_ == '\n' || (*at_ == '\r' && !(at_ + 1 < end_ && at_[1] == '\n')))
        ++line_;
      else if (!is_blank(*at_) && *at_ != '\r')
        break;
      ++at_;
    }
    return at_ < end_ ? true : fail("the file ends here: truncated?");
  }

  bool next_in_text(double &value) {
    while (at_ < end_ && is_blank(*at_)) ++at_;
    const char *const first = at_;
    while (at_ < end_ && !is_blank(*at_) && !is_line_end(*at_)) ++at_;
    if (first == at_)
      return fail(at_ == end_ ? "the file ends here: truncated?"
                              : "fewer numbers than the header declares");
    switch (parse_number({first, static_cast<std::size_t>(at_ - first)}, value)) {
      case NumberText::kGood:
        return true;
      case NumberText::kNotANumber:
        return fail("this is not a number");
      case NumberText::kNotFinite:
        break;
    }
    value = std::numeric_limits<double>::quiet_NaN();  // harmless in a property that nobody reads
    return true;
  }

  const char *at_, *end_;
  PlyFormat format_;
  int line_;
  std::int64_t num_long_rows_ = 0;
  int first_long_line_ = 0;
  std::string problem_;
};

}  // namespace phalanx
