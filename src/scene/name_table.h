// Names that a scene file gives to materials and groups, and looking them up.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "source.h"

namespace phalanx {

class NameTable {
 public:
  /// `kind` for messages: "material".
  explicit NameTable(std::string kind) : kind_(std::move(kind)) {}

  /// The next index gets `name`, found at `node`; a name given before is an error there.
  void add(const std::string &name, const Node &node, Source &source);
  /// The next index has no readable name, which was reported: unknown names are not errors any more,
  /// since they may be this one.
  void add_nameless();
  /// The index of the name in `node`, a string that is not empty; 0 after reporting an unknown one.
  std::int32_t find(const std::string &name, const Node &node, Source &source) const;

 private:
  std::string kind_;
  std::map<std::string, std::int32_t> index_of_;
  std::map<std::string, std::string> place_of_;  // JSON pointers
  std::int32_t num_ = 0;
  bool has_nameless_ = false;
};

}  // namespace phalanx
