#include "render.h"

#include <algorithm>
#include <atomic>
#include <mutex>

#include "../core/parallel.h"
#include "../core/timer.h"
#include "adaptive.h"
#include "budget.h"
#include "tile_renderer.h"

namespace phalanx {
namespace {

/// n * 2^shift, rounded down.
int shifted(int n, int shift) { return shift >= 0 ? n << shift : n >> -shift; }

/// A rendering under way: what a pass does, and what is known after it.
class Rendering {
 public:
  Rendering(const Scene &scene, const Accel &accel, const Plan &plan, const RenderOptions &options,
            const ProgressCallback &progress)
      : plan_(plan),
        progress_(progress),
        tiles_(scene, accel, plan, options),
        result_{Film(plan.crop, plan.aovs), {}, {}, {}},
        start_(wall_seconds()),
        cpu_start_(cpu_seconds()),
        last_progress_(start_) {
    result_.film.set_clamp(plan.clamp);
    if (plan.replicates > 0) result_.replicates.emplace(plan.crop, plan.replicates);
    if (plan.adaptive) pilot_ = run_pilot(scene, accel, plan, options);
  }

  RenderResult run() {
    RunStats &stats = result_.stats;
    const char *reason = nullptr;
    while (reason == nullptr) {
      const Pass pass = next(done_);
      render_pass(pass);
      if (stop_) {  // within the pass: what is done of it stays in the film
        reason = "signal";
        break;
      }
      done_ += 1 << pass.log2_samples;
      BudgetState state;
      state.spp = stats.spp = done_ * unit();
      state.at_check = is_check(stats.spp);
      if (state.at_check) check();
      if (progress_) report({done_, 0}, true);
      state.elapsed_s = wall_seconds() - start_;
      state.next_spp = stats.spp < plan_.spp ? (1 << next(done_).log2_samples) * unit() : 0;
      state.stop_asked = stop_;
      reason = stop_reason(plan_, state, stats.checks);
    }
    stats.stopped_by = reason;
    if (result_.replicates && (stats.checks.empty() || stats.checks.back().spp != stats.spp)) check();
    finish();
    return std::move(result_);
  }

 private:
  /// A pass over one sequence of samples is a pass over as many of each replicate.
  int unit() const { return std::max(1, plan_.replicates); }
  Pass next(int done) const {
    return result_.replicates
               ? next_replicated_pass(done, plan_.spp / unit(), plan_.samples_per_pass, unit())
               : next_pass(done, plan_.spp, plan_.samples_per_pass);
  }
  bool is_check(int spp) const {
    return result_.replicates && is_error_check(spp);
  }

  void render_pass(const Pass &pass) {
    tiles_done_ = 0;
    parallel_for(tiles_.num_tiles(), plan_.threads, [&](std::int64_t t, int thread) {
      if (stop_) return;
      render_tile(static_cast<int>(t), pass, thread);
      ++tiles_done_;
      if (!progress_) return;
      const std::unique_lock lock(progress_mutex_, std::try_to_lock);
      if (lock.owns_lock() && wall_seconds() - last_progress_ > 0.25) report(pass, false);
    });
  }

  /// Its samples of the pass: as many as the pass says, or what the pilot made of them.
  void render_tile(int t, const Pass &pass, int thread) {
    const int shift = plan_.adaptive ? pilot_.shifts[static_cast<std::size_t>(t)] : 0;
    if (shift == 0) return render_block(t, pass, thread);
    const int end = shifted(pass.first_sample + (1 << pass.log2_samples), shift);
    for (int done = shifted(pass.first_sample, shift); done < end;) {
      const Pass block = next_pass(done, end, plan_.samples_per_pass);
      render_block(t, block, thread);
      done += 1 << block.log2_samples;
    }
  }
  void render_block(int t, const Pass &pass, int thread) {
    rays_ += result_.replicates ? tiles_.render(t, pass, thread, result_.film, *result_.replicates)
                                : tiles_.render(t, pass, thread, result_.film);
  }

  /// Looks at the error.
  void check() {
    const double before = wall_seconds();
    result_.error = estimate_error(*result_.replicates, plan_.threads);
    RunStats &stats = result_.stats;
    stats.checks.push_back({stats.spp, wall_seconds() - start_, result_.error->relmse,
                            result_.error->lo95, result_.error->hi95});
    stats.check_s += wall_seconds() - before;
  }

  void report(const Pass &pass, bool between_passes) {
    Progress p;
    p.spp_done = pass.first_sample * unit();
    p.spp_total = plan_.spp < kNoSampleLimit ? plan_.spp : 0;
    p.elapsed_s = wall_seconds() - start_;
    const double in_pass = between_passes ? 0
                                          : static_cast<double>(tiles_done_) / tiles_.num_tiles() *
                                                (1 << pass.log2_samples);
    p.fraction = (pass.first_sample + in_pass) * unit() / plan_.spp;
    if (plan_.time_limit_s > 0)
      p.fraction = std::min(1.0, std::max(p.fraction, p.elapsed_s / plan_.time_limit_s));
    p.rays = rays_;
    p.between_passes = between_passes;
    p.target_error = plan_.target_error;
    if (between_passes) invalid_ = tiles_.num_invalid();
    p.invalid = invalid_;
    p.checks = &result_.stats.checks;
    if (!progress_(p, result_.film)) stop_ = true;
    last_progress_ = wall_seconds();
  }

  void finish() {
    RunStats &stats = result_.stats;
    const Film &film = result_.film;
    stats.samples_per_pixel = stats.spp;
    if (plan_.adaptive) {
      double sum = 0;
      for (int t = 0; t < tiles_.num_tiles(); ++t) {
        const Rect &tile = tiles_.tile(t);
        const int samples = shifted(done_, pilot_.shifts[static_cast<std::size_t>(t)]);
        sum += static_cast<double>(unit()) * samples * tile.width * tile.height;
      }
      stats.samples_per_pixel = sum / static_cast<double>(film.num_pixels());
    }
    stats.pilot_s = pilot_.seconds;
    stats.pilot_spp = pilot_.spp;
    stats.wall_s = wall_seconds() - start_;
    stats.cpu_s = cpu_seconds() - cpu_start_;
    tiles_.collect(stats);
    add_clamp_figures(stats, film, plan_.clamp);
  }

  const Plan &plan_;
  const ProgressCallback &progress_;
  TileRenderer tiles_;
  RenderResult result_;
  Pilot pilot_;
  int done_ = 0;  // samples of each sequence, whole passes
  const double start_, cpu_start_;
  double last_progress_;
  std::mutex progress_mutex_;
  std::atomic<std::int64_t> tiles_done_ = 0, rays_ = 0;
  std::int64_t invalid_ = 0;
  std::atomic<bool> stop_ = false;
};

}  // namespace

void add_clamp_figures(RunStats &stats, const Film &film, float limit) {
  stats.clamp = limit;
  const double kept = film.energy(), taken = stats.invalid.clamped_energy;
  stats.clamped_share = taken > 0 ? taken / (kept + taken) : 0;
}

RenderResult render(const Scene &scene, const Accel &accel, const Plan &plan,
                    const RenderOptions &options, const ProgressCallback &progress) {
  return Rendering(scene, accel, plan, options, progress).run();
}

}  // namespace phalanx
