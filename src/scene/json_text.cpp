#include "json_text.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "json_cursor.h"
#include "json_number.h"

namespace phalanx {

namespace {

/// One key or index on the way from the root to the value being read.
struct Step {
  const std::string *key;  // null: an index
  std::size_t index;
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

class JsonParser {
 public:
  JsonParser(std::string_view text, Source &source) : cursor_(text), source_(source) {}

  bool parse_document(JsonValue &root) {
    cursor_.skip_space();
    if (cursor_.at_end()) return fail("the file is empty; expected a scene: an object {...}");
    if (!parse_value(root)) return false;
    cursor_.skip_space();
    if (!cursor_.at_end()) return fail("expected the end of the file, found " + found());
    return true;
  }

 private:
  bool parse_value(JsonValue &value) {
    const TextPlace place = cursor_.place();
    value.line = place.line;
    value.column = place.column;
    const char c = cursor_.peek();
    if (c == '{') return parse_nested(value, &JsonParser::parse_object);
    if (c == '[') return parse_nested(value, &JsonParser::parse_array);
    if (c == '"') {
      value.kind = JsonKind::kString;
      value.contents = std::make_unique<JsonContents>();
      return parse_string(value.contents->string);
    }
    if (is_digit(c) || c == '-' || c == '+' || c == '.') return parse_number(value);
    if (is_letter(c)) return parse_literal(value);
    return fail("expected a value, found " + found());
  }

  bool parse_nested(JsonValue &value, bool (JsonParser::*parse)(JsonValue &)) {
    if (steps_.size() >= kMaxJsonDepth) {
      return fail("nested deeper than " + std::to_string(kMaxJsonDepth) + " levels");
    }
    value.contents = std::make_unique<JsonContents>();
    cursor_.skip(1);
    return (this->*parse)(value);
  }

  bool parse_array(JsonValue &value) {
    value.kind = JsonKind::kArray;
    std::vector<JsonValue> &items = value.contents->items;
    cursor_.skip_space();
    if (cursor_.skip_if(']')) return true;
    for (;;) {
      steps_.push_back({nullptr, items.size()});
      if (!parse_value(items.emplace_back())) return false;
      steps_.pop_back();
      cursor_.skip_space();
      if (cursor_.skip_if(']')) break;
      if (!cursor_.skip_if(',')) return fail_inside(value, "expected ',' or ']'");
      cursor_.skip_space();
      if (cursor_.peek() == ']') return fail("a comma before ']' is not allowed");
    }
    items.shrink_to_fit();
    return true;
  }

  bool parse_object(JsonValue &value) {
    value.kind = JsonKind::kObject;
    std::vector<JsonMember> &members = value.contents->members;
    cursor_.skip_space();
    if (cursor_.skip_if('}')) return true;
    for (;;) {
      if (cursor_.peek() != '"') return fail_inside(value, "expected a key in double quotes");
      JsonMember &member = members.emplace_back();
      const TextPlace place = cursor_.place();
      member.line = place.line;
      member.column = place.column;
      if (!parse_string(member.key)) return false;
      steps_.push_back({&member.key, 0});
      cursor_.skip_space();
      if (!cursor_.skip_if(':')) return fail("expected ':' after the key, found " + found());
      cursor_.skip_space();
      if (!parse_value(member.value)) return false;
      steps_.pop_back();
      cursor_.skip_space();
      if (cursor_.skip_if('}')) break;
      if (!cursor_.skip_if(',')) return fail_inside(value, "expected ',' or '}'");
      cursor_.skip_space();
      if (cursor_.peek() == '}') return fail("a comma before '}' is not allowed");
    }
    report_duplicates(members);
    return true;
  }

  void report_duplicates(const std::vector<JsonMember> &members) {
    std::vector<const JsonMember *> sorted;
    for (const JsonMember &member : members) sorted.push_back(&member);
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const JsonMember *a, const JsonMember *b) { return a->key < b->key; });
    for (std::size_t i = 1; i < sorted.size(); i++) {
      if (sorted[i]->key != sorted[i - 1]->key) continue;
      source_.error(sorted[i]->line, sorted[i]->column, member_path(path(), sorted[i]->key),
                    "duplicate key '" + printable(sorted[i]->key) + "', given before on line " +
                        std::to_string(sorted[i - 1]->line));
    }
  }

  bool parse_number(JsonValue &value) {
    value.kind = JsonKind::kNumber;
    TextCursor ahead = cursor_;
    value.spelling = ahead.take_word();
    const std::string problem = read_json_number(value.spelling, value.number);
    if (!problem.empty()) return fail(problem);
    cursor_ = ahead;
    return true;
  }

