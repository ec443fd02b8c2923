// What kernels read and write: the columns of a wave of paths, and the tile it samples.
//
// A wave is a structure of arrays with one slot per path. Slots stay where they are; lists of slot
// numbers say which paths a stage works on. Columns that the plan does not need are one gang long.
#pragma once
#include "scene_view.h"

PHALANX_BEGIN

/// All arrays have [capacity] elements, padded to the widest gang, 64-byte aligned.
struct WaveView {
  int32 capacity;
  // Path state (estimator.h: PathState); written by generate and shade.
  UNI float *UNI origin_x, *UNI origin_y, *UNI origin_z;
  UNI float *UNI direction_x, *UNI direction_y, *UNI direction_z;
  UNI float *UNI throughput_r, *UNI throughput_g, *UNI throughput_b;
  UNI float *UNI pdf;
  UNI int32 *UNI depth;            // negative: the slot is free
  UNI int32 *UNI scramble;
  UNI int32 *UNI block_index;      // the path's sample in TileView::radiance
  // Hits; written by intersect.
  UNI int32 *UNI hit_geometry, *UNI hit_primitive;
  UNI int32 *UNI hit_kind;         // MaterialKind, or kEscaped
  UNI int32 *UNI hit_instance;     // only with instances
  UNI int32 *UNI hit_far_root;     // only with spheres
  UNI int32 *UNI hit_material;     // only with blends: Hit::material; written by resolve
  UNI float *UNI hit_u;            // only with curves: Hit::u
  // Shadow rays, in the slot of their path; only with lights. Written by shade.
  UNI float *UNI shadow_origin_x, *UNI shadow_origin_y, *UNI shadow_origin_z;
  UNI float *UNI shadow_direction_x, *UNI shadow_direction_y, *UNI shadow_direction_z;
  UNI float *UNI shadow_distance;
  UNI float *UNI shadow_r, *UNI shadow_g, *UNI shadow_b;
  // Lists of slots.
  UNI int32 *UNI active;           // paths that go on, ascending; written by compact
  UNI int32 *UNI free;             // slots without a path, ascending; written by compact
  UNI int32 *UNI order;            // all paths, by material kind; written by bucket
  UNI int32 *UNI shadow_list;      // paths with a shadow ray; only with lights; written by shade
};

/// The samples that a wave draws: all pixels of a tile, 2^log2_samples samples of each.
struct TileView {
  const UNI int32 *UNI pixels;     // [num_pixels] x | y << 16 of the full picture
  int32 num_pixels;
  int32 log2_samples;
  int32 first_sample;              // number of sample 0 of this pass in its pixel
  int32 num_samples;               // num_pixels << log2_samples
  // [num_samples * 3] radiance; the samples of a pixel are consecutive.
  UNI float *UNI radiance;
  // [num_samples * 7] albedo, normal, depth of first hits; only with AOVs.
  UNI float *UNI aov;
};

#define PHALANX_AOV_FLOATS 7

/// x and y of a sample's pixel, and its number there.
struct TileSample {
  int32 x, y, sample;
};

PHYS TileSample tile_sample(const UNI TileView &tile, int32 block_index) {
  const int32 xy = tile.pixels[block_index >> tile.log2_samples];
  TileSample at;
  at.x = xy & 0xffff;
  at.y = (xy >> 16) & 0xffff;
  at.sample = tile.first_sample + (block_index & ((1 << tile.log2_samples) - 1));
  return at;
}

PHALANX_END
