// Shade kernels: interfaces of dielectrics, and coats.
#include "shade.isph"

SHADE_KERNEL(shade_rough_dielectric_rich, shade<kRoughDielectric, kRich>)
SHADE_KERNEL(shade_thin_dielectric_rich, shade<kThinDielectric, kRich>)
SHADE_KERNEL(shade_coated_rich, shade<kCoated, kRich>)
