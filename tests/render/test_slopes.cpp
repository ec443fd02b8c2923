// How relMSE falls with samples on a smooth scene: independent samples by the square root law, Sobol points faster.
#include <doctest/doctest.h>

#include <cmath>

#include "output/film_image.h"
#include "report/convergence.h"
#include "support/scenes.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

/// A floor under a bright sky, seen from above: one light sample and one bounce, no edge.
const char kFloor[] = R"({
  "version": 1,
  "camera": {"position": [0, 3, 0.1], "look_at": [0, 0, 0], "fov": 30},
  "film": {"width": 16, "height": 16, "filter": {"type": "box"}},
  "integrator": {"type": "path", "max_depth": 1},
  "materials": [
    {"name": "white", "type": "diffuse", "reflectance": [0.7, 0.7, 0.7]},
    {"name": "lamp", "type": "black", "emission": [5, 5, 5]}
  ],
  "shapes": [
    {"type": "quad", "material": "white", "corner": [-9, 0, 9], "edge_u": [18, 0, 0], "edge_v": [0, 0, -18]},
    {"type": "quad", "material": "lamp", "corner": [-4, 1, -9], "edge_u": [3, 0, 0], "edge_v": [0, 3, 0]}
  ]
})";

Image picture(const BuiltScene &scene, int sampler, int spp, int seed) {
  RenderOptions o;
  o.sampler = sampler;
  o.spp = spp;
  o.seed = seed;
  o.threads = 1;
  return image_from_film(render_scene(scene, o).film, 16, 16, {});
}

/// Slope of log relMSE over log samples from 16 to 256, eight seeds.
double slope_of(const BuiltScene &scene, int sampler) {
  ReferencePair reference{picture(scene, kSobolSampler, 8192, 901), picture(scene, kSobolSampler, 8192, 902), {}, "", 8192, true};
  reference.mean = reference.a;
  double log_error[2] = {};
  for (const int k : {0, 1}) {
    double error = 0;
    for (int seed = 0; seed < 8; ++seed)
      error += picture_error(picture(scene, sampler, k == 0 ? 16 : 256, seed), reference).relmse;
    log_error[k] = std::log2(error);
  }
  return (log_error[1] - log_error[0]) / 4;
}

}  // namespace

TEST_CASE("slopes: independent samples -1, Sobol points steeper than -1.3 where the picture is smooth") {
  const BuiltScene scene = build_text(kFloor, isas_here().back());
  CHECK(std::fabs(slope_of(scene, kIndependentSampler) + 1) < 0.05);
  CHECK(slope_of(scene, kSobolSampler) < -1.3);
}
