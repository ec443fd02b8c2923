// Integrators that look at the first surface only: ambient occlusion, and views of normals, albedo,
// texture coordinates and materials.
#pragma once
#include "estimator.h"
#include "first_hit.h"

PHALANX_BEGIN

/// A colour to tell number `index` from its neighbours.
PHYS Vec3 index_colour(int32 index) {
  const uint32 h = hash32((uint32)index + 1u);
  return vec3(unit_float(h), unit_float(hash32(h + 1u)), unit_float(hash32(h + 2u))) * 0.8f +
         vec3(0.1f, 0.1f, 0.1f);
}

/// A ray with density cos / pi around the shading normal, which brings 1 if it gets as far as
/// frame.occlusion_distance: its mean is the cosine-weighted share of open sky.
PHYS ShadowRay occlusion_ray(const UNI FrameView &frame, PathState p, Surface s) {
  const Vec3 wi =
      to_world(s.shading, square_to_cosine_hemisphere(vertex_pair(frame, p, PHALANX_PAIR_BSDF)));
  ShadowRay ray;
  ray.origin = spawn_origin(s, wi);
  ray.direction = normalize(wi);
  ray.distance = frame.occlusion_distance;
  const bool leaves = dot(wi, s.normal) > 0.0f;
  ray.contribution = leaves ? p.throughput : vec3(0.0f, 0.0f, 0.0f);
  return ray;
}

/// The only vertex of a path under an integrator other than kPathIntegrator.
PHYS Vertex view_vertex(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                        Hit hit) {
  Vertex v;
  v.emitted = vec3(0.0f, 0.0f, 0.0f);
  v.shadow.contribution = vec3(0.0f, 0.0f, 0.0f);
  v.next = p;
  v.next.depth = -1;
  Surface s = make_surface<kRich>(scene, hit, p.origin, p.direction);
  const Material constants = surface_material<kRich>(scene, hit, s);
  const Material m = textured_material(scene, constants, s.at);
  s.shading = mapped_frame(scene, m, s, p.direction);
  Vec3 seen = vec3(0.0f, 0.0f, 0.0f);
  if (frame.integrator == kAmbientOcclusion) {
    v.shadow = occlusion_ray(frame, p, s);
  } else if (frame.integrator == kViewNormal) {
    seen = s.shading.n * 0.5f + vec3(0.5f, 0.5f, 0.5f);
  } else if (frame.integrator == kViewAlbedo) {
    seen = material_albedo(m);
  } else if (frame.integrator == kViewUv) {
    seen = vec3(s.at.uv.x - round_down(s.at.uv.x), s.at.uv.y - round_down(s.at.uv.y), 0.0f);
  } else {
    seen = index_colour(hit.material > 0 ? hit.material - 1 : s.material);
  }
  v.emitted = p.throughput * seen;
  return v;
}

PHALANX_END
