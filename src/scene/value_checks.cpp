#include "value_checks.h"

#include <cmath>
#include <cstdio>

#include "nearest_name.h"

namespace phalanx {

namespace {

std::string number_text(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", x);
  return text;
}

bool is_number_in(const JsonValue &value, const Range &range) {
  return value.kind == JsonKind::kNumber && range.contains(value.number);
}

}  // namespace

std::string Range::text() const {
  std::string text = "in [" + number_text(lo) + ", " + number_text(hi) + (open_hi ? ")" : "]");
  if (*unit) text += std::string(" ") + unit;
  return text;
}

bool check_number(const Node &node, const Range &range, Source &source, double &out) {
  if (!is_number_in(*node.value, range)) {
    source.expected(node, "a number " + range.text());
    return false;
  }
  out = node.value->number;
  return true;
}

bool check_integer(const Node &node, int lo, int hi, Source &source, int &out) {
  const Range range = {static_cast<double>(lo), static_cast<double>(hi)};
  if (!is_number_in(*node.value, range) || node.value->number != std::floor(node.value->number)) {
    source.expected(node, "a whole number " + range.text());
    return false;
  }
  out = static_cast<int>(node.value->number);
  return true;
}

bool check_boolean(const Node &node, Source &source, bool &out) {
  if (node.value->kind != JsonKind::kBoolean) {
    source.expected(node, "true or false");
    return false;
  }
  out = node.value->number != 0;
  return true;
}

bool check_text(const Node &node, Source &source, std::string &out) {
  if (node.value->kind != JsonKind::kString || node.value->string().empty()) {
    source.expected(node, "a string that is not empty");
    return false;
  }
  if (node.value->string().find('\0') != std::string::npos) {
    source.expected(node, "a string without the character \\u0000");
    return false;
  }
  out = node.value->string();
  return true;
}

bool check_vector(const Node &node, const Range &range, Source &source, Double3 &out) {
  if (node.value->kind != JsonKind::kArray || node.value->items().size() != 3) {
    source.expected(node, "three numbers [x, y, z] " + range.text());
    return false;
  }
  Double3 vector = {};
  bool good = true;
  for (std::size_t i = 0; i < 3; i++) good &= check_number(node.item(i), range, source, vector[i]);
  if (good) out = vector;
  return good;
}

bool check_colour(const Node &node, const Range &range, Source &source, Double3 &out) {
  if (is_number_in(*node.value, range)) {
    out.fill(node.value->number);
    return true;
  }
  const JsonValue &value = *node.value;
  if (value.kind == JsonKind::kArray && value.items().size() == 3)
    return check_vector(node, range, source, out);
  source.expected(node, "a grey value or [r, g, b] " + range.text());
  return false;
}

bool check_choice(const Node &node, const std::vector<Choice> &choices, Source &source, int &out) {
  const bool is_string = node.value->kind == JsonKind::kString;
  std::vector<std::string> names;
  std::string list;
  for (const Choice &choice : choices) {
    if (is_string && node.value->string() == choice.name) {
      out = choice.value;
      return true;
    }
    names.push_back(choice.name);
    list += (list.empty() ? "\"" : ", \"") + names.back() + "\"";
  }
  const std::string hint = is_string ? did_you_mean(node.value->string(), names) : "";
  source.error(node, (names.size() > 1 ? "expected one of " : "expected ") + list + ", found " +
                         describe(*node.value) + hint);
  return false;
}

bool check_array(const Node &node, const std::string &of_what, Source &source) {
  if (node.value->kind == JsonKind::kArray) return true;
  source.expected(node, "an array of " + of_what);
  return false;
}

}  // namespace phalanx
