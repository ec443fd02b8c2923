// How much light each light gives: what it is chosen by.
#pragma once
#include <vector>

#include "scene.h"

namespace phalanx {

/// Power of every light over pi, as luminance; at least kMinLightShare of the mean. Those at infinity count
/// by what crosses the sphere around the scene; `infinite` is their luminance integrated over directions.
/// Textures are asked at points of the light.
std::vector<double> light_powers(const Scene &scene, const std::vector<double> &infinite);

}  // namespace phalanx
