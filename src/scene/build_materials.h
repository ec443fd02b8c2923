// Materials as kernels read them.
#pragma once
#include <string>
#include <vector>

#include "../core/error.h"
#include "description.h"

namespace phalanx {

/// One Material per description, same order. Conductors whose GGX alpha (roughness^2) is below 1e-3
/// become mirrors, with a note: below, their highlight is narrower than a float can describe. Tables
/// of directional albedos are appended to `tables`.
std::vector<Material> build_materials(const SceneDescription &description,
                                      std::vector<float> &tables, std::vector<std::string> &notes,
                                      Diagnostics &diagnostics);

/// A black diffuse material: no textures, opaque, reflection and transmission untinted.
Material blank_material();

/// Luminance of the emission, W sr^-1 m^-2; a material emits if it is above 0.
double emitted_luminance(const Material &material);

}  // namespace phalanx
