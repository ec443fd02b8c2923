// One sample again, vertex by vertex.
#pragma once
#include "../plan/options.h"
#include "../plan/plan.h"
#include "../reference/path_step.h"
#include "../scene/accel.h"
#include "../scene/scene.h"

namespace phalanx {

struct Replay {
  PathSteps steps;          // by depth-first
  Vec3 radiance;            // their sum: the sample
  bool rendered_is_valid;   // false: the schedule's sample was left out of its picture, as not finite or negative
  Vec3 rendered;            // the sample as the schedule has it, if it is valid
};

/// Follows sample `sample` (>= 0) of pixel (x, y) of the full picture by depth-first, and renders it alone by
/// `options.mode` with `options.isa`. Throws InputError for a pixel outside the picture or a sample that the
/// sampler does not have.
Replay replay_sample(const Scene &scene, const Accel &accel, const SceneDescription &description,
                     const RenderOptions &options, int x, int y, int sample);

}  // namespace phalanx
