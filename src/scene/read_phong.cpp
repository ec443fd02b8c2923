// The lobes of "dirt" scenes: Phong and Blinn-Phong.
#include "material_readers.h"
#include "texture_keys.h"

namespace phalanx {

namespace {

constexpr Range kExponent = {0, 1e6};

}  // namespace

void read_phong(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  colour_or_texture(object, "reflectance", kUnitInterval, reader, material.reflectance,
                    material.textures.reflectance);
  object.number("exponent", kExponent, material.exponent);
}

}  // namespace phalanx
