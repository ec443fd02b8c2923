// Checks JSON against a JSON Schema: the part of draft 2020-12 that docs/scene.schema.json uses.
//
// It knows no more than that, so that the published schema can be held against the scene reader:
// an unknown keyword throws. Patterns are taken as notes.
#pragma once
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace phalanx::test {

using Json = nlohmann::json;

class JsonSchema {
 public:
  explicit JsonSchema(Json root) : root_(std::move(root)) {}

  const Json &root() const { return root_; }
  bool accepts(const Json &value) const { return matches(root_, value); }

  /// The schema that `schema` refers to, if it does.
  const Json &resolve(const Json &schema) const {
    if (!schema.contains("$ref")) return schema;
    return resolve(root_.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1))));
  }

 private:
  bool matches(const Json &schema, const Json &value) const {
    for (const auto &[keyword, rule] : schema.items()) {
      if (!obeys(keyword, rule, schema, value)) return false;
    }
    return true;
  }

  std::ptrdiff_t count(const Json &schemas, const Json &value) const {
    return std::count_if(schemas.begin(), schemas.end(),
                         [&](const Json &s) { return matches(s, value); });
  }

  bool obeys(const std::string &keyword, const Json &rule, const Json &schema,
             const Json &value) const {
    static const std::vector<std::string> kNotes = {"$schema", "$defs",    "title",  "description",
                                                    "default", "examples", "pattern"};
    if (std::find(kNotes.begin(), kNotes.end(), keyword) != kNotes.end()) return true;
    if (keyword == "$ref") return matches(resolve(schema), value);
    if (keyword == "oneOf") return count(rule, value) == 1;
    if (keyword == "anyOf") return count(rule, value) > 0;
    if (keyword == "not") return !matches(rule, value);
    if (keyword == "const") return value == rule;
    if (keyword == "enum") return std::find(rule.begin(), rule.end(), value) != rule.end();
    if (keyword == "type") return has_type(rule, value);
    if (keyword == "minimum")
      return !value.is_number() || value.get<double>() >= rule.get<double>();
    if (keyword == "maximum")
      return !value.is_number() || value.get<double>() <= rule.get<double>();
    if (keyword == "exclusiveMaximum")
      return !value.is_number() || value.get<double>() < rule.get<double>();
    if (keyword == "minLength")
      return !value.is_string() || value.get<std::string>().size() >= rule;
    if (keyword == "minItems") return !value.is_array() || value.size() >= rule;
    if (keyword == "maxItems") return !value.is_array() || value.size() <= rule;
    if (keyword == "items") return items_match(rule, value);
    if (keyword == "prefixItems") return prefix_matches(rule, value);
    if (keyword == "required") return contains_all(rule, value);
    if (keyword == "dependentRequired") {
      return !value.is_object() ||
             std::all_of(rule.items().begin(), rule.items().end(), [&](const auto &entry) {
               return !value.contains(entry.key()) || contains_all(entry.value(), value);
             });
    }
    if (keyword == "properties") return properties_match(rule, value);
    if (keyword == "additionalProperties") {  // always false
      return !value.is_object() ||
             std::all_of(value.items().begin(), value.items().end(), [&](const auto &member) {
               return schema.at("properties").contains(member.key());
             });
    }
    throw std::logic_error("JsonSchema does not know the keyword " + keyword);
  }

  static bool has_type(const std::string &type, const Json &value) {
    if (type == "integer") {
      return value.is_number() && value.get<double>() == std::floor(value.get<double>());
    }
    return (type == "number" && value.is_number()) || (type == "string" && value.is_string()) ||
           (type == "boolean" && value.is_boolean()) || (type == "array" && value.is_array()) ||
           (type == "object" && value.is_object());
  }

  bool items_match(const Json &rule, const Json &value) const {
    return !value.is_array() || std::all_of(value.begin(), value.end(),
                                            [&](const Json &item) { return matches(rule, item); });
  }

  bool prefix_matches(const Json &rules, const Json &value) const {
    if (!value.is_array()) return true;
    for (std::size_t i = 0; i < std::min(rules.size(), value.size()); i++) {
      if (!matches(rules[i], value[i])) return false;
    }
    return true;
  }

  static bool contains_all(const Json &keys, const Json &value) {
    return !value.is_object() || std::all_of(keys.begin(), keys.end(), [&](const Json &key) {
      return value.contains(key.get<std::string>());
    });
  }

  bool properties_match(const Json &rules, const Json &value) const {
    if (!value.is_object()) return true;
    for (const auto &[key, rule] : rules.items()) {
      if (value.contains(key) && !matches(rule, value[key])) return false;
    }
    return true;
  }

  Json root_;
};

}  // namespace phalanx::test
