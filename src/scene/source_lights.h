// Lights that are no surfaces: points, spots, luminaires, suns, the environment map.
#pragma once
#include "../core/error.h"
#include "description.h"
#include "scene.h"

namespace phalanx {

/// A light without textures, profile or extent.
Light blank_light();

/// Appends the point and spot lights of the description that shine, with their profiles.
void add_point_lights(const SceneDescription &description, Scene &scene, Diagnostics &diagnostics);

/// Appends the lights at infinity that shine, the environment map last, and counts them. Returns the
/// luminance of each integrated over directions, W m^-2.
std::vector<double> add_infinite_lights(const SceneDescription &description, Scene &scene,
                                        Diagnostics &diagnostics);

}  // namespace phalanx