  bool parse_literal(JsonValue &value) {
    TextCursor ahead = cursor_;
    const std::string_view word = ahead.take_word();
    if (word == "null") {
      value.kind = JsonKind::kNull;
    } else if (word == "true" || word == "false") {
      value.kind = JsonKind::kBoolean;
      value.number = word == "true" ? 1 : 0;
    } else if (word == "NaN" || word == "nan" || word == "Infinity" || word == "inf") {
      return fail("not a JSON number: " + quoted(word) + "; every number must be finite");
    } else {
      return fail("expected a value, found the word " + quoted(word) +
                  "; strings need double quotes");
    }
    cursor_ = ahead;
    return true;
  }

  /// Reads a string, the cursor standing at its opening quote.
  bool parse_string(std::string &string) {
    const TextPlace start = cursor_.place();
    cursor_.skip(1);
    for (;;) {
      const std::size_t length = utf8_length(cursor_.rest());
      const auto byte = static_cast<unsigned char>(cursor_.peek());
      if (cursor_.at_end() || byte == '\n' || byte == '\r') {
        source_.error(start.line, start.column, path(), "this string does not end on its line");
        return false;
      }
      if (length == 0) return fail("not valid UTF-8: " + found());
      if (byte < 0x20) return fail("a control character in a string must be escaped: " + found());
      if (cursor_.skip_if('"')) return true;
      if (cursor_.peek() == '\\') {
        if (!parse_escape(string)) return false;
      } else {
        string += cursor_.rest().substr(0, length);
        cursor_.skip(length);
      }
    }
  }

  bool parse_escape(std::string &string) {
    static constexpr std::string_view kNames = "\"\\/bfnrt", kMeanings = "\"\\/\b\f\n\r\t";
    TextCursor ahead = cursor_;
    ahead.skip(1);
    const std::size_t name = ahead.at_end() ? std::string_view::npos : kNames.find(ahead.peek());
    if (name != std::string_view::npos) {
      string += kMeanings[name];
      cursor_.skip(2);
      return true;
    }
    unsigned code = 0;
    if (!take_hex_escape(code)) return fail("unknown escape in a string");
    if (code >= 0xd800 && code < 0xdc00) {
      unsigned low = 0;
      if (!take_hex_escape(low) || low < 0xdc00 || low > 0xdfff)
        return fail("half of a surrogate pair in a string");
      code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
    } else if (code >= 0xdc00 && code < 0xe000) {
      return fail("half of a surrogate pair in a string");
    }
    append_utf8(string, code);
    return true;
  }

  /// Skips `\uXXXX`; leaves the cursor where it is when there is none.
  bool take_hex_escape(unsigned &code) {
    const std::string_view rest = cursor_.rest();
    if (!rest.starts_with("\\u") || rest.size() < 6) return false;
    const auto result = std::from_chars(rest.data() + 2, rest.data() + 6, code, 16);
    if (result.ec != std::errc() || result.ptr != rest.data() + 6) return false;
    cursor_.skip(6);
    return true;
  }

  std::string path() const {
    std::string result;
    for (const Step &step : steps_)
      result = step.key ? member_path(result, *step.key) : item_path(result, step.index);
    return result;
  }

  static std::string quoted(std::string_view word) { return "'" + printable(word) + "'"; }
  std::string found() const {
    if (cursor_.starts_with("//") || cursor_.starts_with("/*")) {
      return "a comment, which JSON does not have; the top-level key 'description' holds remarks";
    }
    return cursor_.describe_next();
  }

  bool fail(const std::string &message) {
    const TextPlace place = cursor_.place();
    source_.error(place.line, place.column, path(), message);
    return false;
  }
  bool fail_inside(const JsonValue &parent, const std::string &expected) {
    std::string message = expected + ", found " + found();
    if (cursor_.at_end()) {
      message += std::string("; the ") + (parent.kind == JsonKind::kArray ? "array" : "object") +
                 " opened at " + std::to_string(parent.line) + ":" + std::to_string(parent.column) +
                 " is not closed";
    }
    return fail(message);
  }

  TextCursor cursor_;
  Source &source_;
  std::vector<Step> steps_;
};

}  // namespace

bool parse_json(std::string_view text, Source &source, JsonValue &root) {
  return JsonParser(text, source).parse_document(root);
}

}  // namespace phalanx
