// Stage 3: order the paths of a wave by what they hit, so that a shade kernel runs full gangs of
// one material kind. A counting sort; within a kind slots ascend.
#include "gang.isph"

/// counts[kind] receives the number of paths that hit that kind, counts[kNumMaterialKinds] those
/// that left the scene. wave.order lists them, kind after kind. Slots 0 .. num_slots - 1 are read.
export void KERNEL(bucket)(const uniform SceneView &scene, const uniform WaveView &wave,
                           uniform int32 num_slots, uniform int32 counts[]) {
  uniform int32 n[kNumMaterialKinds + 1];
  for (uniform int32 k = 0; k <= kNumMaterialKinds; ++k) n[k] = 0;
  for (uniform int32 base = 0; base < num_slots; base += programCount) {
    const int32 slot = base + programIndex;
    if (slot < num_slots && wave.depth[slot] >= 0) {
      int32 kind = kNumMaterialKinds;
      const int32 geometry = wave.hit_geometry[slot];
      if (geometry >= 0) kind = scene.materials[scene.geometries[geometry].material].kind;
      wave.hit_geometry[slot] = geometry;
      foreach_unique(k in kind) { n[k] += popcnt(lanemask()); }
    }
  }
  uniform int32 next[kNumMaterialKinds + 1];
  uniform int32 sum = 0;
  for (uniform int32 k = 0; k <= kNumMaterialKinds; ++k) {
    next[k] = sum;
    sum += n[k];
    counts[k] = n[k];
  }
  for (uniform int32 base = 0; base < num_slots; base += programCount) {
    const int32 slot = base + programIndex;
    if (slot < num_slots && wave.depth[slot] >= 0) {
      int32 kind = kNumMaterialKinds;
      const int32 geometry = wave.hit_geometry[slot];
      if (geometry >= 0) kind = scene.materials[scene.geometries[geometry].material].kind;
      foreach_unique(k in kind) { next[k] += packed_store_active(&wave.order[next[k]], slot); }
    }
  }
}
