// What depth-first tells an onlooker at each vertex of a path.
#pragma once
#include <vector>

#include "../../kernels/physics/estimator.h"

namespace phalanx {

struct PathStep {
  PathState ray;            // as it arrived here
  Hit hit;                  // hit.geometry is -1 where it left the scene
  Surface surface;          // where it met something
  Vec3 emitted;             // light of the surface, or from beyond the scene, as it was added
  ShadowRay shadow;         // contribution is black where no light was sampled
  bool blocked = false;     // something was in the way of the shadow ray
  PathState next;           // next.depth < 0 where the path ends
  Vec3 radiance;            // of the path so far, this vertex included
};
using PathSteps = std::vector<PathStep>;

}  // namespace phalanx
