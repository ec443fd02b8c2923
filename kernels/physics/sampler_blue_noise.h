// Sobol points dealt out to the pixels along a scrambled z-curve (Ahmed and Wonka, "Screen-Space Blue-Noise
// Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels", SIGGRAPH Asia 2020).
//
// The whole picture shares one sequence: pixel k of the z-curve has its samples k * 2^m to (k + 1) * 2^m - 1,
// 2^m the samples per pixel. So not only the samples of a pixel are a net, but those of every aligned block
// of 2^j x 2^j pixels, and errors cancel between neighbours: noise of high frequency. Scrambling the order
// hides the curve and keeps the blocks.
#pragma once
#include "../scene_view.h"
#include "sampler_sobol.h"

PHALANX_BEGIN

/// Bits of x at the even places.
PHYS uint32 spread_bits(uint32 x) {
  x = (x | (x << 8)) & 0x00ff00ffu;
  x = (x | (x << 4)) & 0x0f0f0f0fu;
  x = (x | (x << 2)) & 0x33333333u;
  x = (x | (x << 1)) & 0x55555555u;
  return x;
}

/// Place of pixel (x, y) along the z-curve; 0 <= x, y < 65536.
PHYS uint32 morton_code(int32 x, int32 y) {
  return spread_bits((uint32)x) | (spread_bits((uint32)y) << 1);
}

/// Bits of an index into the shared sequence; at most 32 are possible.
PHYS int32 blue_noise_bits(int32 width, int32 height, int32 spp) {
  return 2 * log2_ceil(width > height ? width : height) + log2_ceil(spp);
}

/// Owen's scramble in base 4: digits of two bits, most significant first, are permuted depending on those
/// before. Base 2 alone knows 8 of the 24 permutations of a digit, and would never put 0 and 1 (pixels
/// side by side) into different halves when it puts 0 and 2 there. So in 11 of 16 digits,
/// chosen by bits before, it is 2 and 3 that change places in between: all three ways to pair the four
/// pixels of a block are about as likely.
PHYS uint32 scramble_base4(uint32 index, uint32 seed) {
  uint32 x = scramble_reversed(reverse_bits(index), seed);
  const uint32 chosen = (x << 1) | ((x << 2) & ((x << 3) | (x << 4)));
  x = x ^ ((x >> 1) & chosen & 0x55555555u);
  return reverse_bits(scramble_reversed(x, hash32(seed)));
}

/// Pair `dimension` of sample `index` of the pixel with this Morton code. Samples from 2^m on are of
/// further sequences.
PHYS Vec2 blue_noise_pair(const UNI FrameView &frame, uint32 morton, int32 index,
                          int32 dimension) {
  const uint32 m = (uint32)log2_ceil(frame.spp);
  const uint32 sequence = (uint32)index >> m;
  const int32 picture = frame.seed;
  const uint32 seed = hash32((uint32)picture + 0x85ebca6bu) + hash32(sequence);
  const uint32 h = hash32(seed + 0x9e3779b9u * (uint32)(dimension + 1));
  const uint32 place = (morton << m) | ((uint32)index & ((1u << m) - 1u));
  // With an odd m the last digit has one bit.
  const uint32 odd = m & 1u;
  uint32 shuffled = scramble_base4(place >> odd, h);
  if (odd != 0u) shuffled = (shuffled << 1) | ((place ^ hash32(shuffled + h)) & 1u);
  return scrambled_sobol(shuffled, hash32(h + 0x68bc21ebu));
}

PHALANX_END
