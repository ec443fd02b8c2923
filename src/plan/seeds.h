// Seeds made from the seed of a picture, for randomizations that must be independent of it and of each
// other.
#pragma once
#include <cstdint>

#include "../../kernels/physics/hash.h"

namespace phalanx {

enum class SeedUse { kReplicate = 1, kPilot = 2, kReference = 3, kRun = 4 };

/// Seed number `index` for `use`. Two of n such seeds, or one and that of a picture, are equal with a
/// probability of about n^2 / 2^33.
inline int derived_seed(int seed, SeedUse use, int index) {
  const uint32 domain = hash32(0x5bd1e995u + static_cast<uint32>(use));
  return static_cast<int>(
      hash32(hash32(hash32(static_cast<uint32>(seed) + domain) + static_cast<uint32>(index))) & 0x7fffffffu);
}

}  // namespace phalanx
