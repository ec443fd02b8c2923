// A scene ready to be rendered again and again.
#pragma once
#include <memory>
#include <string>

#include "../core/error.h"
#include "../render/render.h"
#include "../scene/build.h"
#include "../scene/scene_file.h"
#include "text.h"

namespace phalanx {

struct Subject {
  /// Reads, checks and builds; warnings go to stderr. Throws InputError, also for a frame that cannot be.
  Subject(const std::string &path, const RenderOptions &options) {
    Diagnostics diagnostics;
    description = load_scene_file(path, diagnostics);
    diagnostics.throw_if_errors();
    scene = build_scene(description, diagnostics);
    print_problems(diagnostics.warnings(), "warning: ");
    diagnostics.throw_if_errors();
    make_plan(description, scene, options);  // a bad frame is an error before the long part
    accel = std::make_unique<Accel>(scene, options.isa, 0);
  }

  Plan plan(const RenderOptions &options) const { return make_plan(description, scene, options); }
  RenderResult render(const RenderOptions &options, const ProgressCallback &progress = {}) const {
    return phalanx::render(scene, *accel, plan(options), options, progress);
  }

  SceneDescription description;
  Scene scene;
  std::unique_ptr<Accel> accel;
};

}  // namespace phalanx
