// Recursive: L = Le + Ld + f cos / pdf * L', as textbooks write it and as the ancestor works. Uses
// the physics of kernels/physics/ but none of the estimator's bookkeeping of throughput, so it
// guards that; it sums from the far end of the path, hence equal to rounding only.
#include "../../kernels/physics/estimator.h"
#include "../../kernels/physics/first_hit.h"
#include "../scene/trace.h"
#include "schedules.h"

namespace phalanx {
namespace {

struct Tracer {
  const SceneView &scene;
  const FrameView &frame;
  RayCounts &rays;

  /// Radiance arriving along the ray of p. p.throughput is only what roulette looks at.
  Vec3 incident(PathState p, float *aov) {
    (p.depth == 0 ? rays.camera : rays.bounce) += 1;
    const Hit hit = trace_closest(scene, p.origin, p.direction);
    if (aov != nullptr) {
      const FirstHit f = first_hit(scene, hit, p.origin, p.direction);
      const float record[] = {f.albedo.x, f.albedo.y, f.albedo.z, f.normal.x,
                              f.normal.y, f.normal.z, f.depth};
      for (int i = 0; i < PHALANX_AOV_FLOATS; ++i) aov[i] = record[i];
    }
    if (hit.geometry < 0) return scene.environment;
    switch (scene.geometries[hit.geometry].kind) {
#define PHALANX_KIND(constant, name, density) \
  case constant: return leaving<constant>(p, hit);
      PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
      default: return {0, 0, 0};
    }
  }

  /// Radiance leaving a surface towards the viewer.
  template <int Kind>
  Vec3 leaving(const PathState &p, const Hit &hit) {
    const Surface s = make_surface(scene, hit, p.origin, p.direction);
    const Material m = scene.materials[s.material];
    Vec3 radiance = {0, 0, 0};
    if (s.light >= 0) radiance = emitted_radiance(m, s) * emission_weight(scene, p, s);
    if (p.depth >= frame.max_depth || Kind == kBlack) return radiance;

    const Vec3 wo = to_local(s.shading, neg(p.direction));
    if (scene.num_lights > 0 && has_density<Kind>()) radiance = radiance + direct<Kind>(p, m, s, wo);
    return radiance + scattered<Kind>(p, m, s, wo);
  }

  template <int Kind>
  Vec3 direct(PathState p, const Material &m, const Surface &s, Vec3 wo) {
    p.throughput = {1, 1, 1};
    const ShadowRay ray = direct_light<Kind>(scene, frame, p, m, s, wo);
    if (is_black(ray.contribution)) return {0, 0, 0};
    rays.shadow += 1;
    if (trace_occluded(scene, ray.origin, ray.direction, ray.distance)) return {0, 0, 0};
    return ray.contribution;
  }

  template <int Kind>
  Vec3 scattered(const PathState &p, const Material &m, const Surface &s, Vec3 wo) {
    const Vec2 u = vertex_pair(frame, p, PHALANX_PAIR_BSDF);
    const Vec2 u_lobe = vertex_pair(frame, p, PHALANX_PAIR_LOBE);
    const BsdfSample b = sample_bsdf<Kind>(m, s.front, wo, u, u_lobe.x);
    if (is_black(b.weight)) return {0, 0, 0};
    const Vec3 wi = to_world(s.shading, b.wi);
    if ((b.wi.z > 0.0f) != (dot(wi, s.normal) > 0.0f)) return {0, 0, 0};
    Vec3 weight = b.weight;
    Vec3 throughput = p.throughput * b.weight;
    if (Kind != kDielectric && p.depth + 1 >= frame.roulette_depth) {
      const float survival = survival_probability(throughput);
      if (u_lobe.y >= survival) return {0, 0, 0};
      weight = weight * (1.0f / survival);
      throughput = throughput * (1.0f / survival);
    }
    PathState next = p;
    next.origin = spawn_origin(s, wi);
    next.direction = normalize(wi);
    next.throughput = throughput;
    next.pdf = b.pdf;
    next.depth = p.depth + 1;
    return weight * incident(next, nullptr);
  }
};

}  // namespace

void PHALANX_SCHEDULE(render_recursive)(const SceneView &scene, const FrameView &frame,
                                        const TileView &tile, RayCounts &rays) {
  Tracer tracer{scene, frame, rays};
  for (int32 i = 0; i < tile.num_samples; ++i) {
    const TileSample at = tile_sample(tile, i);
    float *aov = tile.aov != nullptr ? tile.aov + i * PHALANX_AOV_FLOATS : nullptr;
    const Vec3 l = tracer.incident(start_path(frame, at.x, at.y, at.sample), aov);
    tile.radiance[3 * i] = l.x;
    tile.radiance[3 * i + 1] = l.y;
    tile.radiance[3 * i + 2] = l.z;
  }
}

}  // namespace phalanx
