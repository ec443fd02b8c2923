// Depth-first: one path after the other, each to its end. The estimator is the wavefront's own
// (kernels/physics/estimator.h), the order of additions too, so the bits are the same.
#include "../../kernels/physics/any_vertex.h"
#include "../../kernels/physics/first_hit.h"
#include "../scene/trace.h"
#include "schedules.h"

namespace phalanx {
namespace {

void store(float *block, int32 index, Vec3 v) {
  block[index] = v.x;
  block[index + 1] = v.y;
  block[index + 2] = v.z;
}

/// Onlookers of a path: nobody, while pictures are rendered; one who writes everything down, for replays.
struct Nobody {
  template <int D>
  void left(const SceneView &, const PathState &, Vec3) {}
  template <int D>
  void met(const SceneView &, const PathState &, const Hit &, const Vertex &, bool, Vec3) {}
};
struct Writer {
  PathSteps &steps;

  template <int D>
  void left(const SceneView &scene, const PathState &p, Vec3 radiance) {
    PathStep step = {};
    step.ray = p;
    step.hit.geometry = -1;
    step.emitted = escaped_radiance<D>(scene, p);
    step.next = p;
    step.next.depth = -1;
    step.radiance = radiance;
    steps.push_back(step);
  }
  template <int D>
  void met(const SceneView &scene, const PathState &p, const Hit &hit, const Vertex &v, bool blocked, Vec3 radiance) {
    steps.push_back({p, hit, make_surface<D>(scene, hit, p.origin, p.direction), v.emitted, v.shadow, blocked, v.next,
                     radiance});
  }
};

template <int D, typename Onlooker>
Vec3 path_radiance(const SceneView &scene, const FrameView &frame, PathState p, float *aov,
                   RayCounts &rays, Onlooker onlooker) {
  Vec3 radiance = {0, 0, 0};
  const float time = path_time(scene, p.scramble, p.sample);
  while (p.depth >= 0) {
    (p.depth == 0 ? rays.camera : rays.bounce) += 1;
    const Hit hit = resolve_hit<D>(scene, frame, trace_closest(scene, p.origin, p.direction, time),
                                   p.origin, p.direction, p.scramble, p.sample, p.depth);
    if (p.depth == 0 && aov != nullptr) {
      const FirstHit f = first_hit<D>(scene, hit, p.origin, p.direction);
      store(aov, 0, f.albedo);
      store(aov, 3, f.normal);
      aov[6] = f.depth;
    }
    if (hit.geometry < 0) {
      if (sees_environment<D>(scene, frame)) radiance = radiance + escaped_radiance<D>(scene, p);
      onlooker.template left<D>(scene, p, radiance);
      break;
    }
    const Vertex v = path_vertex_any<D>(scene, frame, p, hit);
    radiance = radiance + v.emitted;
    bool blocked = false;
    if (!is_black(v.shadow.contribution)) {
      rays.shadow += 1;
      blocked = trace_occluded(scene, v.shadow.origin, v.shadow.direction, v.shadow.distance, time);
      if (!blocked) radiance = radiance + v.shadow.contribution;
    }
    onlooker.template met<D>(scene, p, hit, v, blocked, radiance);
    p = v.next;
  }
  return radiance;
}

template <int D>
void render_samples(const SceneView &scene, const FrameView &frame, const TileView &tile,
                    RayCounts &rays) {
  for (int32 i = 0; i < tile.num_samples; ++i) {
    const TileSample at = tile_sample(tile, i);
    float *aov = tile.aov != nullptr ? tile.aov + i * PHALANX_AOV_FLOATS : nullptr;
    const PathState p = start_path(frame, at.x, at.y, at.sample);
    store(tile.radiance, 3 * i, path_radiance<D>(scene, frame, p, aov, rays, Nobody{}));
  }
}

}  // namespace

void PHALANX_SCHEDULE(render_depth_first)(const SceneView &scene, const FrameView &frame,
                                          const TileView &tile, RayCounts &rays, int detail) {
  if (detail == kRich) render_samples<kRich>(scene, frame, tile, rays);
  else render_samples<kPlain>(scene, frame, tile, rays);
}

Vec3 PHALANX_SCHEDULE(replay)(const SceneView &scene, const FrameView &frame, int32 x, int32 y, int32 sample,
                              int detail, PathSteps &steps) {
  RayCounts rays;
  const PathState p = start_path(frame, x, y, sample);
  if (detail == kRich) return path_radiance<kRich>(scene, frame, p, nullptr, rays, Writer{steps});
  return path_radiance<kPlain>(scene, frame, p, nullptr, rays, Writer{steps});
}

}  // namespace phalanx
