#include "load_scene.h"

#include "../core/error.h"
#include "../scene/build.h"
#include "../scene/scene_file.h"
#include "text.h"

namespace phalanx {

LoadedScene load_scene(const std::string &path, bool say_warnings) {
  Diagnostics diagnostics;
  LoadedScene loaded;
  loaded.description = load_scene_file(path, diagnostics);
  diagnostics.throw_if_errors();
  loaded.scene = build_scene(loaded.description, diagnostics);
  if (say_warnings) print_problems(diagnostics.warnings(), "warning: ");
  diagnostics.throw_if_errors();
  return loaded;
}

}  // namespace phalanx
