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
#include "light_rich.h"
#include "mis.h"
#include "rng.h"
#include "surface_material.h"

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

PHYS PathState start_path(const UNI FrameView &frame, int32 x, int32 y, int32 sample) {
  const uint32 scramble = pixel_scramble(frame, x, y);
  const Ray ray = camera_ray(frame, x, y, scramble, sample);
  PathState p;
  p.origin = ray.origin;
  p.direction = ray.direction;
  p.throughput = vec3(ray.weight, ray.weight, ray.weight);
  p.pdf = 0.0f;
  p.depth = 0;
  p.scramble = (int32)scramble;
  p.sample = sample;
  return p;
}

PHYS Vec2 vertex_pair(const UNI FrameView &frame, PathState p, int32 pair) {
  return sample_pair(frame, (uint32)p.scramble, p.sample,
                     PHALANX_PAIR_FIRST_VERTEX + p.depth * PHALANX_PAIRS_PER_VERTEX + pair);
}

/// Do rays that leave the scene bring anything?
template <int D>
PHYS UNI bool sees_environment(const UNI SceneView &scene, const UNI FrameView &frame) {
  if (D == kRich)
    return frame.integrator == kPathIntegrator &&
           (scene.has_environment != 0 || scene.num_infinite_lights > 0);
  return scene.has_environment != 0;
}

/// Radiance of the environment along a ray that left the scene.
template <int D>
PHYS Vec3 escaped_radiance(const UNI SceneView &scene, PathState p) {
  if (D == kRich) return p.throughput * infinite_radiance(scene, p.origin, p.direction, p.pdf);
  return p.throughput * scene.environment;
}

/// Radiance that a surface of material m emits towards the viewer, before throughput and weight.
template <int D>
PHYS Vec3 emitted_radiance(const UNI SceneView &scene, Material m, Surface s) {
  if (s.front == 0 && m.two_sided == 0) return vec3(0.0f, 0.0f, 0.0f);
  if (D == kRich) {
    if (m.emission_texture >= 0)
      return m.emission * texture_value(scene, m.emission_texture, s.at);
  }
  return m.emission;
}

/// Weight of light met by a scattered ray, against having sampled it from the light s.light.
template <int D>
PHYS float emission_weight(const UNI SceneView &scene, PathState p, Surface s) {
  if (p.pdf == 0.0f) return 1.0f;
  const Light light = fetch(scene.lights, s.light);
  if (D == kRich)
    return power_heuristic(p.pdf, light_pdf_rich(scene, light, p.origin, s.position, s.normal));
  return power_heuristic(p.pdf, light_pdf(light, p.origin, s.position, s.normal));
}

/// Light sampled for the point `start`.
template <int D>
PHYS LightSample light_sample(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                              Vec3 start) {
  const Vec2 u_choice = vertex_pair(frame, p, PHALANX_PAIR_LIGHT_CHOICE);
  const Vec2 u = vertex_pair(frame, p, PHALANX_PAIR_LIGHT);
  if (D == kRich) return sample_light_rich(scene, start, u_choice, u);
  return sample_light(scene, start, u_choice, u);
}

/// True where light from this sample meets the side of the surface that `normal` points to. The point
/// itself must lie there, too: a convex lamp does not light itself, though points moved off it can rise
/// above its own horizon.
PHYS bool lights_side(LightSample light, Vec3 start, Vec3 normal) {
  return dot(light.direction, normal) > 0.0f && dot(light.point - start, normal) > 0.0f;
}

/// True for kinds whose transmission leaves a curve on its far side.
template <int Kind>
PHYS UNI bool crosses_curves() {
  return Kind == kHair || Kind == kThinDielectric;
}

/// Where a ray starts that scattering sends in direction w.
template <int Kind, int D>
PHYS Vec3 scattered_origin(Surface s, Vec3 w) {
  if (D == kRich && crosses_curves<Kind>()) return spawn_beyond(s, w);
  return spawn_origin(s, w);
}

/// Light sampled at a surface, with its weight and the path's throughput.
template <int Kind, int D>
PHYS ShadowRay direct_light(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                            Material m, Surface s, Vec3 wo) {
  ShadowRay ray;
  ray.contribution = vec3(0.0f, 0.0f, 0.0f);
  const Vec3 start = s.position + s.normal * s.offset;
  const LightSample light = light_sample<D>(scene, frame, p, start);
  ray.origin = start;
  ray.direction = light.direction;
  ray.distance = light.distance;
  if (!(light.pdf > 0.0f)) return ray;
  // An opaque surface receives light only on the viewer's side, of the geometry and of the shading.
  const bool above = lights_side(light, start, s.normal);
  bool below = false;
  if (transmits<Kind>()) {
    Vec3 back = s.position - s.normal * s.offset;
    below = lights_side(light, back, neg(s.normal));
    if (D == kRich && crosses_curves<Kind>()) back = spawn_beyond(s, light.direction);
    if (below) {
      ray.origin = back;
      if (light.distance < PHALANX_FAR) {
        const Vec3 to_light = start + light.direction * light.distance - back;
        ray.distance = length(to_light);
        ray.direction = to_light * (1.0f / ray.distance);
      }
    }
  }
  if (!above && !below) return ray;
  const Vec3 wi = to_local(s.shading, ray.direction);
  if (above != (wi.z > 0.0f)) return ray;
  const BsdfValue f = eval_bsdf<Kind>(scene, m, s.front, wo, wi);
  if (!(f.pdf > 0.0f)) return ray;
  float weight = power_heuristic(light.pdf, f.pdf);
  if (D == kRich) weight = light.is_delta != 0 ? 1.0f : weight;
  ray.contribution = p.throughput * f.f_cos * light.radiance * (weight / light.pdf);
  return ray;
}

