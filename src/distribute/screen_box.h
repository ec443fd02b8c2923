// Where the surfaces of a scene lie in the picture.
#pragma once
#include "../plan/plan.h"

namespace phalanx {

/// The rectangle of pixels around the projected corners of the scene's bounds. All of the picture where
/// a corner is not in front of the camera, and for cameras that are neither perspective nor orthographic.
Rect screen_box(const Scene &scene, const FrameView &frame);

}  // namespace phalanx
