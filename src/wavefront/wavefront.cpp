#include "wavefront.h"

#include <algorithm>

namespace phalanx {

void render_wavefront(const Kernels &k, const Plan &plan, const SceneView &scene,
                      const TileView &tile, Wave &paths, StageClock &clock, RayCounts &rays) {
  const WaveView &wave = paths.view();
  const FrameView &frame = plan.frame;
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
    k.intersect(scene, wave, wave.free, num_fresh, 1);
    k.intersect(scene, wave, wave.active, num_active, 0);
    rays.camera += num_fresh;
    rays.bounce += num_active;
    clock.lap(kStageIntersect, num_fresh + num_active);
    if (plan.aovs) {
      k.aov(scene, tile, wave, wave.free, num_fresh);
      clock.lap(kStageAov, num_fresh);
    }

    // Bucket: order the paths by the kind of material they hit.
    int32 counts[kNumMaterialKinds + 1];
    k.bucket(wave, wave.capacity, counts);
    clock.lap(kStageBucket, num_fresh + num_active, wave.capacity);

    // Shade: one kernel per kind; each appends its shadow rays.
    const int32 *slots = wave.order;
    int32 num_shadow = 0;
    for (int kind = 0; kind < kNumMaterialKinds; ++kind) {
      if (counts[kind] == 0) continue;
      num_shadow = k.shade[kind](scene, frame, tile, wave, slots, counts[kind], num_shadow);
      slots += counts[kind];
      clock.lap(kStageShade + kind, counts[kind]);
    }
    k.shade_escaped(scene, tile, wave, slots, counts[kNumMaterialKinds]);
    clock.lap(kStageEscaped, counts[kNumMaterialKinds]);

    // Shadow: add the light samples that nothing is in the way of.
    k.shadow(scene, tile, wave, wave.shadow_list, num_shadow, 0);
    rays.shadow += num_shadow;
    clock.lap(kStageShadow, num_shadow);
  }
}

}  // namespace phalanx
