// Stage 3: order the paths of a wave by what they hit, so that a shade kernel runs full gangs of
// one material kind. A counting sort; within a kind slots ascend.
#include "gang.isph"

#define NUM_BUCKETS (kNumMaterialKinds + 1)

/// counts[kind] receives the number of paths that hit that kind, counts[kNumMaterialKinds] those
/// that left the scene. wave.order lists them, kind after kind. Slots 0 .. num_slots - 1 are read.
export void KERNEL(bucket)(const uniform WaveView &wave, uniform int32 num_slots,
                           uniform int32 counts[]) {
  int32 found[NUM_BUCKETS];
  for (uniform int32 k = 0; k < NUM_BUCKETS; ++k) found[k] = 0;
  foreach (slot = 0 ... num_slots) {
    const int32 kind = wave.depth[slot] >= 0 ? wave.hit_kind[slot] : -1;
    for (uniform int32 k = 0; k < NUM_BUCKETS; ++k)
      if (kind == k) found[k] += 1;
  }
  uniform int32 next[NUM_BUCKETS];
  uniform int32 sum = 0;
  for (uniform int32 k = 0; k < NUM_BUCKETS; ++k) {
    counts[k] = reduce_add(found[k]);
    next[k] = sum;
    sum += counts[k];
  }
  foreach (slot = 0 ... num_slots) {
    const int32 kind = wave.depth[slot] >= 0 ? wave.hit_kind[slot] : -1;
    uniform int32 common;
    if (reduce_equal(kind, &common)) {
      // The usual case: the whole gang goes to one bucket.
      if (common >= 0) next[common] += packed_store_active(&wave.order[next[common]], slot);
    } else {
      for (uniform int32 k = 0; k < NUM_BUCKETS; ++k)
        if (kind == k) next[k] += packed_store_active(&wave.order[next[k]], slot);
    }
  }
}
