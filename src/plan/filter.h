// Reconstruction filters as tables for importance sampling.
#pragma once
#include <vector>

#include "../scene/description.h"

namespace phalanx {

/// [PHALANX_FILTER_CELLS + 1] offsets in pixels from the pixel's centre: the inverse of the 1-D
/// distribution function of the (separable) filter at equal steps, first -radius, last +radius.
/// Box: uniform. Gaussian: exp(-x^2 / 2 sigma^2) cut at the radius. Blackman-Harris: the 4-term
/// window (Harris 1978) over [-radius, radius].
std::vector<float> filter_offsets(const FilmDescription &film);

}  // namespace phalanx
