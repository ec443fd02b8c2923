// A JSON text as a tree in which every value knows where it stands in the file.
//
// Inline meshes make trees of millions of numbers, so a number costs 48 bytes and nothing else;
// strings, arrays and objects keep what they contain behind a pointer.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace phalanx {

enum class JsonKind : unsigned char { kNull, kBoolean, kNumber, kString, kArray, kObject };

struct JsonContents;

struct JsonValue {
  JsonKind kind = JsonKind::kNull;
  int line = 0, column = 0;                // of the first character, from 1; columns in characters
  double number = 0;                       // numbers, finite; booleans 0 or 1
  std::string_view spelling;               // numbers: as written; valid while the text lives
  std::unique_ptr<JsonContents> contents;  // strings, arrays, objects; else null

  const std::string &string() const;                      // kString only
  const std::vector<JsonValue> &items() const;            // kArray only
  const std::vector<struct JsonMember> &members() const;  // kObject only, in the order of the file
};

struct JsonMember {
  std::string key;
  int line = 0, column = 0;  // of the key
  JsonValue value;
};

struct JsonContents {
  std::string string;
  std::vector<JsonValue> items;
  std::vector<JsonMember> members;
};

inline const std::string &JsonValue::string() const { return contents->string; }
inline const std::vector<JsonValue> &JsonValue::items() const { return contents->items; }
inline const std::vector<JsonMember> &JsonValue::members() const { return contents->members; }

/// What a message says was found: "null", "the number 1.5", "the string \"red\"", "an array of 2".
/// Long strings and numbers are cut.
std::string describe(const JsonValue &value);

/// `text` fit for a message of one line: at most 60 bytes, control characters as \u001f.
std::string printable(std::string_view text);

/// RFC 6901 pointers of a member and of an item of the value at `path`. Keys are cut as by printable.
std::string member_path(const std::string &path, std::string_view key);
std::string item_path(const std::string &path, std::size_t index);

}  // namespace phalanx
