// Reads the keys of one JSON object. A key is known once it was asked for, so what the reading code
// uses and what finish() accepts cannot differ.
//
//   ObjectReader sphere(node, source);
//   sphere.vector("center", kCoordinate, center);
//   sphere.number("radius", kLength, radius, kRequired);
//   sphere.finish("a sphere");
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "value_checks.h"

namespace phalanx {

enum Presence { kOptional, kRequired };

class ObjectReader {
 public:
  /// Reports a value that is not an object; all keys are absent then and nothing else is reported.
  ObjectReader(Node node, Source &source);

  bool is_object() const { return node_.value->kind == JsonKind::kObject; }
  /// No error was reported since this reader was made; after finish(): the object is good.
  bool ok() const { return source_.num_errors() == errors_before_; }
  const Node &node() const { return node_; }
  Source &source() { return source_; }

  /// The member called `key`, which becomes known.
  std::optional<Node> find(std::string_view key, Presence presence = kOptional);
  bool has(std::string_view key) { return find(key).has_value(); }

  // The member called `key` checked as in value_checks.h. False if it is absent or wrong; `out`
  // keeps its value then, so initialise it with the default.
  bool number(std::string_view key, const Range &range, double &out, Presence presence = kOptional);
  bool integer(std::string_view key, int lo, int hi, int &out, Presence presence = kOptional);
  bool boolean(std::string_view key, bool &out, Presence presence = kOptional);
  bool text(std::string_view key, std::string &out, Presence presence = kOptional);
  bool vector(std::string_view key, const Range &range, Double3 &out,
              Presence presence = kOptional);
  bool colour(std::string_view key, const Range &range, Double3 &out,
              Presence presence = kOptional);
  bool choice(std::string_view key, const std::vector<Choice> &choices, int &out,
              Presence presence = kOptional);
  /// `key` should hold an array but does not, or is absent and another key looks like it misspelt.
  bool is_unreadable(std::string_view key);
  /// The items of an array, none if it is absent or wrong.
  std::vector<Node> array(std::string_view key, const std::string &of_what,
                          Presence presence = kOptional);

  void error(std::string message) { source_.error(node_, std::move(message)); }
  /// Reports keys that nobody asked for, with the nearest known key. `what`: "a sphere".
  void finish(const std::string &what);
  /// Instead of finish() when it cannot be known which keys the object may have, because the key
  /// that decides is wrong or missing: reports only missing keys and how they were misspelt.
  void give_up(const std::string &what);

 private:
  bool knows(const std::string &key) const;
  /// The known key nearest to an unknown one, or "".
  std::string meant(const std::string &key) const;
  void report_unknown(const std::string &what, bool only_missing);
  void report_missing(const std::string &what);

  Node node_;
  Source &source_;
  int errors_before_;
  std::vector<std::string> known_;
  std::vector<std::string> missing_;
};

}  // namespace phalanx
