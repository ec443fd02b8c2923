// Shade kernels: rough surfaces.
#include "shade.isph"

SHADE_KERNEL(shade_rough_diffuse_rich, shade<kRoughDiffuse, kRich>)
SHADE_KERNEL(shade_glossy_conductor_rich, shade<kGlossyConductor, kRich>)
SHADE_KERNEL(shade_phong_rich, shade<kPhong, kRich>)
SHADE_KERNEL(shade_blinn_phong_rich, shade<kBlinnPhong, kRich>)
