// Replicates and adaptive sampling: what a picture is made of does not depend on how it is computed.
#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "core/error.h"
#include "plan/seeds.h"
#include "render/adaptive.h"
#include "render/budget.h"
#include "render/tiles.h"
#include "support/scenes.h"
#include "support/statistics.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

RenderOptions replicated(int side, int spp, int count = kDefaultReplicates) {
  RenderOptions o;
  o.width = o.height = side;
  o.spp = spp;
  o.threads = 1;
  o.replicates = count;
  return o;
}

double mean_of(const Film &film) {
  double sum = 0;
  for (std::int64_t i = 0; i < film.num_pixels(); ++i) {
    const Vec3 m = film.mean(i);
    sum += double{m.x} + double{m.y} + double{m.z};
  }
  return sum / (3.0 * double(film.num_pixels()));
}

/// A floor in the dark, lit through glass by a small lamp (a caustic), and a tiny mirror that throws the
/// lamp's light at a few pixels now and then.
const char kRareScene[] = R"({
  "version": 1,
  "camera": {"position": [0, 3, 4], "look_at": [0, 0, 0], "fov": 40},
  "film": {"width": 32, "height": 32},
  "integrator": {"type": "path", "max_depth": 4},
  "materials": [
    {"name": "white", "type": "diffuse", "reflectance": [0.7, 0.7, 0.7]},
    {"name": "glass", "type": "dielectric", "ior": 1.5},
    {"name": "lamp", "type": "black", "emission": [60, 60, 60]}
  ],
  "shapes": [
    {"type": "quad", "material": "white", "corner": [-2, 0, 2], "edge_u": [4, 0, 0], "edge_v": [0, 0, -4]},
    {"type": "sphere", "material": "glass", "center": [0.4, 0.6, 0], "radius": 0.5},
    {"type": "sphere", "material": "lamp", "center": [1.5, 2, -1], "radius": 0.15}
  ]
})";

}  // namespace

TEST_CASE("replicates: wavefront, megakernel and depth-first give the same bits, with any threads and tiles") {
  for (const char *file : {"scenes/cornell-glass.json", "scenes/principled.json"}) {
    const BuiltScene scene = build_file(file, isas_here().back());
    for (const bool adaptive : {false, true}) {
      RenderOptions o = replicated(40, 192);
      o.adaptive = adaptive;
      o.tile_size = 16;
      o.mode = Mode::kDepthFirst;
      const RenderResult expected = render_scene(scene, o);
      o.mode = Mode::kMegakernel;
      CHECK(pixels_that_differ(render_scene(scene, o).film, expected.film) == 0);
      o.mode = Mode::kWavefront;
      o.threads = 3;
      o.wave_size = 100;
      if (!adaptive) o.tile_size = 8;
      const RenderResult other = render_scene(scene, o);
      CHECK(pixels_that_differ(other.film, expected.film) == 0);
      REQUIRE(other.error.has_value());
      CHECK(other.error->relmse == expected.error->relmse);
      CHECK(other.error->hi95 == expected.error->hi95);
    }
  }
}

TEST_CASE("replicates: each is the picture of its seed, and the film is their mean") {
  const BuiltScene scene = build_file("scenes/cornell-box.json", isas_here().back());
  RenderOptions o = replicated(16, 128);
  o.seed = 3;
  const RenderResult all = render_scene(scene, o);
  REQUIRE(all.replicates.has_value());
  for (const int r : {0, 1, 15}) {
    RenderOptions one = o;
    one.replicates = 0;
    one.spp = 8;
    one.seed = derived_seed(3, SeedUse::kReplicate, r);
    const Film film = render_scene(scene, one).film;
    for (std::int64_t i = 0; i < film.num_pixels(); i += 7)
      CHECK(double(all.replicates->means(i)[3 * r]) == doctest::Approx(double(film.mean(i).x)).epsilon(1e-5));
  }
  for (std::int64_t i = 0; i < all.film.num_pixels(); i += 7) {
    double mean = 0;
    for (int r = 0; r < 16; ++r) mean += double(all.replicates->means(i)[3 * r + 1]) / 16;
    CHECK(mean == doctest::Approx(double(all.film.mean(i).y)).epsilon(1e-5));
    CHECK(all.film.sample_count(i) == 128);
  }
}

TEST_CASE("replicates: passes end where the error is looked at, and make every sample once") {
  for (const int count : {2, 16, 64})
    for (const int spp : {64, 192, 960, 4096}) {
      int done = 0;
      std::vector<int> ends;
      while (done < spp / count) {
        const Pass pass = next_replicated_pass(done, spp / count, 16, count);
        CHECK(pass.first_sample == done);
        CHECK(pass.log2_samples <= 4);
        done += 1 << pass.log2_samples;
        ends.push_back(done * count);
      }
      CHECK(done * count == spp);
      for (int n = kFirstCheck; n <= spp; ++n)
        if (is_error_check(n) && n % count == 0)
          CHECK_MESSAGE(std::find(ends.begin(), ends.end(), n) != ends.end(), n);
    }
  CHECK_FALSE(is_error_check(32));
  CHECK_FALSE(is_error_check(80));
  CHECK(is_error_check(96));
}

