// How surfaces scatter: one interface over the kinds of material.
//
// Directions are unit vectors in the local shading frame, both pointing away from the surface; wo
// is on the positive side (wo.z > 0). A kind is a template argument, so that a shade kernel holds
// the code of its own kind only; sample and eval of a kind stand in its bsdf_*.h.
#pragma once
#include "bsdf_coated.h"
#include "bsdf_conductor.h"
#include "bsdf_dielectric.h"
#include "bsdf_diffuse.h"
#include "bsdf_glossy_conductor.h"
#include "bsdf_hair.h"
#include "bsdf_mirror.h"
#include "bsdf_phong.h"
#include "bsdf_principled.h"
#include "bsdf_rough_dielectric.h"
#include "bsdf_rough_diffuse.h"
#include "bsdf_thin_dielectric.h"

PHALANX_BEGIN

/// True for kinds that light can be sampled for: those with a density.
template <int Kind>
PHYS UNI bool has_density() {
#define PHALANX_KIND(constant, name, density, transmits) \
  if (Kind == constant) return density != 0;
  PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
  return false;
}

/// True for kinds that may let light through.
template <int Kind>
PHYS UNI bool transmits() {
#define PHALANX_KIND(constant, name, density, transmits) \
  if (Kind == constant) return transmits != 0;
  PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
  return false;
}

/// Draws wi. `front`: wo is on the outer side of the surface. u: direction; u_lobe: choice of lobe.
/// See BsdfSample for what is returned.
template <int Kind>
PHYS BsdfSample sample_bsdf(const UNI SceneView &scene, Material m, int32 front, Vec3 wo, Vec2 u,
                            float u_lobe) {
  if (Kind == kDiffuse) return sample_diffuse(m, u);
  if (Kind == kMirror) return sample_mirror(m, wo);
  if (Kind == kDielectric) return sample_dielectric(m, front, wo, u_lobe);
  if (Kind == kConductor) return sample_conductor(m, wo, u);
  if (Kind == kRoughDiffuse) return sample_rough_diffuse(m, wo, u);
  if (Kind == kGlossyConductor) return sample_glossy_conductor(scene, m, wo, u, u_lobe);
  if (Kind == kRoughDielectric) return sample_rough_dielectric(m, front, wo, u, u_lobe);
  if (Kind == kThinDielectric) return sample_thin_dielectric(m, wo, u_lobe);
  if (Kind == kCoated) return sample_coated(scene, m, wo, u, u_lobe);
  if (Kind == kPhong) return sample_phong(m, wo, u);
  if (Kind == kBlinnPhong) return sample_blinn_phong(m, wo, u);
  if (Kind == kPrincipled) return sample_principled(scene, m, front, wo, u, u_lobe);
  if (Kind == kHair) return sample_hair(m, wo, u, u_lobe);
  return no_sample();
}

/// Value times cosine, and density, for a given pair of directions; zero for delta kinds.
template <int Kind>
PHYS BsdfValue eval_bsdf(const UNI SceneView &scene, Material m, int32 front, Vec3 wo, Vec3 wi) {
  if (Kind == kDiffuse) return eval_diffuse(m, wi);
  if (Kind == kConductor) return eval_conductor(m, wo, wi);
  if (Kind == kRoughDiffuse) return eval_rough_diffuse(m, wo, wi);
  if (Kind == kGlossyConductor) return eval_glossy_conductor(scene, m, wo, wi);
  if (Kind == kRoughDielectric) return eval_rough_dielectric(m, front, wo, wi);
  if (Kind == kCoated) return eval_coated(scene, m, wo, wi);
  if (Kind == kPhong) return eval_phong(m, wo, wi);
  if (Kind == kBlinnPhong) return eval_blinn_phong(m, wo, wi);
  if (Kind == kPrincipled) return eval_principled(scene, m, front, wo, wi);
  if (Kind == kHair) return eval_hair(m, wo, wi);
  return no_value();
}

PHALANX_END
