// Recursive: L = Le + Ld + f cos / pdf * L', as textbooks write it and as the ancestor works. Uses
// the physics of kernels/physics/ but none of the estimator's bookkeeping of throughput, so it
// guards that; it sums from the far end of the path, hence equal to rounding only.
#include "../../kernels/physics/any_vertex.h"
#include "../scene/trace.h"
#include "schedules.h"

namespace phalanx {
namespace {

template <int D>
struct Tracer {
  const SceneView &scene;
  const FrameView &frame;
  RayCounts &rays;

  /// Radiance arriving along the ray of p. p.throughput is only what roulette looks at.
  Vec3 incident(PathState p, float *aov) {
    (p.depth == 0 ? rays.camera : rays.bounce) += 1;
    const float time = path_time(scene, p.scramble, p.sample);
    const Hit hit = resolve_hit<D>(scene, frame, trace_closest(scene, p.origin, p.direction, time),
                                   p.origin, p.direction, p.scramble, p.sample, p.depth);
    if (aov != nullptr) {
      const FirstHit f = first_hit<D>(scene, hit, p.origin, p.direction);
      const float record[] = {f.albedo.x, f.albedo.y, f.albedo.z, f.normal.x,
                              f.normal.y, f.normal.z, f.depth};
      for (int i = 0; i < PHALANX_AOV_FLOATS; ++i) aov[i] = record[i];
    }
    if (hit.geometry < 0) return sees_environment<D>(scene, frame) ? escaped(p) : Vec3{0, 0, 0};
    if (D == kRich && frame.integrator != kPathIntegrator) return viewed(p, hit);
    return at_surface(p, hit);
  }

  /// Radiance from outside the scene.
  Vec3 escaped(PathState p) {
    p.throughput = {1, 1, 1};
    return escaped_radiance<D>(scene, p);
  }

  /// What the integrators of the first surface say.
  Vec3 viewed(const PathState &p, const Hit &hit) {
    const Vertex v = view_vertex(scene, frame, p, hit);
    return v.emitted + visible(p, v.shadow);
  }

  /// Radiance leaving whatever was hit.
  Vec3 at_surface(const PathState &p, const Hit &hit) {
    int32 kind = scene.geometries[hit.geometry].kind;
    if (D == kRich && kind == kBlend) kind = scene.materials[hit.material - 1].kind;
    switch (kind) {
#define PHALANX_KIND(constant, name, density, transmits) \
  case constant: return leaving<constant>(p, hit);
      PHALANX_BASIC_KINDS(PHALANX_KIND)
      default: break;
    }
    if constexpr (D == kRich) {
      switch (kind) {
        PHALANX_RICH_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
        default: break;
      }
    }
    return {0, 0, 0};
  }

  /// Radiance leaving a surface towards the viewer.
  template <int Kind>
  Vec3 leaving(const PathState &p, const Hit &hit) {
    Surface s = make_surface<D>(scene, hit, p.origin, p.direction);
    Material m = surface_material<D>(scene, hit, s);
    Vec3 radiance = {0, 0, 0};
    if (s.light >= 0)
      radiance = emitted_radiance<D>(scene, scene.materials[s.material], s) *
                 emission_weight<D>(scene, p, s);
    if (p.depth >= frame.max_depth || Kind == kBlack) return radiance;
    if (D == kRich) {
      if (m.one_sided != 0 && s.front == 0) return radiance;
      m = textured_material(scene, m, s.at);
      s.shading = mapped_frame(scene, m, s, p.direction);
    }

    const Vec3 wo = to_local(s.shading, neg(p.direction));
    if (scene.num_lights > 0 && has_density<Kind>()) radiance = radiance + direct<Kind>(p, m, s, wo);
    return radiance + scattered<Kind>(p, m, s, wo);
  }

  template <int Kind>
  Vec3 direct(PathState p, const Material &m, const Surface &s, Vec3 wo) {
    p.throughput = {1, 1, 1};
    return visible(p, direct_light<Kind, D>(scene, frame, p, m, s, wo));
  }

  Vec3 visible(const PathState &p, const ShadowRay &ray) {
    if (is_black(ray.contribution)) return {0, 0, 0};
    if (!is_traceable(ray.origin, ray.direction)) return fault({}).emitted;
    rays.shadow += 1;
    const float time = path_time(scene, p.scramble, p.sample);
    if (trace_occluded(scene, ray.origin, ray.direction, ray.distance, time)) return {0, 0, 0};
    return ray.contribution;
  }

  template <int Kind>
  Vec3 scattered(const PathState &p, const Material &m, const Surface &s, Vec3 wo) {
    const Vec2 u = vertex_pair(frame, p, PHALANX_PAIR_BSDF);
    const Vec2 u_lobe = vertex_pair(frame, p, PHALANX_PAIR_LOBE);
    const BsdfSample b = sample_bsdf<Kind>(scene, m, s.front, wo, u, u_lobe.x);
    if (is_black(b.weight)) return {0, 0, 0};
    const Vec3 wi = to_world(s.shading, b.wi);
    if ((b.wi.z > 0.0f) != (dot(wi, s.normal) > 0.0f)) return {0, 0, 0};
    Vec3 weight = b.weight;
    Vec3 throughput = p.throughput * b.weight;
    if (!scales_radiance<Kind>(m) && p.depth + 1 >= frame.roulette_depth) {
      const float survival = survival_probability(throughput);
      if (u_lobe.y >= survival) return {0, 0, 0};
      weight = weight * (1.0f / survival);
      throughput = throughput * (1.0f / survival);
    }
    PathState next = p;
    next.origin = scattered_origin<Kind, D>(s, wi);
    next.direction = normalize(wi);
    next.throughput = throughput;
    next.pdf = b.pdf;
    next.depth = p.depth + 1;
    if (!is_traceable(next.origin, next.direction)) return fault({}).emitted;
    return weight * incident(next, nullptr);
  }
};

template <int D>
void render_samples(const SceneView &scene, const FrameView &frame, const TileView &tile,
                    RayCounts &rays) {
  Tracer<D> tracer{scene, frame, rays};
  for (int32 i = 0; i < tile.num_samples; ++i) {
    const TileSample at = tile_sample(tile, i);
    float *aov = tile.aov != nullptr ? tile.aov + i * PHALANX_AOV_FLOATS : nullptr;
    const Vec3 l = tracer.incident(start_path(frame, at.x, at.y, at.sample), aov);
    tile.radiance[3 * i] = l.x;
    tile.radiance[3 * i + 1] = l.y;
    tile.radiance[3 * i + 2] = l.z;
  }
}

}  // namespace

void PHALANX_SCHEDULE(render_recursive)(const SceneView &scene, const FrameView &frame,
                                        const TileView &tile, RayCounts &rays, int detail) {
  if (detail == kRich) render_samples<kRich>(scene, frame, tile, rays);
  else render_samples<kPlain>(scene, frame, tile, rays);
}

}  // namespace phalanx
