// The twins of functions.h over columns of numbers: value k of input c stands at [c * n + k].
#include "functions.h"
#include "gang.isph"

#define TWIN_EXPORT(name, floats, ints, results)                                                \
  export void KERNEL(twin_##name)(                                                              \
      const uniform SceneView *uniform scene, const uniform FrameView *uniform frame,           \
      const uniform float *uniform f, const uniform int32 *uniform i, uniform float *uniform r, \
      uniform int32 n) {                                                                        \
    foreach (k = 0 ... n) {                                                                     \
      TwinIn in_;                                                                               \
      for (uniform int32 c = 0; c < floats; c++) in_.f[c] = f[c * n + k];                       \
      for (uniform int32 c = 0; c < ints; c++) in_.i[c] = i[c * n + k];                         \
      const TwinOut out = twin_##name(*scene, *frame, in_);                                     \
      for (uniform int32 c = 0; c < results; c++) r[c * n + k] = out.f[c];                      \
    }                                                                                           \
  }
TWIN_LIST(TWIN_EXPORT)
