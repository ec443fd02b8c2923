// The keys of each type of material, one file a family. Those that every type takes are read by
// read_material.cpp.
#pragma once
#include "read_scene.h"

namespace phalanx {

/// Reads the keys of one type; what is absent keeps the default that `material` holds, or gets the
/// type's own.
using MaterialReader = void(ObjectReader &object, SceneReader &reader,
                            MaterialDescription &material);

MaterialReader read_nothing_more, read_null, read_reflectance;  // read_material.cpp
MaterialReader read_conductor;                           // read_conductor.cpp
MaterialReader read_dielectric, read_thin_dielectric;    // read_dielectric.cpp
MaterialReader read_rough_diffuse, read_coated_diffuse;  // read_diffuse.cpp
MaterialReader read_principled;                          // read_principled.cpp
MaterialReader read_phong;                               // read_phong.cpp
MaterialReader read_hair;                                // read_hair.cpp
MaterialReader read_blend;                               // read_blend.cpp

constexpr Range kIor = {1e-3, 1e5};

/// "roughness", or "alpha", which is its square. (read_conductor.cpp)
void read_roughness(ObjectReader &object, SceneReader &reader, MaterialDescription &material);

}  // namespace phalanx
