// Solid noise: functions of a point that look random and are smooth, with the same bits everywhere.
#pragma once
#include "hash.h"
#include "vec.h"

PHALANX_BEGIN

/// A coordinate as cell and place in the cell, in [0, 1). Beyond 2^23, where floats have no fraction, and
/// for NaN: the origin.
struct LatticePlace {
  int32 cell;
  float t;
};

PHYS LatticePlace lattice_place(float x) {
  const float safe = abs_of(x) < 8388608.0f ? x : 0.0f;
  const float cell = round_down(safe);
  LatticePlace p;
  p.cell = to_int(cell);
  p.t = safe - cell;
  return p;
}

/// Product of the point with one of the twelve directions to the middles of a cube's edges (Perlin 2002).
PHYS float lattice_slope(uint32 hash, float x, float y, float z) {
  const int32 h = (int32)(hash & 15u);
  const float u = h < 8 ? x : y;
  const float v = h < 4 ? y : ((h == 12 || h == 14) ? x : z);
  return ((h & 1) != 0 ? -u : u) + ((h & 2) != 0 ? -v : v);
}

/// 6 t^5 - 15 t^4 + 10 t^3: from 0 to 1 with two derivatives that vanish at both ends.
PHYS float smooth_step(float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }

PHYS float mix(float a, float b, float t) { return a + (b - a) * t; }

/// Gradient noise: 0 at lattice points, in [-1.04, 1.04] between, with two continuous derivatives.
/// K. Perlin, "Improving Noise" (SIGGRAPH 2002), with a hash instead of his permutation table.
PHYS float gradient_noise(Vec3 p) {
  const LatticePlace x = lattice_place(p.x);
  const LatticePlace y = lattice_place(p.y);
  const LatticePlace z = lattice_place(p.z);
  const float v = smooth_step(y.t);
  const float w = smooth_step(z.t);
  float layer[2];
  for (UNI int32 k = 0; k < 2; k++) {
    const uint32 hash_z = hash32((uint32)z.cell + (uint32)k);
    const float tz = z.t - (float)k;
    float row[2];
    for (UNI int32 j = 0; j < 2; j++) {
      const uint32 hash_y = hash32((uint32)y.cell + (uint32)j + hash_z);
      const float ty = y.t - (float)j;
      const float a = lattice_slope(hash32((uint32)x.cell + hash_y), x.t, ty, tz);
      const float b = lattice_slope(hash32((uint32)x.cell + 1u + hash_y), x.t - 1.0f, ty, tz);
      row[j] = mix(a, b, smooth_step(x.t));
    }
    layer[k] = mix(row[0], row[1], v);
  }
  return mix(layer[0], layer[1], w);
}

/// Sum of `octaves` noises, each twice as fine and half as high as the one before and shifted, so that
/// their zeros do not coincide; divided by the sum of the heights: in [-1.04, 1.04]. With `folded` the
/// absolute values are added: Perlin's turbulence, in [0, 1.04]. octaves < 1 give 0.
PHYS float fractal_noise(Vec3 p, int32 octaves, bool folded) {
  Vec3 q = p;
  float sum = 0.0f;
  float height = 1.0f;
  float heights = 0.0f;
  for (int32 i = 0; i < octaves; i++) {
    const float noise = gradient_noise(q);
    sum = sum + height * (folded ? abs_of(noise) : noise);
    heights = heights + height;
    height = height * 0.5f;
    q = q * 2.0f + vec3(0.37f, 0.71f, 0.19f);
  }
  return heights > 0.0f ? sum / heights : 0.0f;
}

PHALANX_END
