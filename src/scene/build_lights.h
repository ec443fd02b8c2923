// Emitting geometry and other sources to lights, and how one of them is chosen.
#pragma once
#include "../core/error.h"
#include "description.h"
#include "scene.h"

namespace phalanx {

/// Least probability of a light, as a share of the mean: the kernels' 24-bit uniforms can resolve
/// nothing much below, and a dim light may be the one that is near.
constexpr double kMinLightShare = 1.0 / (1 << 20);

/// More lights than this at finite distance are chosen by the tree, if the scene does not say how.
constexpr std::size_t kMaxLightsByPower = 64;

/// Makes one light of every primitive of the top-level geometries whose material emits, sets
/// Geometry::first_light, and adds the description's own lights, those at infinity last. Fills the alias
/// table: a light is chosen in proportion to its power, but at least kMinLightShare / number of lights;
/// select_pdf is what the rounded table gives. With a tree, the table is for the lights at infinity only.
/// Needs geometry, materials, textures and bounds of the scene.
void build_lights(Scene &scene, const SceneDescription &description, Diagnostics &diagnostics);

/// Do these lights need kRich kernels? (Others know plain area lights and a constant environment.)
bool has_rich_lights(const Scene &scene);

}  // namespace phalanx
