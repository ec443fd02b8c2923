// Random numbers as functions: every number is determined by (seed, pixel, sample, dimension).
//
// Nothing depends on threads, ranks, wave size or the order in which paths are computed. Dimensions
// come in pairs. For most samplers every pair is a set of points in the unit square of its own ("padding");
// Halton's has true dimensions.
#pragma once
#include "sampler_blue_noise.h"
#include "sampler_halton.h"
#include "sampler_sobol.h"
#include "sampler_stratified.h"

PHALANX_BEGIN

/// What distinguishes the sequences of one pixel from those of all others. x is hashed before it is
/// added: else two rows whose hashes are close would share the scrambles of most of their pixels.
/// The constant keeps x and y apart: else pixel (x, y) of seed 0 would be pixel (y, x).
PHYS uint32 pixel_scramble(int32 x, int32 y, int32 seed) {
  return hash32(hash32((uint32)x + 0x9e3779b9u) + hash32((uint32)y + hash32((uint32)seed)));
}

/// What sample_pair wants to know of pixel (x, y): its scramble, or its place on the z-curve.
PHYS uint32 pixel_scramble(const UNI FrameView &frame, int32 x, int32 y) {
  if (frame.sampler == kBlueNoiseSampler) return morton_code(x, y);
  return pixel_scramble(x, y, frame.seed);
}

PHYS Vec2 independent_pair(uint32 h, int32 index) {
  const uint32 r = hash32(h + hash32((uint32)index));
  return vec2(unit_float(r), unit_float(hash32(r + 0x68bc21ebu)));
}

/// The samplers that are not worth being part of every kernel.
PHYS_CALL Vec2 rare_pair(const UNI FrameView &frame, uint32 scramble, uint32 h, int32 index,
                         int32 dimension) {
  if (frame.sampler == kStratifiedSampler) return stratified_pair(frame, h, index);
  if (frame.sampler == kBlueNoiseSampler)
    return blue_noise_pair(frame, scramble, index, dimension);
  if (2 * dimension + 1 >= PHALANX_NUM_PRIMES) return independent_pair(h, index);
  return halton_pair(frame, h, index, dimension);
}

/// Two uniform numbers in [0,1): pair `dimension` of sample `index` (>= 0) of a pixel. `scramble`:
/// pixel_scramble(). Stratified, blue-noise and Halton samples count on frame.spp samples a pixel.
PHYS Vec2 sample_pair(const UNI FrameView &frame, uint32 scramble, int32 index, int32 dimension) {
  const uint32 h = hash32(scramble + 0x9e3779b9u * (uint32)(dimension + 1));
  if (frame.sampler == kSobolSampler) return sobol_pair(h, index);
  if (frame.sampler == kIndependentSampler) return independent_pair(h, index);
  return rare_pair(frame, scramble, h, index, dimension);
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
