// Measured optical constants of metals, for conductors given by name.
#pragma once
#include <vector>

#include "description.h"

namespace phalanx {

/// Complex index of refraction eta + i k at the dominant wavelengths of the sRGB primaries: 611.4,
/// 549.1 and 464.2 nm.
struct Metal {
  const char *name;
  Double3 eta, k;
};

/// aluminium, chromium, copper, gold, iron, nickel, silver, titanium.
const std::vector<Metal> &metals();

}  // namespace phalanx
