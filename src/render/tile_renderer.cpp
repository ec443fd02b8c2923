#include "tile_renderer.h"

#include <algorithm>

#include "../plan/seeds.h"
#include "../wavefront/isa.h"
#include "../wavefront/wavefront.h"

namespace phalanx {

/// What one thread owns: its wave, its sample block, its figures.
struct TileRenderer::Worker {
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

  void render(Mode mode, const Kernels &kernels, const Plan &plan, const FrameView &frame,
              const SceneView &scene, const TileView &tile);

  std::unique_ptr<Wave> wave;
  StageClock clock;
  std::vector<float> radiance, aov;
  RayCounts rays;
  std::int64_t lanes[4] = {};  // megakernel: see megakernel.ispc
};

/// All samples of one tile in one pass, by the schedule that was asked for.
void TileRenderer::Worker::render(Mode mode, const Kernels &kernels, const Plan &plan,
                                  const FrameView &frame, const SceneView &scene,
                                  const TileView &tile) {
  switch (mode) {
    case Mode::kWavefront:
      std::fill_n(tile.radiance, 3 * tile.num_samples, 0.0f);
      render_wavefront(kernels, plan, scene, frame, tile, *wave, clock, rays);
      break;
    case Mode::kMegakernel:
      clock.start();
      (plan.rich ? kernels.megakernel_rich : kernels.megakernel)(scene, frame, tile, lanes);
      rays.camera += tile.num_samples;
      rays.bounce = lanes[2];
      rays.shadow = lanes[3];
      clock.lap(kStageShade, tile.num_samples);
      break;
    case Mode::kDepthFirst:
      clock.start();
      kernels.depth_first(scene, frame, tile, rays, plan.rich ? kRich : kPlain);
      clock.lap(kStageShade, tile.num_samples);
      break;
    case Mode::kRecursive:
      clock.start();
      kernels.recursive(scene, frame, tile, rays, plan.rich ? kRich : kPlain);
      clock.lap(kStageShade, tile.num_samples);
      break;
  }
}

namespace {

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

void add_to_replicates(Replicates &replicates, const TileView &tile, int replicate) {
  const int samples = 1 << tile.log2_samples;
  for (int i = 0; i < tile.num_pixels; ++i)
    replicates.add_samples(tile.pixels[i] & 0xffff, (tile.pixels[i] >> 16) & 0xffff, replicate,
                           tile.radiance + 3 * i * samples, samples, tile.first_sample);
}

}  // namespace

TileRenderer::TileRenderer(const Scene &scene, const Accel &accel, const Plan &plan,
                           const RenderOptions &options, std::optional<int> seed)
    : plan_(plan),
      frame_(plan.frame),
      mode_(options.mode),
      kernels_(kernels_for(resolve_isa(options.isa))),
      view_(scene.view()),
      tiles_(cut_tiles(plan.crop, plan.tile_size)),
      pixels_(tiles_.size()),
      invalid_(tiles_.size()),
      workers_(static_cast<size_t>(plan.threads)) {
  view_.accel = accel.handle();
  frame_.seed = seed.value_or(frame_.seed);
}

TileRenderer::~TileRenderer() = default;

TileRenderer::Worker &TileRenderer::worker_of(int thread) {
  auto &worker = workers_[static_cast<size_t>(thread)];
  if (!worker) worker = std::make_unique<Worker>(plan_, kernels_, mode_);
  return *worker;
}

const std::vector<std::int32_t> &TileRenderer::pixels_of(int t) {
  auto &pixels = pixels_[static_cast<size_t>(t)];
  if (pixels.empty()) pixels = tile_pixels(tiles_[static_cast<size_t>(t)], plan_.tile_size);
  return pixels;
}

TileView TileRenderer::trace(const std::vector<std::int32_t> &pixels, const Pass &pass,
                             const FrameView &frame, Worker &worker) {
  TileView tile = {};
  tile.pixels = pixels.data();
  tile.num_pixels = static_cast<int32>(pixels.size());
  tile.log2_samples = pass.log2_samples;
  tile.first_sample = pass.first_sample;
  tile.num_samples = tile.num_pixels << pass.log2_samples;
  tile.radiance = worker.radiance.data();
  tile.aov = plan_.aovs ? worker.aov.data() : nullptr;
  worker.render(mode_, kernels_, plan_, frame, view_, tile);
  return tile;
}

std::int64_t TileRenderer::render(int t, const Pass &pass, int thread, Film &film) {
  return render(pixels_of(t), pass, thread, film, invalid_[static_cast<size_t>(t)]);
}

std::int64_t TileRenderer::render(const Rect &tile, const Pass &pass, int thread, Film &film,
                                  InvalidSamples &invalid) {
  return render(tile_pixels(tile, plan_.tile_size), pass, thread, film, invalid);
}

std::int64_t TileRenderer::render(const std::vector<std::int32_t> &pixels, const Pass &pass,
                                  int thread, Film &film, InvalidSamples &invalid) {
  Worker &worker = worker_of(thread);
  const std::int64_t rays_before = worker.rays.total();
  const TileView tile = trace(pixels, pass, frame_, worker);
  worker.clock.start();
  add_to_film(film, tile, invalid);
  worker.clock.lap(kStageFilm, tile.num_samples);
  return worker.rays.total() - rays_before;
}

std::int64_t TileRenderer::render(int t, const Pass &pass, int thread, Film &film,
                                  Replicates &replicates) {
  Worker &worker = worker_of(thread);
  const std::int64_t rays_before = worker.rays.total();
  for (int r = 0; r < replicates.count(); ++r) {
    FrameView frame = frame_;
    frame.seed = derived_seed(frame_.seed, SeedUse::kReplicate, r);
    const TileView tile = trace(pixels_of(t), pass, frame, worker);
    worker.clock.start();
    InvalidSamples invalid;
    add_to_film(film, tile, invalid);
    invalid.sample = invalid.sample * replicates.count() + r;
    invalid_[static_cast<size_t>(t)].merge(invalid);
    add_to_replicates(replicates, tile, r);
    worker.clock.lap(kStageFilm, tile.num_samples);
  }
  return worker.rays.total() - rays_before;
}

std::int64_t TileRenderer::num_invalid() const {
  std::int64_t n = 0;
  for (const InvalidSamples &i : invalid_) n += i.count;
  return n;
}

RayCounts TileRenderer::rays(int thread) const {
  const auto &worker = workers_[static_cast<size_t>(thread)];
  return worker ? worker->rays : RayCounts{};
}

void TileRenderer::collect(RunStats &stats) const {
  stats.mode = mode_name(mode_);
  stats.isa = kernels_.isa;
  stats.threads = plan_.threads;
  stats.rays = {};
  stats.invalid = {};
  for (const InvalidSamples &i : invalid_) stats.invalid.merge(i);
  std::vector<StageStats> stages(kNumStages);
  for (int s = 0; s < kNumStages; ++s) stages[s].name = stage_name(s);
  for (const auto &w : workers_) {
    if (!w) continue;
    w->clock.add_to(stages);
    stats.rays.camera += w->rays.camera;
    stats.rays.bounce += w->rays.bounce;
    stats.rays.shadow += w->rays.shadow;
    stats.wave_bytes_per_thread = std::max(stats.wave_bytes_per_thread, w->bytes());
  }
  if (mode_ != Mode::kWavefront) {
    StageStats &all = stages[kStageShade];
    all.name = "trace and shade";
    all.lanes_active = all.lanes_total = all.items;
    if (mode_ == Mode::kMegakernel) {
      all.lanes_active = all.lanes_total = 0;
      for (const auto &w : workers_) {
        if (!w) continue;
        all.lanes_active += w->lanes[0];
        all.lanes_total += w->lanes[1];
      }
    }
  }
  stats.stages.clear();
  for (const StageStats &s : stages)
    if (s.items > 0) stats.stages.push_back(s);
}

}  // namespace phalanx
