// Diffuse surfaces with something more to them: rough ones, coated ones.
#include "material_readers.h"
#include "texture_keys.h"

namespace phalanx {

namespace {

constexpr Range kCoatIor = {1, 1e5};
constexpr double kDefaultRoughness = 0.5;

}  // namespace

void read_rough_diffuse(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  read_reflectance(object, reader, material);
  material.roughness = kDefaultRoughness;
  number_or_texture(object, "roughness", kUnitInterval, reader, material.roughness,
                    material.textures.roughness);
}

void read_coated_diffuse(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  read_reflectance(object, reader, material);
  object.number("ior", kCoatIor, material.ior);
  read_roughness(object, reader, material);
  colour_or_texture(object, "specular", kUnitInterval, reader, material.specular,
                    material.textures.specular);
}

}  // namespace phalanx
