// A scene ready to be rendered again and again.
#pragma once
#include <memory>
#include <string>

#include "../render/render.h"
#include "load_scene.h"

namespace phalanx {

struct Subject : LoadedScene {
  /// Reads, checks and builds; warnings go to stderr. Throws InputError, also for a frame that cannot be.
  Subject(const std::string &path, const RenderOptions &options) : LoadedScene(load_scene(path)) {
    make_plan(description, scene, options);  // a bad frame is an error before the long part
    accel = std::make_unique<Accel>(scene, options.isa, 0);
  }

  Plan plan(const RenderOptions &options) const { return make_plan(description, scene, options); }
  RenderResult render(const RenderOptions &options, const ProgressCallback &progress = {}) const {
    return phalanx::render(scene, *accel, plan(options), options, progress);
  }

  std::unique_ptr<Accel> accel;
};

}  // namespace phalanx
