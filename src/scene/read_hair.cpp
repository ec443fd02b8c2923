// Hair and fur.
#include "material_readers.h"

namespace phalanx {

namespace {

constexpr Range kHairIor = {1, 3};
constexpr Range kHairAbsorption = {0, 1e3};
constexpr Range kTilt = {-20, 20, "degrees"};
constexpr double kDefaultHairIor = 1.55;
constexpr double kDefaultHairRoughness = 0.3;

}  // namespace

void read_hair(ObjectReader &object, SceneReader &, MaterialDescription &material) {
  if (object.has("reflectance") && object.has("absorption"))
    object.error("give only one of: reflectance; absorption");
  object.colour("reflectance", kUnitInterval, material.reflectance);
  material.has_absorption = object.has("absorption");
  object.colour("absorption", kHairAbsorption, material.absorption);
  material.roughness = kDefaultHairRoughness;
  object.number("roughness", kUnitInterval, material.roughness);
  material.azimuthal_roughness = kDefaultHairRoughness;
  object.number("azimuthal_roughness", kUnitInterval, material.azimuthal_roughness);
  material.ior = kDefaultHairIor;
  object.number("ior", kHairIor, material.ior);
  object.number("tilt", kTilt, material.tilt);
}

}  // namespace phalanx
