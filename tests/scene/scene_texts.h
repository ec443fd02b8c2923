// What the tests of the scene reader share: finding files, reading texts, listing problems.
#pragma once
#include <fstream>
#include <iterator>
#include <string>

#include "../../src/scene/scene_file.h"

namespace phalanx::test {

inline std::string source_path(const std::string &path) {
  return std::string(PHALANX_SOURCE_DIR) + "/" + path;
}

inline std::string read_text(const std::string &path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// All errors, a line each.
inline std::string errors_of(const Diagnostics &diagnostics) {
  std::string text;
  for (const Problem &problem : diagnostics.errors()) text += problem.text() + "\n";
  return text;
}

/// The errors that a scene text gets; files it refers to are those of tests/scene/valid/.
inline std::string errors_in_scene(const std::string &text) {
  Diagnostics diagnostics;
  parse_scene_text(text, "scene.json", source_path("tests/scene/valid"), diagnostics);
  return errors_of(diagnostics);
}

}  // namespace phalanx::test
