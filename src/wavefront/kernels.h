// The kernels of one instruction set, as a table of functions.
//
// kernels/*.ispc and src/reference/*.cpp are compiled once per instruction set; the program picks a
// table at run time, so one binary serves sse4, avx2 and avx512skx.
#pragma once
#include <cstdint>
#include <string>

#include "../../kernels/path_view.h"
#include "../core/stats.h"

namespace phalanx {

struct Kernels {
  const char *isa;
  int width;  // lanes of a gang

  // Stages of the wavefront, in the order of its loop; see the .ispc file of that name.
  void (*generate)(const FrameView &, const TileView &, const WaveView &, const int32 *slots,
                   int32 first_index, int32 count);
  void (*intersect)(const SceneView &, const WaveView &, const int32 *slots, int32 count,
                    int32 coherent);
  void (*aov)(const SceneView &, const TileView &, const WaveView &, const int32 *slots,
              int32 count);
  void (*bucket)(const WaveView &, int32 num_slots, int32 *counts);
  int32 (*shade[kNumMaterialKinds])(const SceneView &, const FrameView &, const TileView &,
                                    const WaveView &, const int32 *slots, int32 count,
                                    int32 num_shadow);
  void (*shade_escaped)(const SceneView &, const TileView &, const WaveView &, const int32 *slots,
                        int32 count);
  void (*shadow)(const SceneView &, const TileView &, const WaveView &, const int32 *slots,
                 int32 count, int32 coherent);
  int32 (*compact)(const WaveView &);

  // The other schedules: all samples of a tile.
  void (*megakernel)(const SceneView &, const FrameView &, const TileView &, std::int64_t *counts);
  void (*depth_first)(const SceneView &, const FrameView &, const TileView &, RayCounts &);
  void (*recursive)(const SceneView &, const FrameView &, const TileView &, RayCounts &);
};

const Kernels &kernels_sse4();
const Kernels &kernels_avx2();
const Kernels &kernels_avx512skx();

}  // namespace phalanx
