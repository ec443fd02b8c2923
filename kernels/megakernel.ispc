// The megakernel schedule: every lane carries one path to its end, divergence and all. Its lane
// utilisation is the honest picture of what SIMD makes of path tracing without queues.
#include "gang.isph"
#include "physics/any_vertex.h"
#include "trace.isph"

template <int D>
static inline void megakernel(const uniform SceneView &scene, const uniform FrameView &frame,
                              const uniform TileView &tile, uniform int64 *uniform counts) {
  for (uniform int32 base = 0; base < tile.num_samples; base += programCount) {
    const int32 block_index = base + programIndex;
    if (block_index < tile.num_samples) {
      const TileSample at = tile_sample(tile, block_index);
      PathState p = start_path(frame, at.x, at.y, at.sample);
      const float time = path_time(scene, p.scramble, p.sample);
      Vec3 radiance = vec3(0.0f, 0.0f, 0.0f);
      uniform bool camera = true;
      while (p.depth >= 0) {
        counts[0] += popcnt(lanemask());
        counts[1] += programCount;
        if (!camera) counts[2] += popcnt(lanemask());
        const uniform int32 order = camera ? kCoherentPackets : frame.bounce_order;
        const Hit hit =
            resolve_hit<D>(scene, frame, trace_closest(scene, p.origin, p.direction, time, order),
                           p.origin, p.direction, p.scramble, p.sample, p.depth);
        if (camera && tile.aov != NULL) {
          const FirstHit f = first_hit<D>(scene, hit, p.origin, p.direction);
          put_first_hit(tile, block_index, f);
        }
        if (hit.geometry < 0) {
          if (sees_environment<D>(scene, frame)) {
            const Vec3 light = escaped_radiance<D>(scene, p);
            radiance = radiance + light;
          }
          p.depth = -1;
        } else {
          const Vertex v = path_vertex_any<D>(scene, frame, p, hit);
          radiance = radiance + v.emitted;
          if (!is_black(v.shadow.contribution)) {
            counts[3] += popcnt(lanemask());
            if (!trace_occluded(scene, v.shadow.origin, v.shadow.direction, v.shadow.distance,
                                time))
              radiance = radiance + v.shadow.contribution;
          }
          p = v.next;
        }
        camera = false;
      }
      tile.radiance[3 * block_index] = radiance.x;
      tile.radiance[3 * block_index + 1] = radiance.y;
      tile.radiance[3 * block_index + 2] = radiance.z;
    }
  }
}

// Each renders all samples of a tile. counts: [0] vertices visited by lanes, [1] lanes that could have
// (gang width times steps), [2] bounce rays, [3] shadow rays.
export void KERNEL(megakernel)(const uniform SceneView &scene, const uniform FrameView &frame,
                               const uniform TileView &tile, uniform int64 counts[]) {
  megakernel<kPlain>(scene, frame, tile, counts);
}

export void KERNEL(megakernel_rich)(const uniform SceneView &scene, const uniform FrameView &frame,
                                    const uniform TileView &tile, uniform int64 counts[]) {
  megakernel<kRich>(scene, frame, tile, counts);
}
