// Sizes and offsets of the shared structs as ISPC sees them, for tests/twin/test_layout.cpp.
#include "path_view.h"

#define OFFSET(type, field) ((int32)((uniform int64)(&((uniform type * uniform)NULL)->field)))

/// Writes up to 64 numbers and returns how many. The C++ list in tests/twin has the same order.
export uniform int32 PHALANX_LAYOUT(uniform int32 values[]) {
  uniform int32 n = 0;
  values[n++] = sizeof(uniform Material);
  values[n++] = sizeof(uniform Geometry);
  values[n++] = sizeof(uniform Triangle);
  values[n++] = sizeof(uniform Quad);
  values[n++] = sizeof(uniform Sphere);
  values[n++] = sizeof(uniform Disk);
  values[n++] = sizeof(uniform Instance);
  values[n++] = sizeof(uniform Light);
  values[n++] = sizeof(uniform SceneView);
  values[n++] = sizeof(uniform Camera);
  values[n++] = sizeof(uniform FrameView);
  values[n++] = sizeof(uniform WaveView);
  values[n++] = sizeof(uniform TileView);
  return n;
}
