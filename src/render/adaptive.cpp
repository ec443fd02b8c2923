#include "adaptive.h"

#include <algorithm>
#include <cmath>

#include "../core/parallel.h"
#include "../core/timer.h"
#include "../plan/seeds.h"
#include "tile_renderer.h"

namespace phalanx {
namespace {

double square(double x) { return x * x; }

int shift_of(double samples) {
  return std::clamp(static_cast<int>(std::lround(std::log2(samples))), kLeastShift, kMostShift);
}

/// Shifts for samples in proportion to `wish` times `scale`.
std::vector<int> shifts_of(const std::vector<double> &wish, double scale) {
  std::vector<int> shifts;
  for (const double w : wish) shifts.push_back(w > 0 ? shift_of(w * scale) : kLeastShift);
  return shifts;
}

double cost_of(const std::vector<TileNoise> &tiles, const std::vector<int> &shifts) {
  double cost = 0;
  for (std::size_t t = 0; t < tiles.size(); ++t) cost += std::ldexp(tiles[t].cost, shifts[t]);
  return cost;
}

/// Sum over the pixels of a tile of the variance of replicates relative to the mean.
double noise_of(const Rect &tile, const Replicates &replicates, double eps) {
  const int count = replicates.count();
  double noise = 0;
  for (int y = tile.y; y < tile.y + tile.height; ++y)
    for (int x = tile.x; x < tile.x + tile.width; ++x) {
      const Rect crop = replicates.crop();
      const float *means = replicates.means(std::int64_t{y - crop.y} * crop.width + (x - crop.x));
      for (int c = 0; c < 3; ++c) {
        double mean = 0, squares = 0;
        for (int r = 0; r < count; ++r) mean += double{means[3 * r + c]} / count;
        for (int r = 0; r < count; ++r) squares += square(double{means[3 * r + c]} - mean);
        if (squares > 0) noise += squares / (square(mean) + eps);
      }
    }
  return noise;
}

}  // namespace

std::vector<int> allocate_samples(const std::vector<TileNoise> &tiles) {
  std::vector<double> wish;
  double most = 0, budget = 0;
  for (const TileNoise &t : tiles) {
    wish.push_back(t.noise > 0 && t.cost > 0 ? std::sqrt(t.noise / t.cost) : 0);
    most = std::max(most, wish.back());
    budget += t.cost;
  }
  if (most == 0) return std::vector<int>(tiles.size(), 0);
  for (double &w : wish) w /= most;
  // The largest scale whose cost fits. Cost grows with the scale, from a quarter of the budget.
  double lo = std::ldexp(1.0, kLeastShift - 1), hi = std::ldexp(1.0, 64);
  for (int i = 0; i < 100; ++i) {
    const double middle = std::sqrt(lo * hi);
    (cost_of(tiles, shifts_of(wish, middle)) <= budget * (1 + 1e-9) ? lo : hi) = middle;
  }
  return shifts_of(wish, lo);
}

int pilot_samples(const Plan &plan) { return std::clamp(plan.spp / 8, 16, 64); }

Pilot run_pilot(const Scene &scene, const Accel &accel, const Plan &plan, const RenderOptions &options) {
  const double start = wall_seconds();
  TileRenderer renderer(scene, accel, plan, options, derived_seed(plan.frame.seed, SeedUse::kPilot, 0));
  Film film(plan.crop, plan.aovs);
  Replicates replicates(plan.crop, kPilotReplicates);
  std::vector<TileNoise> tiles(static_cast<std::size_t>(renderer.num_tiles()));
  const int samples = pilot_samples(plan) / kPilotReplicates;
  parallel_for(renderer.num_tiles(), plan.threads, [&](std::int64_t t, int thread) {
    for (const Pass &pass : cut_passes(samples, plan.samples_per_pass))
      tiles[static_cast<std::size_t>(t)].cost += static_cast<double>(
          renderer.render(static_cast<int>(t), pass, thread, film, replicates));
  });
  const double eps = square(0.01 * film.image_mean());
  for (int t = 0; t < renderer.num_tiles(); ++t)
    tiles[static_cast<std::size_t>(t)].noise = noise_of(renderer.tile(t), replicates, eps);
  return {allocate_samples(tiles), samples * kPilotReplicates, wall_seconds() - start};
}

}  // namespace phalanx
