// Shade kernels: principled.
#include "shade.isph"

SHADE_KERNEL(shade_principled_rich, shade<kPrincipled, kRich>)
