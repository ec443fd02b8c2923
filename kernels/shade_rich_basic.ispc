// Shade kernels of the basic kinds with everything that a scene can have.
#include "shade.isph"

#define PHALANX_KIND(constant, name, density, transmits) \
  SHADE_KERNEL(shade_##name##_rich, shade<constant, kRich>)
PHALANX_BASIC_KINDS(PHALANX_KIND)
