#include "any_bsdf.h"

namespace phalanx::check {

BsdfSample sample_any(const SceneView &scene, const Material &m, int32 front, Vec3 wo, Vec2 u, float u_lobe) {
#define PHALANX_KIND(constant, name, density, transmits) \
  if (m.kind == constant) return sample_bsdf<constant>(scene, m, front, wo, u, u_lobe);
  PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
  return no_sample();
}

BsdfValue eval_any(const SceneView &scene, const Material &m, int32 front, Vec3 wo, Vec3 wi) {
#define PHALANX_KIND(constant, name, density, transmits) \
  if (m.kind == constant) return eval_bsdf<constant>(scene, m, front, wo, wi);
  PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
  return no_value();
}

double index_step(const Material &m, int32 front, Vec3 wo, Vec3 wi) {
  const bool refracts = m.kind == kDielectric || m.kind == kRoughDielectric || m.kind == kPrincipled;
  if (!refracts || (wo.z > 0) == (wi.z > 0)) return 1;
  return static_cast<double>(front != 0 ? m.ior : 1 / m.ior);
}

}  // namespace phalanx::check
