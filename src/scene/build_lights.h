// Emitting geometry to lights.
#pragma once
#include "scene.h"

namespace phalanx {

/// Least probability of a light, as a share of the mean: the kernels' 24-bit uniforms can resolve
/// nothing much below, and a dim light may be the one that is near.
constexpr double kMinLightShare = 1.0 / (1 << 20);

/// Makes one light of every primitive of the top-level geometries whose material emits, sets
/// Geometry::first_light and fills the alias table. A light is chosen in proportion to its power,
/// but at least kMinLightShare / number of lights; select_pdf is what the rounded table gives.
void build_lights(Scene &scene);

/// Does the scene have light that kPlain kernels do not know?
bool has_rich_lights(const Scene &scene);

}  // namespace phalanx
