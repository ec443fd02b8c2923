// Sizes and offsets of the shared structs as ISPC sees them, for test_layout.cpp.
#include "gang.isph"
#include "layout.h"

#define OFFSET_OF(type, field) \
  values[n++] = (uniform int32)(uniform int64)&(((uniform type * uniform) NULL)->field);
#define SIZE_OF(type) values[n++] = (uniform int32)sizeof(uniform type);

/// Writes at most LAYOUT_MAX numbers, in the order of LAYOUT_LIST, and returns how many.
export uniform int32 KERNEL(layout)(uniform int32 values[]) {
  uniform int32 n = 0;
  LAYOUT_LIST(OFFSET_OF, SIZE_OF)
  return n;
}
