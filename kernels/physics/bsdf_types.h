// What every BSDF returns.
#pragma once
#include "../scene_view.h"

PHALANX_BEGIN

/// A sampled direction. weight = f cos / pdf, formed in one expression so that albedo 1 loses
/// nothing over many bounces. pdf: density of wi per solid angle; 0 marks a delta lobe, whose weight
/// already contains the probability of having chosen it. A black weight ends the path.
struct BsdfSample {
  Vec3 wi;
  Vec3 weight;
  float pdf;
};

/// f cos for a pair of directions, and the density with which sample_* would have drawn wi.
struct BsdfValue {
  Vec3 f_cos;
  float pdf;
};

PHYS BsdfSample no_sample() {
  BsdfSample s;
  s.wi = vec3(0.0f, 0.0f, 1.0f);
  s.weight = vec3(0.0f, 0.0f, 0.0f);
  s.pdf = 0.0f;
  return s;
}

PHYS BsdfValue no_value() {
  BsdfValue v;
  v.f_cos = vec3(0.0f, 0.0f, 0.0f);
  v.pdf = 0.0f;
  return v;
}

PHALANX_END
