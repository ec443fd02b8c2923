// Glass and the like: smooth, rough, or a thin sheet.
#include "material_readers.h"
#include "texture_keys.h"

namespace phalanx {

namespace {

void read_tints(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  colour_or_texture(object, "specular", kUnitInterval, reader, material.specular,
                    material.textures.specular);
  colour_or_texture(object, "transmittance", kUnitInterval, reader, material.transmittance,
                    material.textures.transmittance);
}

}  // namespace

void read_dielectric(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  object.number("ior", kIor, material.ior);
  read_roughness(object, reader, material);
  read_tints(object, reader, material);
}

void read_thin_dielectric(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  object.number("ior", kIor, material.ior);
  read_tints(object, reader, material);
}

}  // namespace phalanx
