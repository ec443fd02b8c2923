// Correlated multi-jittered samples (Kensler, "Correlated Multi-Jittered Sampling", Pixar technical memo
// 13-01, 2013): n samples, for any n, of which each coordinate has one in every 1/n (x: where n is a
// multiple of the number of columns), and each cell of a coarse grid has one. Offsets within the cells are
// shared along rows and columns, which spreads the points and helps edges.
#pragma once
#include "../scene_view.h"
#include "permutation.h"

PHALANX_BEGIN

#define PHALANX_MAX_STRATA 1048576

/// Sample `index` of frame.spp; those from frame.spp on are of further sets of as many.
PHYS Vec2 stratified_pair(const UNI FrameView &frame, uint32 h, int32 index) {
  int32 n = frame.spp;
  if (n < 1) n = 1;
  if (n > PHALANX_MAX_STRATA) n = PHALANX_MAX_STRATA;
  uint32 seed = h;
  int32 i = index;
  if (index >= n) {
    const int32 set = quotient(index, n);
    i = index - set * n;
    seed = hash32(h + (uint32)set);
  }
  const int32 columns = to_int(square_root(to_float(n)));
  const int32 rows = quotient(n + columns - 1, columns);
  const int32 s = permuted<5>(i, n, seed);
  const int32 row = quotient(s, columns);
  const int32 sx = permuted<5>(s - row * columns, columns, hash32(seed + 0x68bc21ebu));
  const int32 sy = permuted<5>(row, rows, hash32(seed + 0x02e5be93u));
  const uint32 jitter = hash32(hash32(seed + 0x967a889bu) + (uint32)s);
  const float jx = unit_float(jitter);
  const float jy = unit_float(hash32(jitter + 0x368cc8b7u));
  const float x = (to_float(sx) + (to_float(sy) + jx) / to_float(rows)) / to_float(columns);
  const float y = (to_float(s) + jy) / to_float(n);
  return vec2(below_one(x), below_one(y));
}

PHALANX_END
