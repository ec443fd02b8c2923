#include "render.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>

#include "../core/parallel.h"
#include "../core/timer.h"
#include "../wavefront/isa.h"
#include "../wavefront/wavefront.h"
#include "tiles.h"

namespace phalanx {
namespace {

/// What one thread owns: its wave, its sample block, its figures.
struct Worker {
  Worker(const Plan &plan, const Kernels &kernels, Mode mode)
      : clock(kernels.width),
        radiance(block_size(plan) * 3),
        aov(plan.aovs ? block_size(plan) * PHALANX_AOV_FLOATS : 0) {
    if (mode == Mode::kWavefront) wave = std::make_unique<Wave>(plan);
  }
  static size_t block_size(const Plan &plan) {
    return static_cast<size_t>(plan.tile_size) * static_cast<size_t>(plan.tile_size) *
           static_cast<size_t>(plan.samples_per_pass);
  }
  std::int64_t bytes() const {
    return static_cast<std::int64_t>((radiance.size() + aov.size()) * sizeof(float)) +
           (wave ? wave->bytes() : 0);
  }

  std::unique_ptr<Wave> wave;
  StageClock clock;
  std::vector<float> radiance, aov;
  RayCounts rays;
  std::int64_t lanes[4] = {};  // megakernel: see megakernel.ispc
};

/// All samples of one tile in one pass, by the schedule that was asked for.
void render_tile(Mode mode, const Kernels &kernels, const Plan &plan, const SceneView &scene,
                 const TileView &tile, Worker &w) {
  switch (mode) {
    case Mode::kWavefront:
      std::fill_n(tile.radiance, 3 * tile.num_samples, 0.0f);
      render_wavefront(kernels, plan, scene, tile, *w.wave, w.clock, w.rays);
      break;
    case Mode::kMegakernel:
      w.clock.start();
      (plan.rich ? kernels.megakernel_rich : kernels.megakernel)(scene, plan.frame, tile, w.lanes);
      w.rays.camera += tile.num_samples;
      w.rays.bounce = w.lanes[2];
      w.rays.shadow = w.lanes[3];
      w.clock.lap(kStageShade, tile.num_samples);
      break;
    case Mode::kDepthFirst:
      w.clock.start();
      kernels.depth_first(scene, plan.frame, tile, w.rays, plan.rich ? kRich : kPlain);
      w.clock.lap(kStageShade, tile.num_samples);
      break;
    case Mode::kRecursive:
      w.clock.start();
      kernels.recursive(scene, plan.frame, tile, w.rays, plan.rich ? kRich : kPlain);
      w.clock.lap(kStageShade, tile.num_samples);
      break;
  }
}

/// Adds a tile's samples to the film, each pixel's in sample order.
void add_to_film(Film &film, const TileView &tile, InvalidSamples &invalid) {
  const int samples = 1 << tile.log2_samples;
  for (int i = 0; i < tile.num_pixels; ++i) {
    const int x = tile.pixels[i] & 0xffff, y = (tile.pixels[i] >> 16) & 0xffff;
    film.add_samples(x, y, tile.radiance + 3 * i * samples, samples, tile.first_sample, invalid);
    if (tile.aov != nullptr)
      film.add_aovs(x, y, tile.aov + PHALANX_AOV_FLOATS * i * samples, samples);
  }
}

void collect_stages(RunStats &stats, Mode mode, const std::vector<std::unique_ptr<Worker>> &workers) {
  std::vector<StageStats> stages(kNumStages);
  for (int s = 0; s < kNumStages; ++s) stages[s].name = stage_name(s);
  for (const auto &w : workers) w->clock.add_to(stages);
  if (mode != Mode::kWavefront) {
    StageStats &all = stages[kStageShade];
    all.name = "trace and shade";
    all.lanes_active = all.lanes_total = all.items;
    if (mode == Mode::kMegakernel) {
      all.lanes_active = all.lanes_total = 0;
      for (const auto &w : workers) {
        all.lanes_active += w->lanes[0];
        all.lanes_total += w->lanes[1];
      }
    }
  }
  for (const StageStats &s : stages)
    if (s.items > 0) stats.stages.push_back(s);
}

}  // namespace

RenderResult render(const Scene &scene, const Accel &accel, const Plan &plan,
                    const RenderOptions &options, const ProgressCallback &progress) {
  const Kernels &kernels = kernels_for(resolve_isa(options.isa));
  SceneView view = scene.view();
  view.accel = accel.handle();

  RenderResult result{Film(plan.crop, plan.aovs), {}};
  RunStats &stats = result.stats;
  const std::vector<Rect> tiles = cut_tiles(plan.crop, plan.tile_size);
  const std::vector<Pass> passes = cut_passes(plan.spp, plan.samples_per_pass);
  std::vector<std::vector<std::int32_t>> pixels(tiles.size());
  std::vector<InvalidSamples> invalid(tiles.size());
  std::vector<std::unique_ptr<Worker>> workers(static_cast<size_t>(plan.threads));

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
                 (static_cast<double>(tiles.size()) * static_cast<double>(passes.size()));
    p.elapsed_s = wall_seconds() - start;
    p.rays = rays_done;
    p.between_passes = between_passes;
    if (!progress(p, result.film)) stop = true;
    last_progress = wall_seconds();
  };

  const auto render_tile_pass = [&](const Pass &pass, size_t t, size_t thread) {
    auto &worker = workers[thread];
    if (!worker) worker = std::make_unique<Worker>(plan, kernels, options.mode);
    if (pixels[t].empty()) pixels[t] = tile_pixels(tiles[t], plan.tile_size);
    TileView tile = {};
    tile.pixels = pixels[t].data();
    tile.num_pixels = static_cast<int32>(pixels[t].size());
    tile.log2_samples = pass.log2_samples;
    tile.first_sample = pass.first_sample;
    tile.num_samples = tile.num_pixels << pass.log2_samples;
    tile.radiance = worker->radiance.data();
    tile.aov = plan.aovs ? worker->aov.data() : nullptr;
    const std::int64_t rays_before = worker->rays.total();
    render_tile(options.mode, kernels, plan, view, tile, *worker);
    worker->clock.start();
    add_to_film(result.film, tile, invalid[t]);
    worker->clock.lap(kStageFilm, tile.num_samples);
    rays_done += worker->rays.total() - rays_before;
    ++tiles_done;
  };

  for (const Pass &pass : passes) {
    parallel_for(static_cast<std::int64_t>(tiles.size()), plan.threads,
                 [&](std::int64_t t, int thread) {
      render_tile_pass(pass, static_cast<size_t>(t), static_cast<size_t>(thread));
      if (!progress) return;
      const std::unique_lock lock(progress_mutex, std::try_to_lock);
      if (lock.owns_lock() && wall_seconds() - last_progress > 0.25) report(pass, false);
    });
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
  stats.mode = mode_name(options.mode);
  stats.isa = kernels.isa;
  stats.threads = plan.threads;
  std::erase(workers, nullptr);
  for (const auto &w : workers) {
    stats.rays.camera += w->rays.camera;
    stats.rays.bounce += w->rays.bounce;
    stats.rays.shadow += w->rays.shadow;
    stats.wave_bytes_per_thread = std::max(stats.wave_bytes_per_thread, w->bytes());
  }
  for (const InvalidSamples &i : invalid) stats.invalid.merge(i);
  collect_stages(stats, options.mode, workers);
  return result;
}

}  // namespace phalanx
