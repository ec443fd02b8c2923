// Shade kernels: hair.
#include "shade.isph"

SHADE_KERNEL(shade_hair_rich, shade<kHair, kRich>)
