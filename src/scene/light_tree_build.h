// Building the tree of lights that kernels/physics/light_tree.h walks.
#pragma once
#include <vector>

#include "../../kernels/scene_view.h"

namespace phalanx {

/// A tree over lights[0 .. power.size()), at least one, none of them at infinity, at most 2^30; one light a
/// leaf, no path longer than 31. Sets path and path_depth of the lights. `power`: > 0, in any unit.
std::vector<LightNode> build_light_tree(std::vector<Light> &lights,
                                        const std::vector<double> &power);

}  // namespace phalanx
