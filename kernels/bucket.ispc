// Stage 3: order the paths of a wave by what they hit, so that a shade kernel runs full gangs of
// one material kind. A counting sort; within a kind slots ascend.
#include "gang.isph"

#define MAX_BUCKETS (kNumMaterialKinds + 1)

/// kinds: those that the scene has, and kEscaped. counts[b] receives the number of paths that hit kinds[b];
/// wave.order lists them, kind after kind. Slots 0 .. num_slots - 1 are read.
export void KERNEL(bucket)(const uniform WaveView &wave, uniform int32 num_slots,
                           const uniform int32 kinds[], uniform int32 num_kinds,
                           uniform int32 counts[]) {
  int32 found[MAX_BUCKETS];
  for (uniform int32 b = 0; b < num_kinds; ++b) found[b] = 0;
  foreach (slot = 0 ... num_slots) {
    const int32 kind = wave.depth[slot] >= 0 ? wave.hit_kind[slot] : -1;
    for (uniform int32 b = 0; b < num_kinds; ++b)
      if (kind == kinds[b]) found[b] += 1;
  }
  uniform int32 next[MAX_BUCKETS];
  uniform int32 sum = 0;
  for (uniform int32 b = 0; b < num_kinds; ++b) {
    counts[b] = reduce_add(found[b]);
    next[b] = sum;
    sum += counts[b];
  }
  foreach (slot = 0 ... num_slots) {
    const int32 kind = wave.depth[slot] >= 0 ? wave.hit_kind[slot] : -1;
    for (uniform int32 b = 0; b < num_kinds; ++b)
      if (kind == kinds[b]) next[b] += packed_store_active(&wave.order[next[b]], slot);
  }
}
