#include "wavefront.h"

#include <algorithm>

namespace phalanx {
namespace {

struct Shading {
  ShadeKernel *kernel;
  int stage;
};

/// What happens to paths that met this kind of material.
Shading shading_of(const Kernels &k, const Plan &plan, int32 kind) {
  if (plan.frame.integrator != kPathIntegrator) return {k.shade_view, kStageView};
  return {plan.rich ? k.shade_rich[kind] : k.shade[kind], kStageShade + kind};
}

}  // namespace

void render_wavefront(const Kernels &k, const Plan &plan, const SceneView &scene,
                      const FrameView &frame, const TileView &tile, Wave &paths, StageClock &clock,
                      RayCounts &rays) {
  const WaveView &wave = paths.view();
  paths.clear();
  int32 next_sample = 0;
  clock.start();
  for (;;) {
    // Compact: which paths go on, which slots are free.
    const int32 num_active = k.compact(wave);
    clock.lap(kStageCompact, num_active, wave.capacity);

    // Regenerate: new camera samples in the free slots.
    const int32 num_fresh = std::min(wave.capacity - num_active, tile.num_samples - next_sample);
    if (num_active + num_fresh == 0) break;
    k.generate(frame, tile, wave, wave.free, next_sample, num_fresh);
    next_sample += num_fresh;
    clock.lap(kStageGenerate, num_fresh);

    // Intersect: camera rays are coherent, the others are not.
    k.intersect(scene, tile, wave, wave.free, num_fresh, kCoherentPackets);
    k.intersect(scene, tile, wave, wave.active, num_active, frame.bounce_order);
    rays.camera += num_fresh;
    rays.bounce += num_active;
    clock.lap(kStageIntersect, num_fresh + num_active);
    if (plan.blends) {
      k.resolve(scene, frame, tile, wave, wave.free, num_fresh);
      k.resolve(scene, frame, tile, wave, wave.active, num_active);
      clock.lap(kStageResolve, num_fresh + num_active);
    }
    if (plan.aovs) {
      (plan.rich ? k.aov_rich : k.aov)(scene, tile, wave, wave.free, num_fresh);
      clock.lap(kStageAov, num_fresh);
    }

    // Bucket: order the paths by the kind of material they hit.
    int32 counts[kNumMaterialKinds + 1];
    const auto num_buckets = static_cast<int32>(plan.buckets.size());
    k.bucket(wave, wave.capacity, plan.buckets.data(), num_buckets, counts);
    clock.lap(kStageBucket, num_fresh + num_active, wave.capacity);

    // Shade: one kernel per kind; each appends its shadow rays.
    const int32 *slots = wave.order;
    int32 num_shadow = 0;
    for (int b = 0; b < num_buckets - 1; ++b) {
      if (counts[b] == 0) continue;
      const Shading shading = shading_of(k, plan, plan.buckets[static_cast<std::size_t>(b)]);
      num_shadow = shading.kernel(scene, frame, tile, wave, slots, counts[b], num_shadow);
      slots += counts[b];
      clock.lap(shading.stage, counts[b]);
    }
    const int32 num_escaped = counts[num_buckets - 1];
    (plan.rich ? k.shade_escaped_rich : k.shade_escaped)(scene, frame, tile, wave, slots,
                                                         num_escaped);
    clock.lap(kStageEscaped, num_escaped);

    // Shadow: add the light samples that nothing is in the way of.
    k.shadow(scene, tile, wave, wave.shadow_list, num_shadow);
    rays.shadow += num_shadow;
    clock.lap(kStageShadow, num_shadow);
  }
}

}  // namespace phalanx
