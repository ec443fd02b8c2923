// Ray queries one at a time, for the scalar schedules. Implemented beside Accel.
#pragma once
#include "../../kernels/physics/surface.h"

namespace phalanx {

// A ray that is not finite, or has no direction, meets nothing.

/// time: path_time(). Closest hit in (PHALANX_NEAR, PHALANX_FAR); hit.geometry is -1 where there is none.
Hit trace_closest(const SceneView &scene, Vec3 origin, Vec3 direction, float time = 0);
/// True where something lies between origin and origin + distance * direction.
bool trace_occluded(const SceneView &scene, Vec3 origin, Vec3 direction, float distance,
                    float time = 0);

}  // namespace phalanx
