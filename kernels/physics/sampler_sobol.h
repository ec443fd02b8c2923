// Owen-scrambled Sobol points by hashing (Burley, "Practical Hash-based Owen Scrambling", JCGT 9:4, 2020),
// the hash by Laine and Karras with Vegdahl's constants. The second dimension is a Pascal matrix, applied as
// five masked shifts (Ahmed, "An Implementation Algorithm of 2D Sobol Sequence Fast, Elegant, and Compact",
// EGSR 2024).
#pragma once
#include "hash.h"
#include "vec.h"

PHALANX_BEGIN

/// Bit-reversed second coordinate of Sobol point `index`; the bit-reversed first one is `index`.
PHYS uint32 sobol_second_reversed(uint32 index) {
  uint32 x = index;
  x = x ^ ((x & 0xffff0000u) >> 16);
  x = x ^ ((x & 0xff00ff00u) >> 8);
  x = x ^ ((x & 0xf0f0f0f0u) >> 4);
  x = x ^ ((x & 0xccccccccu) >> 2);
  x = x ^ ((x & 0xaaaaaaaau) >> 1);
  return x;
}

/// Point `index` of the Sobol sequence with both coordinates scrambled, in [0,1).
PHYS Vec2 scrambled_sobol(uint32 index, uint32 seed) {
  const uint32 first = reverse_bits(scramble_reversed(index, seed));
  const uint32 second =
      reverse_bits(scramble_reversed(sobol_second_reversed(index), seed * 0x2c1b3c6du + 1u));
  return vec2(unit_float(first), unit_float(second));
}

/// Any 2^m consecutive samples starting at a multiple of 2^m are stratified in every elementary interval of
/// area 2^-m. The order of the samples is scrambled, too: else pairs of dimensions would go through their
/// squares together.
PHYS Vec2 sobol_pair(uint32 h, int32 index) {
  const uint32 shuffled = reverse_bits(scramble_reversed(reverse_bits((uint32)index), h));
  return scrambled_sobol(shuffled, hash32(h + 0x68bc21ebu));
}

PHALANX_END