/// Probability to go on with throughput t: its largest component, between 0.05 and 1.
PHYS float survival_probability(Vec3 t) { return clamp_to(max_component(t), 0.05f, 1.0f); }

/// True where roulette would mistake the 1/eta^2 that radiance carries inside a dielectric for absorption.
template <int Kind>
PHYS bool scales_radiance(Material m) {
  if (Kind == kDielectric || Kind == kRoughDielectric) return true;
  if (Kind == kPrincipled) return m.transmission > 0.0f;
  return false;
}

/// What happens at a surface whatever its material: emission. The path ends here until scatter()
/// says how it goes on.
template <int D>
PHYS Vertex arrive(const UNI SceneView &scene, PathState p, Surface s) {
  Vertex v;
  v.emitted = vec3(0.0f, 0.0f, 0.0f);
  v.shadow.contribution = vec3(0.0f, 0.0f, 0.0f);
  v.next = p;
  v.next.depth = -1;
  if (s.light >= 0) {
    const Material m = fetch(scene.materials, s.material);
    const Vec3 radiance = emitted_radiance<D>(scene, m, s);
    const float weight = emission_weight<D>(scene, p, s);
    v.emitted = p.throughput * radiance * weight;
  }
  return v;
}

/// The vertex of a path that went wrong: a ray that cannot be traced ends it, and makes its sample one that is not
/// finite, so that it is counted and can be replayed.
PHYS Vertex fault(Vertex vertex) {
  Vertex v = vertex;
  const float nan = float_from_bits(0x7fc00000);
  v.emitted = vec3(nan, nan, nan);
  v.shadow.contribution = vec3(0.0f, 0.0f, 0.0f);
  v.next.depth = -1;
  return v;
}

/// Samples a light and the next direction at a surface whose material m is of this Kind.
template <int Kind, int D>
PHYS Vertex scatter(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                    Material constants, Surface surface, Vertex arrived) {
  Vertex v = arrived;
  Material m = constants;
  Surface s = surface;
  if (p.depth >= frame.max_depth || Kind == kBlack) return v;
  if (D == kRich) {
    if (m.one_sided != 0 && s.front == 0) return v;
    m = textured_material(scene, m, s.at);
    s.shading = mapped_frame(scene, m, s, p.direction);
  }

  const Vec3 wo = to_local(s.shading, neg(p.direction));
  if (scene.num_lights > 0 && has_density<Kind>())
    v.shadow = direct_light<Kind, D>(scene, frame, p, m, s, wo);
  if (!is_black(v.shadow.contribution) && !is_traceable(v.shadow.origin, v.shadow.direction)) return fault(v);

  const Vec2 u = vertex_pair(frame, p, PHALANX_PAIR_BSDF);
  const Vec2 u_lobe = vertex_pair(frame, p, PHALANX_PAIR_LOBE);
  const BsdfSample b = sample_bsdf<Kind>(scene, m, s.front, wo, u, u_lobe.x);
  if (is_black(b.weight)) return v;
  const Vec3 wi = to_world(s.shading, b.wi);
  // Reflection must leave on the viewer's side of the geometry, too, transmission on the other.
  if ((b.wi.z > 0.0f) != (dot(wi, s.normal) > 0.0f)) return v;
  Vec3 throughput = p.throughput * b.weight;
  if (!scales_radiance<Kind>(m) && p.depth + 1 >= frame.roulette_depth) {
    const float survival = survival_probability(throughput);
    if (u_lobe.y >= survival) return v;
    throughput = throughput * (1.0f / survival);
  }
  v.next.origin = scattered_origin<Kind, D>(s, wi);
  v.next.direction = normalize(wi);
  v.next.throughput = throughput;
  v.next.pdf = b.pdf;
  v.next.depth = p.depth + 1;
  if (!is_traceable(v.next.origin, v.next.direction)) return fault(v);
  return v;
}

/// One vertex of a path at a surface whose material is of this Kind.
template <int Kind, int D>
PHYS Vertex path_vertex(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                        Hit hit) {
  const Surface s = make_surface<D>(scene, hit, p.origin, p.direction);
  const Material m = surface_material<D>(scene, hit, s);
  const Vertex v = arrive<D>(scene, p, s);
  return scatter<Kind, D>(scene, frame, p, m, s, v);
}

PHALANX_END
