// What tests of samplers share.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "../../kernels/physics/rng.h"
#include "statistics.h"

namespace phalanx::test {

inline constexpr SamplerKind kSamplers[] = {kSobolSampler, kIndependentSampler, kStratifiedSampler,
                                            kHaltonSampler, kBlueNoiseSampler};

/// A frame of `size` x `size` pixels with nothing but a sampler.
inline FrameView sampler_frame(SamplerKind kind, int spp = 64, int seed = 0, int size = 512) {
  FrameView frame = {};
  frame.sampler = kind;
  frame.spp = spp;
  frame.seed = seed;
  frame.width = frame.height = size;
  return frame;
}

/// Pair `dimension` of samples `first` to `first` + n - 1.
inline std::vector<Vec2> points(const FrameView &frame, uint32 scramble, int dimension, int first,
                                int n) {
  std::vector<Vec2> p;
  for (int i = 0; i < n; ++i) p.push_back(sample_pair(frame, scramble, first + i, dimension));
  return p;
}

/// True if the 2^m points have exactly one point in every elementary interval of area 2^-m, whatever its
/// shape.
inline bool is_net(const std::vector<Vec2> &points, int m) {
  std::vector<char> taken(points.size());
  for (int k = 0; k <= m; ++k) {
    std::fill(taken.begin(), taken.end(), 0);
    for (const Vec2 p : points) {
      const int column = static_cast<int>(std::ldexp(p.x, k));
      const int row = static_cast<int>(std::ldexp(p.y, m - k));
      char &cell = taken[static_cast<std::size_t>(column << (m - k) | row)];
      if (cell != 0) return false;
      cell = 1;
    }
  }
  return true;
}

/// p-value of the points being uniform in the unit square.
inline double chi_square_of(const std::vector<Vec2> &points, int cells) {
  Histogram histogram({cells, cells, 0, 1, 0, 1});
  for (const Vec2 p : points) histogram.add(static_cast<double>(p.x), static_cast<double>(p.y));
  const std::vector<double> masses(static_cast<std::size_t>(cells * cells), 1.0 / (cells * cells));
  return chi_square_fit(histogram, masses).p;
}

}  // namespace phalanx::test
