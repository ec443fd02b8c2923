// The colour spaces of FLIP. All conversions start from linear sRGB primaries, white D65.
#pragma once
#include "../../kernels/physics/vec.h"

namespace phalanx {

/// Opponent space in which human contrast sensitivity is known: achromatic, red-green, blue-yellow.
Vec3 ycxcz_from_linear(Vec3 rgb);
Vec3 linear_from_ycxcz(Vec3 ycxcz);

/// CIELab with the Hunt effect: colours of dark pixels are less colourful.
Vec3 hunt_lab_from_linear(Vec3 rgb);

/// Distance of two Lab colours that are far apart (Abasi et al. 2020).
float hyab(Vec3 a, Vec3 b);

/// The ACES film curve as fitted by Narkowicz 2015 with his exposure of 0.6; result in [0, 1].
Vec3 aces_tone_map(Vec3 rgb);
/// The x > 0 that aces_tone_map takes to t, for t < 1.
double aces_inverse(double t);

}  // namespace phalanx
