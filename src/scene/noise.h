// Gradient noise from a hash: the same bits on every machine.
#pragma once
#include <cstdint>

#include "description.h"

namespace phalanx {

/// Gradient noise in three dimensions: 0 at lattice points, in [-1.04, 1.04] between, with two
/// continuous derivatives. K. Perlin, "Improving Noise" (SIGGRAPH 2002), with a hash instead of his
/// permutation table. Beyond 1e15, where a double has no fraction left, 0.
double gradient_noise(Double3 p, std::uint32_t seed);

/// Sum of `octaves` noises, each twice as fine and half as high as the one before and shifted so
/// that their zeros do not coincide; divided by the sum of the heights, so in about [-1,1].
double fractal_noise(Double3 p, int octaves, std::uint32_t seed);

}  // namespace phalanx
