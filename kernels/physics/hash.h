// Hashes of whole numbers, and what becomes of them: uniform floats, Owen scrambles, permutations.
#pragma once
#include "lang.h"

PHALANX_BEGIN

/// A well-mixed 32-bit permutation (Wellons' lowbias32).
PHYS uint32 hash32(uint32 x) {
  x = x ^ (x >> 16);
  x = x * 0x7feb352du;
  x = x ^ (x >> 15);
  x = x * 0x846ca68bu;
  x = x ^ (x >> 16);
  return x;
}

PHYS uint32 reverse_bits(uint32 x) {
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  x = ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
  return x;
}

/// Owen's nested uniform scramble, acting on bit-reversed numbers: bit i of the result depends on
/// the bits below i only.
PHYS uint32 scramble_reversed(uint32 x, uint32 seed) {
  x = x ^ (x * 0x3d20adeau);
  x = x + seed;
  x = x * ((seed >> 16) | 1u);
  x = x ^ (x * 0x05526c56u);
  x = x ^ (x * 0x53a22864u);
  return x;
}

/// The upper 24 bits as a float in [0, 1 - 2^-24]: never 1.
PHYS float unit_float(uint32 x) { return to_float((int32)(x >> 8)) * 5.9604644775390625e-8f; }

/// The largest float below 1, where rounding has given 1.
PHYS float below_one(float u) { return min_of(u, 0.999999940395355225f); }

/// a / b of whole numbers, 0 <= a <= 2^30, 0 < b < 2^21. Vectors have no integer division, and a zero in a
/// dead lane would trap: a quotient of floats, corrected by that of the remainder.
PHYS int32 quotient(int32 a, int32 b) {
  const float inverse = 1.0f / to_float(b);
  const int32 about = to_int(to_float(a) * inverse);
  const int32 rest = a - about * b;
  return about + to_int(round_down((to_float(rest) + 0.5f) * inverse));
}

/// Smallest k with 2^k >= n; 0 for n < 2. n <= 2^30.
PHYS int32 log2_ceil(int32 n) {
  if (n < 2) return 0;
  const int32 k = (bits_from_float(to_float(n)) >> 23) - 127;
  return (1 << (uint32)k) < n ? k + 1 : k;
}

PHALANX_END