TEST_CASE("replicates: what they cost is planned, and nothing is kept without them") {
  const BuiltScene scene = build_file("scenes/cornell-box.json", isas_here().back());
  const Plan with = make_plan(scene.description, scene.scene, replicated(64, 1000));
  CHECK(with.spp == 1008);
  CHECK(with.frame.spp == 63);
  CHECK(plan_memory(with, scene.scene).replicates == 64 * 64 * (16 * 12 + 24));
  const Plan without = make_plan(scene.description, scene.scene, replicated(64, 1000, 0));
  CHECK(without.spp == 1000);
  CHECK(plan_memory(without, scene.scene).replicates == 0);
  CHECK_FALSE(render_scene(scene, replicated(8, 4, 0)).replicates.has_value());
  RenderOptions o = replicated(64, 16, 0);
  o.target_error = 1e-3;
  CHECK_THROWS_AS(make_plan(scene.description, scene.scene, o), InputError);
  CHECK_THROWS_AS(make_plan(scene.description, scene.scene, replicated(64, 16, 12)), InputError);
}

TEST_CASE("budget: the first limit that is reached ends it, and it has a name") {
  Plan plan;
  plan.spp = 1024;
  const auto reason = [&](BudgetState state, const std::vector<ErrorCheck> &checks = {}) {
    const char *why = stop_reason(plan, state, checks);
    return std::string(why ? why : "");
  };
  CHECK(reason({1024, 0, 1, false, false}) == "spp");
  CHECK(reason({512, 16, 1, false, false}) == "");
  CHECK(reason({512, 16, 1, false, true}) == "signal");
  plan.time_limit_s = 2;
  CHECK(reason({512, 256, 1.2, false, false}) == "");       // 1.8 s afterwards
  CHECK(reason({512, 512, 1.2, false, false}) == "time");   // 2.4 s
  plan.target_error = 1e-3;
  const ErrorCheck above{64, 1, 9e-4, 8e-4, 1.1e-3}, below{128, 2, 9e-4, 8e-4, 1e-3};
  CHECK(reason({128, 16, 1, true, false}, {above, below}) == "");
  CHECK(reason({128, 16, 1, true, false}, {below, below}) == "target");
  CHECK(reason({160, 16, 1, false, false}, {below, below}) == "");  // no check here
  CHECK_FALSE(is_target_met({below}, 1e-3));
}

TEST_CASE("budget: a target is kept, and a limit of samples or time comes before it") {
  const BuiltScene scene = build_file("scenes/furnace.json", isas_here().back());
  RenderOptions o = replicated(16, 0);
  o.target_error = 1e-2;
  const RenderResult r = render_scene(scene, o);
  CHECK(r.stats.stopped_by == "target");
  REQUIRE(r.stats.checks.size() >= 2);
  CHECK(r.stats.checks.back().hi95 <= 1e-2);
  CHECK(r.stats.checks.back().spp == r.stats.spp);
  CHECK(r.error->hi95 == r.stats.checks.back().hi95);
  o.target_error = 1e-12;
  o.spp = 80;
  const RenderResult few = render_scene(scene, o);
  CHECK(few.stats.stopped_by == "spp");
  CHECK(few.stats.checks.back().spp == 80);
}

TEST_CASE("adaptive: samples go as the root of noise over cost, within the budget") {
  std::vector<TileNoise> tiles(64, {1, 1});
  CHECK(allocate_samples(tiles) == std::vector<int>(64, 0));
  for (std::size_t t = 0; t < 32; ++t) tiles[t].noise = 256;  // sixteen times the samples
  const std::vector<int> shifts = allocate_samples(tiles);
  double cost = 0;
  for (const int k : shifts) cost += std::ldexp(1.0, k);
  CHECK(cost <= 64);
  CHECK(cost >= 32);
  CHECK(shifts[0] - shifts[63] >= 2);
  CHECK(allocate_samples(std::vector<TileNoise>(5, {0, 1})) == std::vector<int>(5, 0));
  tiles.assign(100, {0, 1});
  tiles[0].noise = 1;  // all others are black in the pilot, and still get samples
  CHECK(allocate_samples(tiles)[0] == kMostShift);
  CHECK(allocate_samples(tiles)[1] == kLeastShift);
}

TEST_CASE("adaptive: samples are those that were given, and differ between tiles") {
  const BuiltScene scene = build_text(kRareScene, isas_here().back());
  RenderOptions o = replicated(32, 64, 0);
  o.adaptive = true;
  o.tile_size = 8;
  const RenderResult r = render_scene(scene, o);
  double sum = 0;
  std::int64_t least = 1 << 30, most = 0;
  for (std::int64_t i = 0; i < r.film.num_pixels(); ++i) {
    const std::int64_t n = r.film.sample_count(i);
    sum += double(n) / double(r.film.num_pixels());
    least = std::min(least, n);
    most = std::max(most, n);
  }
  CHECK(r.stats.samples_per_pixel == doctest::Approx(sum));
  CHECK(least >= 16);
  CHECK(most >= 4 * least);
  CHECK(r.stats.pilot_spp == 16);
}

TEST_CASE("adaptive and target: no bias where bright things are rare (fixed seeds, false alarm 0.3 % each)") {
  const BuiltScene scene = build_text(kRareScene, isas_here().back());
  Mean plain, adaptive, target;
  for (int seed = 0; seed < 60; ++seed) {
    RenderOptions o = replicated(24, 64, 0);
    o.seed = 100 + seed;
    o.tile_size = 8;
    plain.add(mean_of(render_scene(scene, o).film));
    o.seed = 1000 + seed;
    o.adaptive = true;
    adaptive.add(mean_of(render_scene(scene, o).film));
    o = replicated(24, 512);
    o.seed = 2000 + seed;
    o.target_error = 0.1;
    target.add(mean_of(render_scene(scene, o).film));
  }
  const auto z = [&](const Mean &m) {
    return (m.mean() - plain.mean()) / std::hypot(m.standard_error(), plain.standard_error());
  };
  CHECK(std::fabs(z(adaptive)) < 3);
  CHECK(std::fabs(z(target)) < 3);
  CHECK(plain.standard_error() < 0.01 * plain.mean());
}
