// Scenes far from the origin: floats would lose the digits that tell their points apart.
#pragma once
#include "description.h"

namespace phalanx {

/// Moves the whole scene, camera and lights included, so that its middle is the origin, if it lies further from
/// there than 256 times half its own diagonal; `scene.origin` remembers by how much. All in double precision.
/// Scenes with textures in space stay where they are: the pattern belongs to the place.
void recentre(SceneDescription &scene);

}  // namespace phalanx
