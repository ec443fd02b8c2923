// The BSDFs by number: what a shade kernel knows at compile time, cases learn from a material.
#pragma once
#include "../../kernels/physics/bsdf.h"

namespace phalanx::check {

BsdfSample sample_any(const SceneView &scene, const Material &m, int32 front, Vec3 wo, Vec2 u, float u_lobe);
BsdfValue eval_any(const SceneView &scene, const Material &m, int32 front, Vec3 wo, Vec3 wi);
/// Index on wi's side over wo's, for directions on different sides of what refracts; else 1.
double index_step(const Material &m, int32 front, Vec3 wo, Vec3 wi);

}  // namespace phalanx::check
