// "sampler" and "integrator": how many samples, how long a path.
#include <climits>

#include "read_scene.h"

namespace phalanx {

namespace {
constexpr int kMaxSamples = 1 << 30;
constexpr int kMaxDepth = 10'000'000;
}  // namespace

SamplerDescription read_sampler(const Node &node, Source &source) {
  SamplerDescription sampler;
  ObjectReader object(node, source);
  int kind = sampler.kind;
  object.choice("type", {{"sobol", kSobolSampler}, {"independent", kIndependentSampler}}, kind);
  sampler.kind = static_cast<SamplerKind>(kind);
  object.integer("spp", 1, kMaxSamples, sampler.spp);
  object.integer("seed", 0, INT_MAX, sampler.seed);
  object.finish("sampler");
  const bool is_power_of_two = (sampler.spp & (sampler.spp - 1)) == 0;
  if (object.ok() && sampler.kind == kSobolSampler && !is_power_of_two) {
    source.warn(node, "spp " + std::to_string(sampler.spp) +
                          " is not a power of two, with which Sobol points have the least error");
  }
  return sampler;
}

IntegratorDescription read_integrator(const Node &node, Source &source) {
  IntegratorDescription integrator;
  ObjectReader object(node, source);
  int type = 0;
  object.choice("type", {{"path", 0}}, type);
  object.integer("max_depth", 0, kMaxDepth, integrator.max_depth);
  object.integer("roulette_depth", 0, kMaxDepth, integrator.roulette_depth);
  object.finish("integrator");
  return integrator;
}

}  // namespace phalanx
