// Random numbers, sums, depths, and what must not change a bit.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../kernels/physics/rng.h"
#include "../core/error.h"
#include "../film/film.h"
#include "../plan/plan.h"
#include "../render/tiles.h"
#include "../scene/scene_file.h"
#include "any_bsdf.h"
#include "case.h"
#include "groups.h"
#include "random.h"
#include "statistics.h"

namespace phalanx::check {
namespace {

/// Adds `count` grey samples to a film of one pixel.
template <typename Sample>
Film summed(std::int64_t count, const Sample &sample) {
  Film film({0, 0, 1, 1}, false);
  InvalidSamples invalid;
  std::vector<float> block(3 * 4096);
  for (std::int64_t first = 0; first < count; first += 4096) {
    for (std::size_t i = 0; i < 4096; ++i) block[3 * i] = block[3 * i + 1] = block[3 * i + 2] = sample();
    film.add_samples(0, 0, block.data(), 4096, first, invalid);
  }
  return film;
}

SceneText integrating_sphere(double albedo, const std::string &integrator) {
  SceneText scene;
  scene.camera = camera({0.1, 0.2, 0.3}, {1, 0, 0}, 20, {0, 1, 0});
  scene.integrator = integrator;
  scene.materials = {material("wall", "diffuse", fmt::format(R"("reflectance": {}, "emission": 1, "two_sided": true)", albedo))};
  scene.shapes = {sphere("wall", {0, 0, 0}, 1)};
  return scene;
}

/// A room with a bit of everything: many materials, lights of several kinds, an instance.
SceneText busy_room() {
  SceneText scene;
  scene.width = 19;
  scene.height = 13;
  scene.camera = camera({0, 1, 3.5}, {0, 0.8, 0}, 45, {0, 1, 0});
  scene.integrator = R"("max_depth": 10, "roulette_depth": 3)";
  scene.materials = {material("glass", "dielectric", R"("ior": 1.5)"), material("metal", "conductor", R"("metal": "gold", "alpha": 0.2)"),
                     material("silver", "mirror", R"("reflectance": 0.9)"), emitter("light", 10)};
  scene.lights = {kSky};
  scene.groups = {R"({"name": "g", "shapes": [{"type": "displaced_sphere", "material": "grey", "resolution": 8, "radius": 0.3}]})"};
  scene.instances = {R"({"group": "g", "transform": {"translate": [0.5, 1.3, -0.3]}})"};
  scene.shapes = {level("grey", 2, 0), quad("grey", {-1, 0, -1}, {2, 0, 0}, {0, 2, 0}),
                  sphere("glass", {0.3, 0.4, 0.3}, 0.4), sphere("metal", {-0.5, 0.35, 0}, 0.35),
                  sphere("silver", {-0.2, 1.1, -0.4}, 0.3), quad("light", {-0.3, 1.9, -0.3}, {0.6, 0, 0}, {0, 0, 0.6})};
  return scene;
}

void long_sums(Case &c) {
  Random random(1);
  long double sum = 0;
  const std::int64_t count = c.count(1 << 20, 1 << 24);
  const Film film = summed(count, [&] {
    const auto x = static_cast<float>(-std::log(1 - random.fine()));
    sum += x;
    return x;
  });
  const auto exact = static_cast<double>(sum / static_cast<long double>(count));
  c.near(fmt::format("mean of {} exponential samples", count), static_cast<double>(film.mean(0).y), exact, 1e-6 * exact);
  c.equal("samples counted", static_cast<double>(film.sample_count(0)), static_cast<double>(count));
}

void small_variance(Case &c) {
  Random random(2);
  std::vector<double> values;
  const Film film = summed(1 << 20, [&] {
    const float x = 1e4f + random.between(-1, 1);
    values.push_back(static_cast<double>(x));
    return x;
  });
  long double mean = 0, squares = 0;
  const auto n = static_cast<long double>(values.size());
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  const auto exact = static_cast<double>(squares / (n - 1) / n);
  c.near("variance of the mean of 10^4 +- 1", static_cast<double>(film.variance_of_mean(0).y), exact, 1e-3 * exact);
}

void large_pictures(Case &c) {
  SceneText scene = busy_room();
  scene.width = scene.height = 16384;
  Stage stage = c.stage(scene);
  RenderOptions options;
  options.spp = 16;
  const Plan plan = make_plan(stage.description(), stage.scene(), options);
  c.at_least("bytes of the film of 16384 x 16384", static_cast<double>(plan_memory(plan, stage.scene()).film), 4294967296.0);
  for (const std::string &isa : c.isas()) {
    options.isa = isa;
    options.crop = {16376, 16376, 8, 8};
    const Film corner = c.render(stage, options).film;
    options.crop = {16383, 16383, 1, 1};
    const Film last = c.render(stage, options).film;
    const Vec3 a = corner.mean(63), b = last.mean(0);
    c.holds(with_isa(c, "the last pixel is the same in both windows", isa), a.x == b.x && a.y == b.y && a.z == b.z);
    c.at_least(with_isa(c, "light in that corner", isa), measure(corner).mean, 1e-6);
  }
  std::int64_t samples = 0;
  for (const Pass &pass : cut_passes(16777217, 16)) samples += std::int64_t{1} << pass.log2_samples;
  c.equal("samples in the passes of 2^24 + 1", static_cast<double>(samples), 16777217);
  c.remark("a whole film of 16384 x 16384 pixels is not allocated: it needs 15 GiB");
}

void late_samples(Case &c) {
  struct Kind {
    const char *name;
    SamplerKind kind;
  };
  for (const Kind &k : {Kind{"sobol", kSobolSampler}, Kind{"independent", kIndependentSampler}, Kind{"stratified", kStratifiedSampler},
                        Kind{"halton", kHaltonSampler}, Kind{"blue_noise", kBlueNoiseSampler}}) {
    FrameView frame = {};
    frame.sampler = k.kind;
    frame.spp = 4096;
    frame.width = frame.height = 64;
    std::int64_t outside = 0;
    double worst_mean = 0, worst_correlation = 0;
    constexpr int kCount = 4096;
    for (const int32 dimension : {0, 1, 100, 1024, 100000, 1 << 20}) {
      for (const int32 first : {0, 0x7fffffff - kCount}) {
        if (first > 0 && k.kind != kSobolSampler && k.kind != kIndependentSampler) continue;  // they count on frame.spp
        double sx = 0, sy = 0, sxy = 0, sxx = 0, sxn = 0, snn = 0, sn = 0;
        for (int32 i = 0; i < kCount; ++i) {
          const Vec2 u = sample_pair(frame, 12345, first + i, dimension), v = sample_pair(frame, 12345, first + i, dimension + 1);
          for (const float x : {u.x, u.y, v.x, v.y}) outside += !(x >= 0 && x < 1);
          const double x = static_cast<double>(u.x) - 0.5, y = static_cast<double>(u.y) - 0.5, n = static_cast<double>(v.x) - 0.5;
          sx += x, sy += y, sxy += x * y, sxx += x * x, sn += n, sxn += x * n, snn += n * n;
        }
        worst_mean = std::max({worst_mean, std::fabs(sx) / kCount, std::fabs(sy) / kCount});
        worst_correlation = std::max({worst_correlation, std::fabs(sxy) / sxx, std::fabs(sxn) / std::sqrt(sxx * snn)});
      }
    }
    c.equal(fmt::format("{}: numbers outside [0, 1)", k.name), static_cast<double>(outside), 0);
    c.at_most(fmt::format("{}: largest distance of a mean from 1/2", k.name), worst_mean, 5 * std::sqrt(1 / 12.0 / kCount));
    c.at_most(fmt::format("{}: largest correlation", k.name), worst_correlation, 5 / std::sqrt(double{kCount}));
  }
  c.remark("a sample's number has 31 bits: --spp and the scene reader accept no more");
}

void never_one(Case &c) {
  float largest = 0;
  for (std::uint32_t low = 0; low < 4096; ++low) largest = max_of(largest, unit_float(0xffffffffu - low));
  c.equal("largest uniform number + 2^-24", static_cast<double>(largest) + 0x1p-24, 1);
  c.equal("smallest uniform number", static_cast<double>(unit_float(0)), 0);
  // The corners of the unit square in every material.
  SceneText scene;
  for (const char *m : {R"({"name": "a", "type": "rough_diffuse"})", R"({"name": "b", "type": "conductor", "alpha": 0.3})",
                        R"({"name": "c", "type": "dielectric"})", R"({"name": "d", "type": "dielectric", "alpha": 0.3})",
                        R"({"name": "e", "type": "coated_diffuse"})", R"({"name": "f", "type": "principled", "clearcoat": 1})",
                        R"({"name": "g", "type": "phong"})", R"({"name": "h", "type": "blinn_phong"})", R"({"name": "i", "type": "hair"})",
                        R"({"name": "j", "type": "conductor", "roughness_x": 0.2, "roughness_y": 0.9, "multiple_scattering": true})"})
    scene.materials.push_back(m);
  const Stage stage = c.stage(scene);
  const float ends[] = {0.0f, 0x1p-24f, 0.5f, 1 - 0x1p-24f};
  std::int64_t bad = 0, samples = 0;
  for (const Material &m : stage.scene().materials)
    for (const float x : ends)
      for (const float y : ends)
        for (const float lobe : ends)
          for (const float z : {1.0f, 0.3f, 1e-4f}) {
            const Vec3 wo = {square_root(1 - z * z), 0, z};
            const BsdfSample s = sample_any(stage.scene().view(), m, 1, wo, {x, y}, lobe);
            bad += !all_finite(s.weight) || !is_finite(s.pdf) || s.pdf < 0 || !all_finite(s.wi);
            samples += 1;
          }
  c.equal(fmt::format("samples that are not finite, of {} at the ends of [0, 1)", samples), static_cast<double>(bad), 0);
}

void roulette(Case &c) {
  c.radiance("integrating sphere of albedo 0.8, roulette from the first bounce",
             integrating_sphere(0.8, R"("max_depth": 1000, "roulette_depth": 1)"), 32768, 5);
  c.radiance("the same without", integrating_sphere(0.8, R"("max_depth": 100, "roulette_depth": 100)"), 1024, 5);
  SceneText with = busy_room(), without = busy_room();
  with.integrator = R"("max_depth": 12, "roulette_depth": 1)";
  without.integrator = R"("max_depth": 12, "roulette_depth": 12)";
  without.sampler = R"("type": "independent", "seed": 2)";
  c.same_mean("a room with and without", with, without, 4096);
  // One channel only: weights of 1 / q on what has no luminance.
  SceneText blue = integrating_sphere(0.5, R"("max_depth": 1000, "roulette_depth": 1)");
  blue.materials = {material("wall", "diffuse", R"("reflectance": [0, 0.01, 0.9], "emission": [1, 1, 1], "two_sided": true)")};
  c.radiance("green of albedo 0.01 beside blue of 0.9", blue, 8192, 1 / (1 - static_cast<double>(0.01f)));
}

void depths(Case &c) {
  for (const int depth : {0, 1, 2, 5})
    c.radiance(fmt::format("integrating sphere of albedo 0.8 after {} bounces", depth),
               integrating_sphere(0.8, fmt::format(R"("roulette_depth": 100, "max_depth": {})", depth)), 1024,
               (1 - std::pow(0.8, depth + 1)) / 0.2);
  c.radiance("albedo 0.5 with up to 10^6 bounces", integrating_sphere(0.5, R"("max_depth": 1000000, "roulette_depth": 4)"), 16384, 2);
  SceneText scene = integrating_sphere(1, R"("max_depth": 70000, "roulette_depth": 70000)");
  scene.width = scene.height = 2;
  scene.materials = {material("wall", "mirror", R"("reflectance": 1, "emission": 1, "two_sided": true)")};
  scene.camera = camera({0, 0, 0}, {1, 0, 0}, 1, {0, 1, 0});
  c.exact_radiance("paths of 70000 bounces between mirrors of reflectance 1", scene, 70001, 1e-6);
}

void order(Case &c) {
  Stage stage = c.stage(busy_room());
  std::vector<double> means;
  const int spp = c.count(8, 64);
  for (const std::string &isa : c.isas()) {
    RenderOptions options;
    options.isa = isa;
    options.spp = spp;
    options.mode = c.mode();
    const Film reference = c.render(stage, options).film;
    means.push_back(measure(reference).mean);
    for (const int threads : {2, 7})
      for (const int tile : {1, 8, 64})
        for (const int wave : {16, 300}) {
          options.threads = threads;
          options.tile_size = tile;
          options.wave_size = wave;
          c.equal(with_isa(c, fmt::format("pixels that differ: {} threads, tiles of {}, waves of {}", threads, tile, wave), isa),
                  static_cast<double>(pixels_that_differ(c.render(stage, options).film, reference)), 0);
        }
    c.compare_schedules(stage, isa, 16);
  }
  for (std::size_t i = 1; i < means.size(); ++i)
    c.near(fmt::format("mean of {} against {}", c.isas()[i], c.isas()[0]), means[i], means[0], 2e-3 * means[0]);
  c.remark("processes of a distributed run are compared by its own tests");
}

void not_a_number(Case &c) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  volatile float zero = 0;
  c.holds("0 / 0 is no number", !is_finite(zero / zero));
  c.holds("1 / 0 is infinite", !is_finite(1 / zero) && 1 / zero > 3e38f);
  c.holds("NaN, infinities and the largest number are told apart",
          !is_finite(nan) && !is_finite(inf) && !is_finite(-inf) && is_finite(3.4028234e38f) && is_finite(-0.0f));
  c.holds("comparisons with NaN are false", !(nan < 1) && !(nan > 1) && !(nan == nan));
  c.holds("isnan of the library works", std::isnan(nan + zero));
#ifdef __FINITE_MATH_ONLY__
  c.equal("the compiler may assume finite numbers", __FINITE_MATH_ONLY__, 0);
#endif
  // Light that overflows, in the compiled kernels: each schedule has to count the same samples.
  SceneText scene = integrating_sphere(1, R"("max_depth": 8, "roulette_depth": 8)");
  scene.materials = {material("wall", "mirror", R"("reflectance": 1, "emission": 9e37, "two_sided": true)")};
  scene.camera = camera({0, 0, 0}, {1, 0, 0}, 1, {0, 1, 0});
  c.rejects("emission beyond 1e36", scene.text(), "emission");
  SceneDescription bright = [&] {
    SceneText sane = scene;
    sane.materials = {material("wall", "mirror", R"("reflectance": 1, "emission": 1, "two_sided": true)")};
    return c.stage(sane).description();
  }();
  bright.materials.back().emission = {9e37, 9e37, 9e37};
  Stage stage(bright);
  for (const std::string &isa : c.isas())
    for (const Mode mode : {Mode::kWavefront, Mode::kMegakernel, Mode::kDepthFirst}) {
      RenderOptions options;
      options.isa = isa;
      options.mode = mode;
      options.spp = 4;
      options.threads = 1;
      // Not by the case, which would count them against itself.
      const Plan plan = make_plan(stage.description(), stage.scene(), options);
      const RenderResult result = phalanx::render(stage.scene(), stage.accel(isa), plan, options);
      c.equal(with_isa(c, fmt::format("{}: samples that overflow, of 256", mode_name(mode)), isa),
              static_cast<double>(result.stats.invalid.count), 256);
    }
}

void small_budgets(Case &c) {
  for (const char *spp : {"0", "-1", "1.5", "4294967296"})
    c.rejects(fmt::format("{} samples a pixel", spp), fmt::format(R"({{"version": 1, "sampler": {{"spp": {}}}}})", spp), "spp");
  Stage stage = c.stage(busy_room());
  for (const std::string &isa : c.isas()) {
    RenderOptions options;
    options.isa = isa;
    options.time_limit_s = 1e-9;
    const RenderResult result = c.render(stage, options);
    std::int64_t least = 1 << 30, most = 0;
    for (std::int64_t i = 0; i < result.film.num_pixels(); ++i) {
      least = std::min(least, result.film.sample_count(i));
      most = std::max(most, result.film.sample_count(i));
    }
    c.at_least(with_isa(c, "samples a pixel after a budget of a nanosecond", isa), static_cast<double>(least), 1);
    c.equal(with_isa(c, "difference between pixels", isa), static_cast<double>(most - least), 0);
    options.time_limit_s = 0;
    options.spp = 1;
    options.threads = 7;
    options.width = options.height = 1;
    c.equal(with_isa(c, "pixels of a picture of 1 x 1 on 7 threads", isa),
            static_cast<double>(c.render(stage, options).film.num_pixels()), 1);
  }
}

}  // namespace

Group sampling_group() {
  return {"sampling",
          {{"Q1", "means of millions of samples", long_sums},
           {"Q2", "small variance of large numbers", small_variance},
           {"Q3", "pictures of more than 2^32 bytes", large_pictures},
           {"Q4", "samples and dimensions far out", late_samples},
           {"Q5", "uniform numbers are never 1", never_one},
           {"Q6", "Russian roulette does not change means", roulette},
           {"Q7", "depths from 0 to 70000", depths},
           {"Q8", "threads, tiles and waves do not change a bit", order},
           {"Q9", "NaN is recognised", not_a_number},
           {"Q10", "no samples, no time, no pixels to share", small_budgets}}};
}

}  // namespace phalanx::check
