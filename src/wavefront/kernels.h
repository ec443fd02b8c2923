// The kernels of one instruction set, as a table of functions.
//
// kernels/*.ispc and src/reference/*.cpp are compiled once per instruction set; the program picks a
// table at run time, so one binary serves sse4, avx2 and avx512skx.
#pragma once
#include <cstdint>
#include <string>

#include "../../kernels/path_view.h"
#include "../core/stats.h"
#include "../reference/path_step.h"

namespace phalanx {

using SlotsKernel = void(const SceneView &, const TileView &, const WaveView &, const int32 *slots,
                         int32 count);
using ShadeKernel = int32(const SceneView &, const FrameView &, const TileView &, const WaveView &,
                          const int32 *slots, int32 count, int32 num_shadow);
using FrameKernel = void(const SceneView &, const FrameView &, const TileView &, const WaveView &,
                           const int32 *slots, int32 count);

struct Kernels {
  const char *isa;
  int width;  // lanes of a gang

  // Stages of the wavefront, in the order of its loop; see the .ispc file of that name.
  void (*generate)(const FrameView &, const TileView &, const WaveView &, const int32 *slots,
                   int32 first_index, int32 count);
  void (*intersect)(const SceneView &, const TileView &, const WaveView &, const int32 *slots,
                    int32 count, int32 order);
  SlotsKernel *aov;
  void (*bucket)(const WaveView &, int32 num_slots, const int32 *kinds, int32 num_kinds,
                 int32 *counts);
  ShadeKernel *shade[kNumBasicKinds];  // kPlain
  FrameKernel *shade_escaped;
  SlotsKernel *shadow;
  int32 (*compact)(const WaveView &);
  // kRich: with everything that a scene can have.
  FrameKernel *resolve;
  SlotsKernel *aov_rich;
  ShadeKernel *shade_rich[kNumMaterialKinds];
  ShadeKernel *shade_view;
  FrameKernel *shade_escaped_rich;

  // The other schedules: all samples of a tile.
  void (*megakernel)(const SceneView &, const FrameView &, const TileView &, std::int64_t *counts);
  void (*megakernel_rich)(const SceneView &, const FrameView &, const TileView &,
                          std::int64_t *counts);
  void (*depth_first)(const SceneView &, const FrameView &, const TileView &, RayCounts &,
                      int detail);
  void (*recursive)(const SceneView &, const FrameView &, const TileView &, RayCounts &,
                    int detail);
  Vec3 (*replay)(const SceneView &, const FrameView &, int32 x, int32 y, int32 sample, int detail,
                 PathSteps &);
};

const Kernels &kernels_sse4();
const Kernels &kernels_avx2();
const Kernels &kernels_avx512skx();

}  // namespace phalanx
