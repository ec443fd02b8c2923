// The environment map of a scene, from a picture or the sky, and how to draw directions from it.
#pragma once
#include "../core/error.h"
#include "environment_map.h"
#include "scene.h"
#include "sky.h"

namespace phalanx {

/// Reads the map of a description. Pixels that are negative or no numbers become black, with a warning.
/// Errors name the light that asked for it; the result is empty then.
EnvironmentMap read_environment_map(const EnvironmentMapDescription &description,
                                    Diagnostics &diagnostics);

/// Makes `map` the environment of the scene. Returns the integral of its luminance over the sphere, in
/// W m^-2; if that is 0 the scene is left as it is.
double set_environment_map(EnvironmentMap map, Scene &scene);

}  // namespace phalanx
