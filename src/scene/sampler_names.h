// Names of samplers, in scene files and on the command line.
#pragma once
#include <array>
#include <utility>

#include "description.h"

namespace phalanx {

inline constexpr std::array<std::pair<const char *, SamplerKind>, 5> kSamplerNames = {{
    {"sobol", kSobolSampler},
    {"independent", kIndependentSampler},
    {"stratified", kStratifiedSampler},
    {"halton", kHaltonSampler},
    {"blue_noise", kBlueNoiseSampler},
}};

inline const char *sampler_name(int kind) {
  for (const auto &[name, k] : kSamplerNames)
    if (k == kind) return name;
  return "?";
}

}  // namespace phalanx
