// Scenes of Embree inside the scene: moving groups, and strands.
#pragma once
#include "../../kernels/embree_version.h"
#include "../../kernels/scene_view.h"
#include "scene.h"

namespace phalanx {

/// A group that moves, or strands. Both are user geometry of one primitive which asks a scene of its own,
/// one ray at a time, with the ray taken there by our arithmetic: Embree's own interpolation of
/// transforms rounds otherwise in packets. Its curves hold for lengths around 1 only (it compares squared
/// lengths with 1.2e-7), so strands are kept at such a scale.
struct InnerScene {
  RTCScene scene = nullptr;
  const SceneView *view = nullptr;
  int32 instance = -1;     // groups: index into SceneView::instances
  float scale = 1;         // strands: metres to units of the inner scene, a power of two

  bool is_group() const { return instance >= 0; }
};

/// The factor from metres to the units of the inner scene of some strands, those of segments
/// first[0 .. n-1]: a typical segment becomes 16 units long.
float strand_scale(const Scene &scene, const int32 *first, std::size_t n);

/// Makes `geometry`, user geometry, ask `inner`, which must outlive it.
void set_inner_scene(RTCGeometry geometry, InnerScene *inner);

}  // namespace phalanx
