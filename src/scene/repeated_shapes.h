// Shapes that are there twice: rays cannot tell two surfaces in one place apart, and which of them a query returns
// depends on the order in which it looks.
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "scene.h"

namespace phalanx {

/// Knows the shapes of a space (the top level, or one group) by their points.
class RepeatedShapes {
 public:
  /// A new space: what other spaces hold does not matter.
  void start_space() { seen_.clear(); }

  /// The origin of an earlier shape that has the same primitives as geometry record `g`, in whatever order, if there
  /// is one; else remembers it as `origin`. Curves, and what lets rays pass, are nobody's repetition.
  std::optional<std::string> find(const Scene &scene, std::size_t g, const std::string &origin);

 private:
  using Key = std::pair<std::uint64_t, std::uint64_t>;
  std::map<Key, std::string> seen_;
};

}  // namespace phalanx
