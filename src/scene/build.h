// Description to scene: bakes transforms, drops what cannot be hit, collects lights.
#pragma once
#include "../core/error.h"
#include "description.h"
#include "scene.h"

namespace phalanx {

/// Builds the arrays that kernels read. Transforms are baked into shapes in double precision;
/// instances keep theirs. Shapes that emit inside an instanced group are baked to the top level,
/// once per instance, so that every light has a place in the world. Zero-area primitives are left
/// out and counted. Adds errors for what cannot be built (a sphere under a non-uniform transform,
/// a singular instance transform, coordinates that are not finite or beyond Embree's 1.8e18).
Scene build_scene(const SceneDescription &description, Diagnostics &diagnostics);

/// Camera of a picture of width x height pixels, as kernels read it.
Camera build_camera(const CameraDescription &description, Diagnostics &diagnostics);

}  // namespace phalanx
