// The material of glTF 2.0 with its extensions: metal, plastic, glass, with coat and sheen.
#include "material_readers.h"
#include "texture_keys.h"

namespace phalanx {

namespace {

constexpr Range kGlassIor = {1, 1e5};
constexpr double kDefaultPrincipledRoughness = 0.5;

void read_base(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  MaterialTextures &textures = material.textures;
  colour_or_texture(object, "base_color", kUnitInterval, reader, material.reflectance,
                    textures.reflectance);
  number_or_texture(object, "metallic", kUnitInterval, reader, material.metallic,
                    textures.metallic);
  material.roughness = kDefaultPrincipledRoughness;
  number_or_texture(object, "roughness", kUnitInterval, reader, material.roughness,
                    textures.roughness);
  object.number("ior", kGlassIor, material.ior);
  object.number("specular", kUnitInterval, material.specular_level);
  colour_or_texture(object, "specular_tint", kUnitInterval, reader, material.specular,
                    textures.specular);
  number_or_texture(object, "transmission", kUnitInterval, reader, material.transmission,
                    textures.transmission);
}

}  // namespace

void read_principled(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  read_base(object, reader, material);
  number_or_texture(object, "clearcoat", kUnitInterval, reader, material.clearcoat,
                    material.textures.clearcoat);
  object.number("clearcoat_roughness", kUnitInterval, material.clearcoat_roughness);
  colour_or_texture(object, "sheen_color", kUnitInterval, reader, material.sheen,
                    material.textures.sheen);
  object.number("sheen_roughness", kUnitInterval, material.sheen_roughness);
}

}  // namespace phalanx
