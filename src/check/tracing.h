// Rays that cases trace themselves, one at a time, through a scene of theirs.
#pragma once
#include <cstdint>

#include "../../kernels/physics/surface.h"
#include "random.h"

namespace phalanx::check {

/// Where a ray met a surface.
struct Landing {
  Hit hit;          // hit.geometry is -1 where it met nothing
  Surface surface;
  bool landed() const { return hit.geometry >= 0; }
};
Landing land(const SceneView &scene, Vec3 origin, Vec3 direction);

/// A random direction on the side of `normal`.
Vec3 direction_beside(Vec3 normal, Random &random);
/// A random point of the box.
Vec3 point_between(Vec3 lo, Vec3 hi, Random &random);

struct SelfHits {
  std::int64_t rays = 0, hits = 0;
  double largest_offset = 0;  // metres
  double rate() const { return rays > 0 ? static_cast<double>(hits) / static_cast<double>(rays) : 1; }
};
/// Sends rays from all over the box; where one lands, another leaves at random on the same side, as scattered light
/// does. A hit is one that meets the primitive it left, where it cannot.
SelfHits self_hits(const SceneView &scene, Vec3 lo, Vec3 hi, int rays);

/// Rays from random points of the box that are lost: they meet nothing, in a scene that is closed around it.
std::int64_t lost_rays(const SceneView &scene, Vec3 lo, Vec3 hi, int rays, std::uint64_t seed);

}  // namespace phalanx::check
