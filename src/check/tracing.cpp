#include "tracing.h"

#include <cmath>

#include "../scene/trace.h"

namespace phalanx::check {

Landing land(const SceneView &scene, Vec3 origin, Vec3 direction) {
  Landing l;
  l.hit = trace_closest(scene, origin, direction);
  l.surface = {};
  if (l.landed()) l.surface = make_surface<kPlain>(scene, l.hit, origin, direction);
  return l;
}

Vec3 direction_beside(Vec3 normal, Random &random) {
  const Vec3 d = random.direction();
  return dot(d, normal) < 0 ? neg(d) : d;
}

Vec3 point_between(Vec3 lo, Vec3 hi, Random &random) {
  const float x = random.unit(), y = random.unit(), z = random.unit();
  return {lo.x + (hi.x - lo.x) * x, lo.y + (hi.y - lo.y) * y, lo.z + (hi.z - lo.z) * z};
}

namespace {

bool is_same(const Hit &a, const Hit &b) {
  return a.geometry == b.geometry && a.primitive == b.primitive && a.instance == b.instance;
}

/// Seen from within, a sphere's own far side is met half a chord away at least.
bool may_meet_itself(const SceneView &scene, const Landing &left, Vec3 direction, const Landing &met) {
  const Geometry &g = scene.geometries[left.hit.geometry];
  if (g.shape != kSpheres || left.surface.front != 0) return false;
  const float radius = scene.spheres[g.first + left.hit.primitive].radius;
  const float chord = 2 * radius * dot(direction, left.surface.normal);
  return length(met.surface.position - left.surface.position) > 0.5f * chord;
}

}  // namespace

SelfHits self_hits(const SceneView &scene, Vec3 lo, Vec3 hi, int rays) {
  SelfHits result;
  Random random(31);
  for (int i = 0; i < rays; ++i) {
    const Landing first = land(scene, point_between(lo, hi, random), random.direction());
    if (!first.landed()) continue;
    result.largest_offset = std::fmax(result.largest_offset, static_cast<double>(first.surface.offset));
    const Vec3 d = direction_beside(first.surface.normal, random);
    const Landing second = land(scene, spawn_origin(first.surface, d), d);
    result.rays += 1;
    if (second.landed() && is_same(first.hit, second.hit) && !may_meet_itself(scene, first, d, second))
      result.hits += 1;
  }
  return result;
}

std::int64_t lost_rays(const SceneView &scene, Vec3 lo, Vec3 hi, int rays, std::uint64_t seed) {
  Random random(seed);
  std::int64_t lost = 0;
  for (int i = 0; i < rays; ++i) {
    const Vec3 from = point_between(lo, hi, random);
    lost += trace_closest(scene, from, random.direction()).geometry < 0;
  }
  return lost;
}

}  // namespace phalanx::check
