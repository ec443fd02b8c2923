// The sky of a clear or hazy day, computed from what the air is made of.
//
// Light of the sun scattered by air molecules and haze and absorbed by ozone, on a spherical earth (Nishita
// et al. 1993), seen from sea level. Scattering of higher order as in S. Hillaire, "A Scalable and
// Production Ready Sky and Atmosphere Rendering Technique" (EGSR 2020), whose molecules and ozone are used,
// too; three wavelengths (680, 550, 440 nm) stand for red, green and blue. Haze is given by turbidity: the
// optical thickness of molecules and haze over that of molecules (1 pure air, 2 very clear, 6 hazy, 10 mist).
//
// Radiance is in W sr^-1 m^-2 of light at 555 nm that looks as bright: 683 times its luminance is cd m^-2.
#pragma once
#include "description.h"
#include "environment_map.h"

namespace phalanx {

struct Sky {
  EnvironmentMap map;  // sky and ground. Its frame: y up, -z towards the sun's azimuth
  Double3 sun = {0, 0,
                 0};  // radiance of the sun's disc as seen through the air; black below the horizon
};

/// Any turbidity from 1 on, any direction of the sun. Takes about half a second.
Sky make_sky(const SkyDescription &description);

}  // namespace phalanx
