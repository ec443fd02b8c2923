// A vertex of a path at whatever was hit: the switch over material kinds that the wavefront avoids
// by bucketing, for the schedules that follow a path to its end.
#pragma once
#include "estimator.h"

PHALANX_BEGIN

/// hit.geometry >= 0.
PHYS Vertex path_vertex_any(const UNI SceneView &scene, const UNI FrameView &frame, PathState p,
                            Hit hit) {
  const int32 kind = scene.materials[scene.geometries[hit.geometry].material].kind;
  Vertex v;
  if (kind == kDiffuse) v = path_vertex<kDiffuse>(scene, frame, p, hit);
  else if (kind == kMirror) v = path_vertex<kMirror>(scene, frame, p, hit);
  else if (kind == kDielectric) v = path_vertex<kDielectric>(scene, frame, p, hit);
  else if (kind == kConductor) v = path_vertex<kConductor>(scene, frame, p, hit);
  else v = path_vertex<kBlack>(scene, frame, p, hit);
  return v;
}

PHALANX_END
