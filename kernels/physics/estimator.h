// The estimator: what happens at one vertex of a path. Written once; the schedules repeat it.
//
// Path tracing with next-event estimation, multiple importance sampling and Russian roulette.
// Radiance of a path is the sum, in this order at each vertex, of (1) light emitted by the surface
// that was hit, (2) light sampled from an emitter, if its shadow ray gets through. Wavefront,
// megakernel and depth-first add in that order, so their sums have the same bits.
#pragma once
#include "bsdf.h"
#include "camera.h"
#include "light.h"
#include "rng.h"
#include "surface.h"

PHALANX_BEGIN

/// A path between two vertices: a ray on its way.
struct PathState {
  Vec3 origin, direction;   // direction is unit
  Vec3 throughput;          // product of f cos / pdf and 1 / survival so far
  float pdf;                // density of direction; 0 after the camera and delta scattering
  int32 depth;              // scattering events so far; negative: the path has ended
  int32 scramble;           // bits of pixel_scramble()
  int32 sample;             // number of the sample within its pixel
};

/// A light sample that waits for its visibility test.
struct ShadowRay {
  Vec3 origin, direction;
  float distance;           // the segment's length
  Vec3 contribution;        // added to the path's radiance if nothing is in the way; black: none
};

struct Vertex {
  Vec3 emitted;             // to be added to the path's radiance now
  ShadowRay shadow;
  PathState next;           // next.depth < 0 where the path ends here
};

/// Power heuristic with exponent 2: a^2 / (a^2 + b^2), a > 0, b >= 0, without overflow (Veach 1997,
/// section 9.2.4; STABILITY L12).
PHYS float power_heuristic(float a, float b) {
  const bool swap = b > a;
  const float r = swap ? a / b : b / a;
  const float w = 1.0f / (1.0f + r * r);
  return swap ? r * r * w : w;
}

PHYS PathState start_path(const UNI FrameView &frame, int32 x, int32 y, int32 sample) {
  const uint32 scramble = pixel_scramble(x, y, frame.seed);
  const Ray ray = camera_ray(frame, x, y, scramble, sample);
  PathState p;
  p.origin = ray.origin;
  p.direction = ray.direction;
  p.throughput = vec3(1.0f, 1.0f, 1.0f);
  p.pdf = 0.0f;
  p.depth = 0;
  p.scramble = (int32)scramble;
  p.sample = sample;
  return p;
}

PHYS Vec2 vertex_pair(const UNI FrameView &frame, PathState p, int32 pair) {
  return sample_pair(frame.sampler, (uint32)p.scramble, p.sample,
                     PHALANX_PAIR_FIRST_VERTEX + p.depth * PHALANX_PAIRS_PER_VERTEX + pair);
}

/// Radiance of the environment along a ray that left the scene.
PHYS Vec3 escaped_radiance(const UNI SceneView &scene, PathState p) {
  return p.throughput * scene.environment;
}

/// Radiance that the surface emits towards the viewer, before throughput and weight.
PHYS Vec3 emitted_radiance(Material m, Surface s) {
  if (s.front == 0 && m.two_sided == 0) return vec3(0.0f, 0.0f, 0.0f);
  return m.emission;
}

/// Weight of light met by a scattered ray, against having sampled it from the light s.light.
PHYS float emission_weight(const UNI SceneView &scene, PathState p, Surface s) {
  if (p.pdf == 0.0f) return 1.0f;
  return power_heuristic(p.pdf, light_pdf(fetch(scene.lights, s.light), p.origin, s.position, s.normal));
}

