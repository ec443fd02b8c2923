#include "json_value.h"

#include <cstdio>

namespace phalanx {

std::string printable(std::string_view text) {
  constexpr std::size_t kMaxShown = 60;
  std::size_t end = text.size();
  if (end > kMaxShown) {
    end = kMaxShown;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
      end--;  // whole characters
  }
  std::string shown;
  for (const char c : text.substr(0, end)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04x", byte);
      shown += escape;
    } else {
      shown += c;
    }
  }
  return end < text.size() ? shown + "..." : shown;
}

std::string describe(const JsonValue &value) {
  switch (value.kind) {
    case JsonKind::kNull:
      return "null";
    case JsonKind::kBoolean:
      return value.number != 0 ? "true" : "false";
    case JsonKind::kNumber:
      return "the number " + printable(value.spelling);
    case JsonKind::kString:
      return "the string \"" + printable(value.string()) + "\"";
    case JsonKind::kArray:
      return value.items().empty() ? "an empty array"
                                   : "an array of " + std::to_string(value.items().size());
    case JsonKind::kObject:
      return value.members().empty() ? "an empty object" : "an object";
  }
  return "";
}

std::string member_path(const std::string &path, std::string_view key) {
  std::string result = path + '/';
  for (const char c : printable(key)) {
    if (c == '~') {
      result += "~0";
    } else if (c == '/') {
      result += "~1";
    } else {
      result += c;
    }
  }
  return result;
}

std::string item_path(const std::string &path, std::size_t index) {
  return path + '/' + std::to_string(index);
}

}  // namespace phalanx
