// How surfaces scatter: one interface over the kinds of material.
//
// Directions are unit vectors in the local shading frame, both pointing away from the surface; wo
// is on the positive side (wo.z > 0). A kind is a template argument, so that a shade kernel holds
// the code of its own kind only; sample and eval of a kind stand in its bsdf_*.h.
#pragma once
#include "bsdf_conductor.h"
#include "bsdf_dielectric.h"
#include "bsdf_diffuse.h"
#include "bsdf_mirror.h"

PHALANX_BEGIN

/// True for kinds that light can be sampled for: those with a density.
template <int Kind>
PHYS UNI bool has_density() {
#define PHALANX_KIND(constant, name, density) \
  if (Kind == constant) return density != 0;
  PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
  return false;
}

/// Draws wi. `front`: wo is on the outer side of the surface. u: direction; u_lobe: choice of lobe.
/// See BsdfSample for what is returned.
template <int Kind>
PHYS BsdfSample sample_bsdf(Material m, int32 front, Vec3 wo, Vec2 u, float u_lobe) {
  if (Kind == kDiffuse) return sample_diffuse(m, u);
  if (Kind == kMirror) return sample_mirror(m, wo);
  if (Kind == kDielectric) return sample_dielectric(m, front, wo, u_lobe);
  if (Kind == kConductor) return sample_conductor(m, wo, u);
  return no_sample();
}

/// Value times cosine, and density, for a given pair of directions; zero for delta kinds.
template <int Kind>
PHYS BsdfValue eval_bsdf(Material m, Vec3 wo, Vec3 wi) {
  if (Kind == kDiffuse) return eval_diffuse(m, wi);
  if (Kind == kConductor) return eval_conductor(m, wo, wi);
  return no_value();
}

PHALANX_END
