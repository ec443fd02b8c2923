// The JSON reader: positions, strictness, and agreement with nlohmann::json on what is JSON.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "../../src/scene/json_text.h"
#include "scene_texts.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

bool is_json(const std::string &text, std::string *errors = nullptr) {
  Diagnostics diagnostics;
  Source source("text", diagnostics);
  JsonValue root;
  const bool parsed = parse_json(text, source, root);
  CHECK(parsed == (errors_of(diagnostics).empty() ||
                   errors_of(diagnostics).find("duplicate") != std::string::npos));
  if (errors) *errors = errors_of(diagnostics);
  return parsed;
}

/// Whether two trees hold the same values in the same order.
bool same_tree(const JsonValue &ours, const nlohmann::ordered_json &theirs) {
  switch (ours.kind) {
    case JsonKind::kNull:
      return theirs.is_null();
    case JsonKind::kBoolean:
      return theirs.is_boolean() && theirs.get<bool>() == (ours.number != 0);
    case JsonKind::kNumber:
      return theirs.is_number() && theirs.get<double>() == ours.number;
    case JsonKind::kString:
      return theirs.is_string() && theirs.get<std::string>() == ours.string();
    case JsonKind::kArray: {
      if (!theirs.is_array() || theirs.size() != ours.items().size()) return false;
      for (std::size_t i = 0; i < theirs.size(); i++) {
        if (!same_tree(ours.items()[i], theirs[i])) return false;
      }
      return true;
    }
    case JsonKind::kObject: {
      if (!theirs.is_object() || theirs.size() != ours.members().size()) return false;
      std::size_t i = 0;
      for (const auto &[key, value] : theirs.items()) {
        if (ours.members()[i].key != key || !same_tree(ours.members()[i].value, value))
          return false;
        i++;
      }
      return true;
    }
  }
  return false;
}

/// A small generator of bytes that look like JSON.
struct Noise {
  unsigned state = 12345;
  unsigned next(unsigned below) {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % below;
  }
};

}  // namespace

TEST_CASE("json: every value knows its line and column") {
  const std::string text =
      "\xef\xbb\xbf{ \"a\": [1,\n\t-2.5e1 ,\r\n  \"\xc3\xa4\", true],\n\"b\" : {}}";
  Diagnostics diagnostics;
  Source source("text", diagnostics);
  JsonValue root;
  REQUIRE(parse_json(text, source, root));
  const auto is_at = [](const JsonValue &value, int line, int column) {
    return value.line == line && value.column == column;
  };
  CHECK(is_at(root, 1, 1));
  CHECK(root.members()[0].column == 3);
  const JsonValue &array = root.members()[0].value;
  CHECK(is_at(array, 1, 8));
  CHECK(is_at(array.items()[0], 1, 9));
  CHECK(is_at(array.items()[1], 2, 2));
  CHECK(array.items()[1].number == -25);
  CHECK(array.items()[1].spelling == "-2.5e1");
  CHECK(is_at(array.items()[2], 3, 3));
  CHECK(is_at(array.items()[3], 3, 8));
  CHECK(root.members()[1].line == 4);
  CHECK(is_at(root.members()[1].value, 4, 7));
}

TEST_CASE("json: escapes become UTF-8") {
  Diagnostics diagnostics;
  Source source("text", diagnostics);
  JsonValue root;
  REQUIRE(parse_json(R"("\"\\\/\b\f\n\r\t\u0041\u00e4\u20AC\ud83d\ude00")", source, root));
  CHECK(root.string() == "\"\\/\b\f\n\r\tA\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80");
}

TEST_CASE("json: nesting up to 64 is read, deeper is refused without recursion") {
  const auto nested = [](int depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  CHECK(is_json(nested(64)));
  std::string errors;
  CHECK(!is_json(nested(65), &errors));
  CHECK(errors.find("nested deeper than 64 levels") != std::string::npos);
  CHECK(!is_json(std::string(1'000'000, '[')));
  std::string objects;
  for (int i = 0; i < 100'000; i++) objects += "{\"a\":";
  CHECK(!is_json(objects));
}

TEST_CASE("json: numbers too large are errors, too small become zero") {
  const auto number = [](const std::string &text) {
    Diagnostics diagnostics;
    Source source("text", diagnostics);
    JsonValue root;
    return parse_json(text, source, root) ? root.number : -1;
  };
  CHECK(number("1.7976931348623157e308") == 1.7976931348623157e308);
  CHECK(number("1.8e308") == -1);
  CHECK(number("1e999999999999999999999") == -1);
  CHECK(number(std::string(400, '9')) == -1);
  CHECK(number("1e-999999999999999999999") == 0);
  CHECK(number("0." + std::string(400, '0') + "1") == 0);
  CHECK(number("0." + std::string(400, '0') + "1e401") == 1);
  CHECK(number("0e999999") == 0);
}

TEST_CASE("json: what is JSON is what nlohmann::json says, for a scene cut anywhere") {
  const std::string text = read_text(source_path("tests/scene/valid/everything.json"));
  REQUIRE(!text.empty());
  Diagnostics diagnostics;
  Source source("text", diagnostics);
  JsonValue root;
  REQUIRE(parse_json(text, source, root));
  CHECK(same_tree(root, nlohmann::ordered_json::parse(text)));

  for (std::size_t length = 0; length < text.size(); length++) {
    CAPTURE(length);
    CHECK(is_json(text.substr(0, length)) == nlohmann::json::accept(text.substr(0, length)));
  }
}

TEST_CASE("json: what is JSON is what nlohmann::json says, after any few edits") {
  const std::string text =
      R"({"a": [1, -2.5e3, 0.5E-2, "x\u00e4\n\ud83d\ude00"], "b": {"c": null, "d": [true, false, {}]}, "ä€😀": ""})";
  REQUIRE(nlohmann::json::accept(text));
  const std::string bytes = "{}[]:,\"\\0123456789.eE+-tfnu/ \n\x01\x7f\x80\xa4\xc3\xed\xf0\xff";
  Noise noise;
  int num_good = 0;
  for (int i = 0; i < 20'000; i++) {
    std::string changed = text;
    for (unsigned edits = 1 + noise.next(2); edits > 0; edits--) {
      const std::size_t at = noise.next(static_cast<unsigned>(changed.size()));
      const char byte = bytes[noise.next(static_cast<unsigned>(bytes.size()))];
      const unsigned what = noise.next(3);
      if (what == 0) changed[at] = byte;
      if (what == 1) changed.insert(at, 1, byte);
      if (what == 2) changed.erase(at, 1);
    }
    const bool theirs = nlohmann::json::accept(changed);
    num_good += theirs;
    if (is_json(changed) != theirs) FAIL_CHECK(changed);
  }
  CHECK(num_good > 1000);
}

TEST_CASE("json: short texts are JSON exactly if nlohmann::json says so") {
  static const std::string kBytes = "{}[]:,\"\\01.e-tnu a";
  Noise noise;
  for (int i = 0; i < 200'000; i++) {
    std::string text;
    for (unsigned length = noise.next(8); length > 0; length--)
      text += kBytes[noise.next(static_cast<unsigned>(kBytes.size()))];
    const bool ours = is_json(text), theirs = nlohmann::json::accept(text);
    if (ours != theirs) FAIL_CHECK(text);
  }
}
