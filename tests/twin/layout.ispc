// Sizes of the shared structs as ISPC sees them, for test_layout.cpp.
#include "gang.isph"

/// Writes up to 64 numbers and returns how many. The C++ list in tests/twin has the same order.
export uniform int32 KERNEL(layout)(uniform int32 values[]) {
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
