// Fills the table of one instruction set (PHALANX_ISA) from the headers that ISPC generates, so that
// the compiler checks every signature.
#include "kernels.h"
#include "../reference/schedules.h"

// The generated headers repeat the shared structs in namespace ispc; ours take their place.
#define __ISPC_STRUCT_Vec2__
#define __ISPC_STRUCT_Vec3__
#define __ISPC_STRUCT_Affine__
#define __ISPC_STRUCT_Material__
#define __ISPC_STRUCT_Geometry__
#define __ISPC_STRUCT_Triangle__
#define __ISPC_STRUCT_Quad__
#define __ISPC_STRUCT_Sphere__
#define __ISPC_STRUCT_Disk__
#define __ISPC_STRUCT_Instance__
#define __ISPC_STRUCT_Motion__
#define __ISPC_STRUCT_Texture__
#define __ISPC_STRUCT_Light__
#define __ISPC_STRUCT_LightNode__
#define __ISPC_STRUCT_LightProfile__
#define __ISPC_STRUCT_SceneView__
#define __ISPC_STRUCT_Camera__
#define __ISPC_STRUCT_FrameView__
#define __ISPC_STRUCT_WaveView__
#define __ISPC_STRUCT_TileView__
namespace ispc {
using phalanx::FrameView;
using phalanx::SceneView;
using phalanx::TileView;
using phalanx::WaveView;
}  // namespace ispc

#include "aov_ispc.h"
#include "bucket_ispc.h"
#include "compact_ispc.h"
#include "escaped_ispc.h"
#include "generate_ispc.h"
#include "intersect_ispc.h"
#include "megakernel_ispc.h"
#include "resolve_ispc.h"
#include "shade_hair_ispc.h"
#include "shade_interface_ispc.h"
#include "shade_ispc.h"
#include "shade_principled_ispc.h"
#include "shade_rich_basic_ispc.h"
#include "shade_rough_ispc.h"
#include "shade_view_ispc.h"
#include "shadow_ispc.h"

#define PHALANX_CAT2(a, b) a##_##b
#define PHALANX_CAT(a, b) PHALANX_CAT2(a, b)
#define KERNEL(name) ispc::PHALANX_CAT(name, PHALANX_ISA)
#define PHALANX_STRING2(a) #a
#define PHALANX_STRING(a) PHALANX_STRING2(a)

namespace phalanx {

const Kernels &PHALANX_CAT(kernels, PHALANX_ISA)() {
  static const Kernels table = {
      PHALANX_STRING(PHALANX_ISA),
      PHALANX_WIDTH,
      KERNEL(generate),
      KERNEL(intersect),
      KERNEL(aov),
      KERNEL(bucket),
      {
#define PHALANX_KIND(constant, name, density, transmits) KERNEL(shade_##name),
          PHALANX_BASIC_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
      },
      KERNEL(shade_escaped),
      KERNEL(shadow),
      KERNEL(compact),
      KERNEL(resolve),
      KERNEL(aov_rich),
      {
#define PHALANX_KIND(constant, name, density, transmits) KERNEL(shade_##name##_rich),
          PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
      },
      KERNEL(shade_view),
      KERNEL(shade_escaped_rich),
      KERNEL(megakernel),
      KERNEL(megakernel_rich),
      PHALANX_CAT(render_depth_first, PHALANX_ISA),
      PHALANX_CAT(render_recursive, PHALANX_ISA),
      PHALANX_CAT(replay, PHALANX_ISA),
  };
  return table;
}

}  // namespace phalanx
