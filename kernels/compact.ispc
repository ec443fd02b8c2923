// Stage 6: which slots go on and which are free.
#include "gang.isph"

/// Lists slots 0 .. capacity - 1: paths that go on in wave.active, free ones in wave.free, both
/// ascending. Returns how many go on; the others are free.
export uniform int32 KERNEL(compact)(const uniform WaveView &wave) {
  uniform int32 num_active = 0;
  uniform int32 num_free = 0;
  for (uniform int32 base = 0; base < wave.capacity; base += programCount) {
    const int32 slot = base + programIndex;
    if (slot < wave.capacity) {
      if (wave.depth[slot] >= 0)
        num_active += packed_store_active(&wave.active[num_active], slot);
      else
        num_free += packed_store_active(&wave.free[num_free], slot);
    }
  }
  return num_active;
}
