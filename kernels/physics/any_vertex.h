// A vertex of a path at whatever was hit: the switch over material kinds that the wavefront avoids
// by bucketing, for the schedules that follow a path to its end.
#pragma once
#include "estimator.h"
#include "resolve.h"
#include "view.h"

PHALANX_BEGIN

/// scatter() as a call: a dozen kinds inlined into one function would take minutes to compile.
template <int Kind>
PHYS_CALL Vertex scatter_rich(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                              Material m, Surface s, Vertex arrived) {
  return scatter<Kind, kRich>(scene, frame, p, m, s, arrived);
}

/// `hit` comes from resolve_hit() and hit.geometry >= 0. kPlain knows the basic kinds only.
template <int D>
PHYS Vertex path_vertex_any(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                            Hit hit) {
  if (D == kRich && frame.integrator != kPathIntegrator) return view_vertex(scene, frame, p, hit);
  const Surface s = make_surface<D>(scene, hit, p.origin, p.direction);
  const Material m = surface_material<D>(scene, hit, s);
  Vertex v = arrive<D>(scene, p, s);
  if (D == kPlain) {
#define PHALANX_KIND(constant, name, density, transmits) \
  if (m.kind == constant) v = scatter<constant, kPlain>(scene, frame, p, m, s, v);
    PHALANX_BASIC_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
  } else {
#define PHALANX_KIND(constant, name, density, transmits) \
  if (m.kind == constant) v = scatter_rich<constant>(scene, frame, p, m, s, v);
    PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
  }
  return v;
}

PHALANX_END
