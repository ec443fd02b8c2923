#include "name_table.h"

#include "nearest_name.h"

namespace phalanx {

void NameTable::add(const std::string &name, const Node &node, Source &source) {
  const std::int32_t index = num_++;
  if (index_of_.emplace(name, index).second) {
    place_of_[name] = node.path;
  } else {
    source.error(node, "duplicate " + kind_ + " name '" + printable(name) + "', given before at " +
                           place_of_[name]);
  }
}

void NameTable::add_nameless() {
  num_++;
  has_nameless_ = true;
}

std::int32_t NameTable::find(const std::string &name, const Node &node, Source &source) const {
  const auto found = index_of_.find(name);
  if (found != index_of_.end()) return found->second;
  if (!has_nameless_) {
    std::vector<std::string> names;
    for (const auto &[known, index] : index_of_) names.push_back(known);
    source.error(node,
                 "unknown " + kind_ + " '" + printable(name) + "'" + did_you_mean(name, names));
  }
  return 0;
}

}  // namespace phalanx
