// Shade kernels of the basic kinds, for scenes without textures and the like.
#include "shade.isph"

#define PHALANX_KIND(constant, name, density, transmits) \
  SHADE_KERNEL(shade_##name, shade<constant, kPlain>)
PHALANX_BASIC_KINDS(PHALANX_KIND)
