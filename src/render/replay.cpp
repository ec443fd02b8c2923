#include "replay.h"

#include <fmt/format.h>

#include "../core/error.h"
#include "../core/parallel.h"
#include "../wavefront/isa.h"
#include "tile_renderer.h"

namespace phalanx {

Replay replay_sample(const Scene &scene, const Accel &accel, const SceneDescription &description,
                     const RenderOptions &options, int x, int y, int sample) {
  RenderOptions own = options;
  own.crop = {0, 0, 0, 0};
  own.threads = 1;
  own.aovs = false;
  const Plan whole = make_plan(description, scene, own);
  if (x < 0 || y < 0 || x >= whole.frame.width || y >= whole.frame.height)
    throw InputError(fmt::format("--pixel {},{}: the picture has {} x {} pixels, counted from 0", x, y,
                                 whole.frame.width, whole.frame.height));
  own.crop = {x, y, 1, 1};
  const Plan plan = make_plan(description, scene, own);
  const FlushDenormals flush;  // as in every thread that renders

  Replay replay = {};
  SceneView view = scene.view();
  view.accel = accel.handle();
  const Kernels &kernels = kernels_for(resolve_isa(own.isa));
  replay.radiance = kernels.replay(view, plan.frame, x, y, sample, plan.rich ? kRich : kPlain, replay.steps);

  TileRenderer tiles(scene, accel, plan, own);
  Film film(plan.crop, false);
  Pass pass;
  pass.first_sample = sample;
  tiles.render(0, pass, 0, film);
  replay.rendered_is_valid = film.sample_count(0) == 1;
  replay.rendered = film.mean(0);  // of one sample: the sample
  return replay;
}

}  // namespace phalanx
