// A vertex of a path at whatever was hit: the switch over material kinds that the wavefront avoids
// by bucketing, for the schedules that follow a path to its end.
#pragma once
#include "estimator.h"

PHALANX_BEGIN

/// hit.geometry >= 0.
PHYS Vertex path_vertex_any(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                            Hit hit) {
  const Surface s = make_surface(scene, hit, p.origin, p.direction);
  const Material m = fetch(scene.materials, s.material);
  Vertex v = arrive(scene, p, m, s);
#define PHALANX_KIND(constant, name, density) \
  if (m.kind == constant) v = scatter<constant>(scene, frame, p, m, s, v);
  PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
  return v;
}

PHALANX_END
