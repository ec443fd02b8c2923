// Random numbers as functions: every number is determined by (seed, pixel, sample, dimension).
//
// Nothing depends on threads, ranks, wave size or the order in which paths are computed. Dimensions
// come in pairs, and every pair is its own randomised (0,2)-sequence ("padding"):
// Owen-scrambled Sobol points by hashing (Burley, "Practical Hash-based Owen Scrambling", JCGT 9:4,
// 2020), the hash by Laine and Karras with Vegdahl's constants. The second Sobol dimension is a
// Pascal matrix, applied as five masked shifts (Ahmed, "An Implementation Algorithm of 2D Sobol
// Sequence Fast, Elegant, and Compact", EGSR 2024).
#pragma once
#include "../scene_view.h"

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

/// The upper 24 bits as a float in [0, 1 - 2^-24]: never 1.
PHYS float unit_float(uint32 x) { return to_float((int32)(x >> 8)) * 5.9604644775390625e-8f; }

/// What distinguishes the sequences of one pixel from those of all others. x is hashed before it is
/// added: else two rows whose hashes are close would share the scrambles of most of their pixels.
/// The constant keeps x and y apart: else pixel (x, y) of seed 0 would be pixel (y, x).
PHYS uint32 pixel_scramble(int32 x, int32 y, int32 seed) {
  return hash32(hash32((uint32)x + 0x9e3779b9u) + hash32((uint32)y + hash32((uint32)seed)));
}

/// Two uniform numbers in [0,1): pair `dimension` of sample `index` (>= 0) of a pixel.
/// For kSobolSampler any 2^m consecutive samples starting at a multiple of 2^m are stratified in
/// every elementary interval of area 2^-m.
PHYS Vec2 sample_pair(int32 sampler, uint32 scramble, int32 index, int32 dimension) {
  const uint32 h = hash32(scramble + 0x9e3779b9u * (uint32)(dimension + 1));
  if (sampler == kSobolSampler) {
    const uint32 shuffled = reverse_bits(scramble_reversed(reverse_bits((uint32)index), h));
    const uint32 h1 = hash32(h + 0x68bc21ebu);
    const uint32 first = reverse_bits(scramble_reversed(shuffled, h1));
    const uint32 second =
        reverse_bits(scramble_reversed(sobol_second_reversed(shuffled), h1 * 0x2c1b3c6du + 1u));
    return vec2(unit_float(first), unit_float(second));
  }
  const uint32 r = hash32(h + hash32((uint32)index));
  return vec2(unit_float(r), unit_float(hash32(r + 0x68bc21ebu)));
}

// Pairs of a path. Camera first, then kPairsPerVertex for every vertex.
#define PHALANX_PAIR_PIXEL 0
#define PHALANX_PAIR_LENS 1
#define PHALANX_PAIR_FIRST_VERTEX 2
#define PHALANX_PAIRS_PER_VERTEX 4
#define PHALANX_PAIR_BSDF 0        // direction
#define PHALANX_PAIR_LOBE 1        // x: lobe, y: Russian roulette
#define PHALANX_PAIR_LIGHT 2       // point on the light
#define PHALANX_PAIR_LIGHT_CHOICE 3

PHALANX_END
