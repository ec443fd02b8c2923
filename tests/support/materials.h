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
inline Material rough_diffuse(float albedo, float roughness) {
  Material m = material(kRoughDiffuse, albedo);
  m.roughness = roughness;
  return m;
}
/// As conductor(), but anisotropic.
inline Material glossy_conductor(float alpha_x, float alpha_y) {
  Material m = material(kGlossyConductor, 1);
  m.alpha_x = alpha_x;
  m.alpha_y = alpha_y;
  return m;
}
/// alpha 0 is smooth.
inline Material rough_dielectric(float ior, float alpha) {
  Material m = material(kRoughDielectric, 1);
  m.ior = ior;
  m.alpha = alpha;
  return m;
}
inline Material thin_dielectric(float ior) {
  Material m = material(kThinDielectric, 1);
  m.ior = ior;
  return m;
}
/// Its table is the caller's to set. alpha 0 is a smooth coat.
inline Material coated(float albedo, float ior, float alpha) {
  Material m = material(kCoated, albedo);
  m.ior = ior;
  m.alpha = alpha;
  return m;
}

}  // namespace phalanx::test
