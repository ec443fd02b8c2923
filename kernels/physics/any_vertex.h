// A vertex of a path at whatever was hit: the switch over material kinds that the wavefront avoids
// by bucketing, for the schedules that follow a path to its end.
#pragma once
#include "estimator.h"

PHALANX_BEGIN

/// hit.geometry >= 0.
PHYS Vertex path_vertex_any(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                            Hit hit) {
  const int32 kind = scene.geometries[hit.geometry].kind;
  Vertex v;
  v.next = p;
#define PHALANX_KIND(constant, name, density) \
  if (kind == constant) v = path_vertex<constant>(scene, frame, p, hit);
  PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
  return v;
}

PHALANX_END
