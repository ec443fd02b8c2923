// Scenes for tests: built from JSON text, rendered in one call.
#pragma once
#include <string>

#include "plan/plan.h"
#include "render/render.h"
#include "scene/build.h"
#include "scene/scene_file.h"

namespace phalanx::test {

/// A scene with its acceleration structures for one instruction set.
struct BuiltScene {
  SceneDescription description;
  Scene scene;
  std::unique_ptr<Accel> accel;
  std::string isa;
};

/// From JSON text. Fails the test on errors.
BuiltScene build_text(const std::string &json, const std::string &isa);
/// From a file below the repository's root.
BuiltScene build_file(const std::string &path, const std::string &isa);

RenderResult render_scene(const BuiltScene &built, RenderOptions options);

/// How many pixels differ in any bit of any channel.
std::int64_t pixels_that_differ(const Film &a, const Film &b);

/// Instruction sets that run here.
std::vector<std::string> isas_here();

}  // namespace phalanx::test
