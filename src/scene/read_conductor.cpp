// Metals: their colour, their roughness.
#include <cmath>

#include "material_readers.h"
#include "metals.h"
#include "texture_keys.h"

namespace phalanx {

namespace {

constexpr Range kEta = {1e-4, 1e5};
constexpr Range kAbsorption = {0, 1e5};
constexpr double kDefaultRoughness = 0.1;

void read_metal(ObjectReader &object, MaterialDescription &material) {
  std::vector<Choice> names;
  for (const Metal &metal : metals()) names.push_back({metal.name, static_cast<int>(names.size())});
  int index = 0;
  if (!object.choice("metal", names, index)) return;
  const Metal &metal = metals()[static_cast<std::size_t>(index)];
  material.has_ior = true;
  material.eta = metal.eta;
  material.k = metal.k;
}

/// The colour of a metal: reflectance, or eta with k, or a metal by name.
void read_conductor_colour(ObjectReader &object, SceneReader &reader,
                           MaterialDescription &material) {
  const bool has_eta_or_k = object.has("eta") || object.has("k");
  if (object.has("reflectance") + has_eta_or_k + object.has("metal") > 1) {
    object.error("give only one of: reflectance; eta with k; metal");
  }
  read_reflectance(object, reader, material);
  read_metal(object, material);
  if (has_eta_or_k) {
    material.has_ior = true;
    object.colour("eta", kEta, material.eta, kRequired);
    object.colour("k", kAbsorption, material.k, kRequired);
  }
}

/// One roughness, or one along the tangent and one across.
void read_conductor_roughness(ObjectReader &object, SceneReader &reader,
                              MaterialDescription &material) {
  material.roughness = kDefaultRoughness;
  const bool has_two = object.has("roughness_x") || object.has("roughness_y");
  if (has_two && (object.has("roughness") || object.has("alpha"))) {
    object.error("give only one of: roughness; alpha; roughness_x with roughness_y");
  }
  read_roughness(object, reader, material);
  if (has_two) {
    material.anisotropic = true;
    object.number("roughness_x", kUnitInterval, material.roughness_x, kRequired);
    object.number("roughness_y", kUnitInterval, material.roughness_y, kRequired);
  }
}

}  // namespace

void read_roughness(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  if (object.has("roughness") && object.has("alpha")) {
    object.error("give only one of: roughness; alpha, which is its square");
  }
  number_or_texture(object, "roughness", kUnitInterval, reader, material.roughness,
                    material.textures.roughness);
  double alpha = 0;
  if (object.number("alpha", kUnitInterval, alpha)) material.roughness = std::sqrt(alpha);
}

void read_conductor(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  read_conductor_colour(object, reader, material);
  read_conductor_roughness(object, reader, material);
  object.boolean("multiple_scattering", material.multiple_scattering);
}

}  // namespace phalanx
