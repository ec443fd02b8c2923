// "sampler" and "integrator": how many samples, how long a path.
#include <climits>

#include "read_scene.h"
#include "sampler_names.h"

namespace phalanx {

namespace {
constexpr int kMaxSamples = 1 << 30;
constexpr int kMaxDepth = 10'000'000;

/// "light_choice", "light_points".
void read_light_sampling(ObjectReader &object, IntegratorDescription &integrator) {
  const auto value = [](auto choice) { return static_cast<int>(choice); };
  int choice = value(integrator.light_choice), points = value(integrator.light_points);
  object.choice("light_choice",
                {{"auto", value(LightChoice::kAuto)},
                 {"power", value(LightChoice::kPower)},
                 {"uniform", value(LightChoice::kUniform)},
                 {"tree", value(LightChoice::kTree)}},
                choice);
  object.choice("light_points",
                {{"area", value(LightPoints::kArea)}, {"solid_angle", value(LightPoints::kSolidAngle)}},
                points);
  integrator.light_choice = static_cast<LightChoice>(choice);
  integrator.light_points = static_cast<LightPoints>(points);
}

}  // namespace

SamplerDescription read_sampler(const Node &node, Source &source) {
  SamplerDescription sampler;
  ObjectReader object(node, source);
  int kind = sampler.kind;
  std::vector<Choice> kinds;
  for (const auto &[name, k] : kSamplerNames) kinds.push_back({name, k});
  object.choice("type", kinds, kind);
  sampler.kind = static_cast<SamplerKind>(kind);
  object.integer("spp", 1, kMaxSamples, sampler.spp);
  object.integer("seed", 0, INT_MAX, sampler.seed);
  object.finish("sampler");
  const bool is_power_of_two = (sampler.spp & (sampler.spp - 1)) == 0;
  const bool is_sobol = sampler.kind == kSobolSampler || sampler.kind == kBlueNoiseSampler;
  if (object.ok() && is_sobol && !is_power_of_two) {
    source.warn(node, "spp " + std::to_string(sampler.spp) +
                          " is not a power of two, with which Sobol points have the least error");
  }
  return sampler;
}

IntegratorDescription read_integrator(const Node &node, Source &source) {
  IntegratorDescription integrator;
  ObjectReader object(node, source);
  constexpr int kDirect = -1;  // a path of one scattering event
  int type = kPathIntegrator;
  object.choice("type",
                {{"path", kPathIntegrator},
                 {"direct", kDirect},
                 {"ambient_occlusion", kAmbientOcclusion},
                 {"normal", kViewNormal},
                 {"albedo", kViewAlbedo},
                 {"uv", kViewUv},
                 {"material", kViewMaterial}},
                type);
  if (type == kDirect) {
    integrator.max_depth = 1;
  } else {
    integrator.kind = static_cast<IntegratorKind>(type);
  }
  if (type == kPathIntegrator) {
    object.integer("max_depth", 0, kMaxDepth, integrator.max_depth);
    object.integer("roulette_depth", 0, kMaxDepth, integrator.roulette_depth);
  }
  if (type == kAmbientOcclusion) object.number("distance", kLength, integrator.distance);
  if (integrator.kind == kPathIntegrator) read_light_sampling(object, integrator);
  object.finish("integrator");
  return integrator;
}

}  // namespace phalanx