/// Light sampled at a surface, with its weight and the path's throughput.
template <int Kind>
PHYS ShadowRay direct_light(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                            Material m, Surface s, Vec3 wo) {
  ShadowRay ray;
  ray.contribution = vec3(0.0f, 0.0f, 0.0f);
  const Vec3 start = s.position + s.normal * s.offset;
  const LightSample light =
      sample_light(scene, start, vertex_pair(frame, p, PHALANX_PAIR_LIGHT_CHOICE),
                   vertex_pair(frame, p, PHALANX_PAIR_LIGHT));
  ray.origin = start;
  ray.direction = light.direction;
  ray.distance = light.distance;
  // An opaque surface receives light only on the viewer's side, of the geometry and of the shading. The
  // point itself must lie there, too: a convex lamp does not light itself, though points moved off it
  // can rise above its own horizon.
  if (!(light.pdf > 0.0f) || !(dot(light.direction, s.normal) > 0.0f) ||
      !(dot(light.point - start, s.normal) > 0.0f))
    return ray;
  const BsdfValue f = eval_bsdf<Kind>(m, wo, to_local(s.shading, light.direction));
  if (!(f.pdf > 0.0f)) return ray;
  const float weight = power_heuristic(light.pdf, f.pdf);
  ray.contribution = p.throughput * f.f_cos * light.radiance * (weight / light.pdf);
  return ray;
}

/// Probability to go on with throughput t: its largest component, between 0.05 and 1.
PHYS float survival_probability(Vec3 t) { return clamp_to(max_component(t), 0.05f, 1.0f); }

/// What happens at a surface whatever its material: emission. The path ends here until scatter()
/// says how it goes on.
PHYS Vertex arrive(const UNI SceneView &scene, PathState p, Material m, Surface s) {
  Vertex v;
  v.emitted = vec3(0.0f, 0.0f, 0.0f);
  v.shadow.contribution = vec3(0.0f, 0.0f, 0.0f);
  v.next = p;
  v.next.depth = -1;

  if (s.light >= 0)
    v.emitted = p.throughput * emitted_radiance(m, s) * emission_weight(scene, p, s);
  return v;
}

/// Samples a light and the next direction at a surface whose material is of this Kind.
template <int Kind>
PHYS Vertex scatter(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                    Material m, Surface s, Vertex arrived) {
  Vertex v = arrived;
  if (p.depth >= frame.max_depth || Kind == kBlack) return v;

  const Vec3 wo = to_local(s.shading, neg(p.direction));
  if (scene.num_lights > 0 && has_density<Kind>())
    v.shadow = direct_light<Kind>(scene, frame, p, m, s, wo);

  const Vec2 u = vertex_pair(frame, p, PHALANX_PAIR_BSDF);
  const Vec2 u_lobe = vertex_pair(frame, p, PHALANX_PAIR_LOBE);
  const BsdfSample b = sample_bsdf<Kind>(m, s.front, wo, u, u_lobe.x);
  if (is_black(b.weight)) return v;
  const Vec3 wi = to_world(s.shading, b.wi);
  // Reflection must leave on the viewer's side of the geometry, too, transmission on the other.
  if ((b.wi.z > 0.0f) != (dot(wi, s.normal) > 0.0f)) return v;
  Vec3 throughput = p.throughput * b.weight;
  // No roulette at dielectric interfaces: they absorb nothing, and the 1/eta^2 that radiance carries
  // inside would be mistaken for absorption.
  if (Kind != kDielectric && p.depth + 1 >= frame.roulette_depth) {
    const float survival = survival_probability(throughput);
    if (u_lobe.y >= survival) return v;
    throughput = throughput * (1.0f / survival);
  }
  v.next.origin = spawn_origin(s, wi);
  v.next.direction = normalize(wi);
  v.next.throughput = throughput;
  v.next.pdf = b.pdf;
  v.next.depth = p.depth + 1;
  return v;
}

/// One vertex of a path at a surface whose material is of this Kind.
template <int Kind>
PHYS Vertex path_vertex(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                        Hit hit) {
  const Surface s = make_surface(scene, hit, p.origin, p.direction);
  const Material m = fetch(scene.materials, s.material);
  return scatter<Kind>(scene, frame, p, m, s, arrive(scene, p, m, s));
}

PHALANX_END
