// Permutations by hashing: nothing is stored.
#pragma once
#include "hash.h"

PHALANX_BEGIN

/// Element i of a permutation of [0, n), 0 <= i < n <= 2^30, chosen by `seed`: steps that each
/// permute [0, 2^m), some towards higher bits, some towards lower ones, repeated until they land below n.
/// (Kensler's hash for this knows only 8 permutations of four elements.) With 5 rounds all permutations of
/// a few elements, and all pairs of places for two of many, are about as likely.
template <int Rounds>
PHYS int32 permuted(int32 i, int32 n, uint32 seed) {
  const int32 bits = log2_ceil(n);
  const uint32 mask = (1u << (uint32)bits) - 1u;
  const uint32 half = (uint32)((bits + 1) >> 1);
  uint32 x = (uint32)i;
  do {
    uint32 key = seed;
    for (UNI int32 k = 0; k < Rounds; k++) {
      key = hash32(key + 0x9e3779b9u);
      x = (x + key) & mask;
      x = x ^ ((x >> 1) & (key >> 5));
      x = (x * ((key >> 16) | 1u)) & mask;
      x = x ^ (x >> half);
    }
  } while ((int32)x >= n);
  return (int32)x;
}

PHALANX_END
