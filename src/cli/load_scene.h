// From a file's name to a scene, for the commands that render.
#pragma once
#include <string>

#include "../scene/loaded_scene.h"

namespace phalanx {

/// Reads, checks and builds; warnings go to stderr if `say_warnings`. Throws InputError with all problems.
LoadedScene load_scene(const std::string &path, bool say_warnings = true);

}  // namespace phalanx
