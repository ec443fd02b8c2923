// Materials for tests.
#pragma once
#include "../../kernels/scene_view.h"
#include "scene/build_materials.h"

namespace phalanx::test {

inline Material material(MaterialKind kind, float reflectance) {
  Material m = blank_material();
  m.kind = kind;
  m.reflectance = {reflectance, reflectance, reflectance};
  m.alpha = 1;
  m.ior = 1;
  return m;
}
inline Material diffuse(float albedo) { return material(kDiffuse, albedo); }
inline Material mirror(float f0) { return material(kMirror, f0); }
/// Reflects everything at the microfacets.
inline Material conductor(float alpha) {
  Material m = material(kConductor, 1);
  m.alpha = alpha;
  return m;
}
inline Material dielectric(float ior) {
  Material m = material(kDielectric, 1);
  m.ior = ior;
  return m;
}

}  // namespace phalanx::test
