#include "render.h"

#include <atomic>
#include <mutex>

#include "../core/parallel.h"
#include "../core/timer.h"
#include "tile_renderer.h"

namespace phalanx {

void add_clamp_figures(RunStats &stats, const Film &film, float limit) {
  stats.clamp = limit;
  const double kept = film.energy(), taken = stats.invalid.clamped_energy;
  stats.clamped_share = taken > 0 ? taken / (kept + taken) : 0;
}

RenderResult render(const Scene &scene, const Accel &accel, const Plan &plan,
                    const RenderOptions &options, const ProgressCallback &progress) {
  TileRenderer tiles(scene, accel, plan, options);
  RenderResult result{Film(plan.crop, plan.aovs), {}};
  RunStats &stats = result.stats;
  result.film.set_clamp(plan.clamp);
  const std::vector<Pass> passes = cut_passes(plan.spp, plan.samples_per_pass);

  const double start = wall_seconds(), cpu_start = cpu_seconds();
  std::mutex progress_mutex;
  double last_progress = start;
  std::atomic<std::int64_t> tiles_done = 0, rays_done = 0;
  std::atomic<bool> stop = false;
  stats.stopped_by = "spp";

  const auto report = [&](const Pass &pass, bool between_passes) {
    Progress p;
    p.spp_done = pass.first_sample + (between_passes ? 1 << pass.log2_samples : 0);
    p.spp_total = plan.spp;
    p.fraction = static_cast<double>(tiles_done) /
                 (static_cast<double>(tiles.num_tiles()) * static_cast<double>(passes.size()));
    p.elapsed_s = wall_seconds() - start;
    p.rays = rays_done;
    p.between_passes = between_passes;
    if (!progress(p, result.film)) stop = true;
    last_progress = wall_seconds();
  };

  for (const Pass &pass : passes) {
    parallel_for(tiles.num_tiles(), plan.threads, [&](std::int64_t t, int thread) {
      if (stop) return;
      rays_done += tiles.render(static_cast<int>(t), pass, thread, result.film);
      ++tiles_done;
      if (!progress) return;
      const std::unique_lock lock(progress_mutex, std::try_to_lock);
      if (lock.owns_lock() && wall_seconds() - last_progress > 0.25) report(pass, false);
    });
    if (stop) {  // within the pass
      stats.stopped_by = "signal";
      break;
    }
    if (progress) report(pass, true);
    stats.spp = pass.first_sample + (1 << pass.log2_samples);
    if (stats.spp == plan.spp) break;
    if (stop) {
      stats.stopped_by = "signal";
      break;
    }
    // Another pass like the average one must fit into the time that is left.
    const double elapsed = wall_seconds() - start;
    const double pass_s = elapsed / stats.spp * (1 << pass.log2_samples);
    if (plan.time_limit_s > 0 && elapsed + pass_s > plan.time_limit_s) {
      stats.stopped_by = "time";
      break;
    }
  }

  stats.wall_s = wall_seconds() - start;
  stats.cpu_s = cpu_seconds() - cpu_start;
  tiles.collect(stats);
  add_clamp_figures(stats, result.film, plan.clamp);
  return result;
}

}  // namespace phalanx
