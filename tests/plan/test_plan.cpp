#include <doctest/doctest.h>

#include <algorithm>

#include "core/error.h"
#include "plan/plan.h"
#include "support/scenes.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {
bool has(const std::vector<std::string> &list, const std::string &name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}
Plan plan_of(const std::string &file, RenderOptions o = {}) {
  const BuiltScene b = build_file(file, isas_here().front());
  return make_plan(b.description, b.scene, o);
}
}  // namespace

TEST_CASE("plan: a diffuse scene costs at most 128 bytes a path and loads no other shader") {
  const Plan plan = plan_of("scenes/cornell-box.json");
  CHECK(plan.bytes_per_path() <= 128);
  CHECK(has(plan.kernels, "shade_diffuse"));
  CHECK(has(plan.kernels, "shadow"));
  CHECK_FALSE(has(plan.kernels, "shade_dielectric"));
  CHECK_FALSE(has(plan.kernels, "shade_conductor"));
  CHECK_FALSE(has(plan.kernels, "aov"));
}

TEST_CASE("plan: without lights to sample there is no shadow queue") {
  const Plan with = plan_of("scenes/cornell-box.json"), without = plan_of("scenes/displaced-sphere.json");
  CHECK_FALSE(has(without.kernels, "shadow"));
  CHECK(without.bytes_per_path() == with.bytes_per_path() - 44);
  bool said = false;
  for (const LeftOut &l : without.left_out) said |= l.feature.find("shadow") != l.feature.npos && l.bytes_per_path == 44;
  CHECK(said);
}

TEST_CASE("plan: a thread needs less than 16 MB beyond the scene") {
  RenderOptions o;
  o.aovs = true;
  for (const char *file : {"scenes/cornell-box.json", "scenes/many-spheres.json"}) {
    CHECK(plan_of(file, o).wave_bytes() <= 16'000'000);
  }
}

TEST_CASE("plan: says what rendering then allocates") {
  const BuiltScene b = build_file("scenes/cornell-glass.json", isas_here().front());
  RenderOptions o;
  o.spp = 1;
  o.width = o.height = 16;
  o.threads = 1;
  const Plan plan = make_plan(b.description, b.scene, o);
  const RenderResult r = render_scene(b, o);
  CHECK(double(r.stats.wave_bytes_per_thread) == doctest::Approx(double(plan.wave_bytes())).epsilon(0.01));
}

TEST_CASE("plan: pictures that cannot be are refused") {
  const BuiltScene b = build_file("scenes/cornell-box.json", isas_here().front());
  const auto refuse = [&](auto change) {
    RenderOptions o;
    change(o);
    CHECK_THROWS_AS(make_plan(b.description, b.scene, o), InputError);
  };
  refuse([](RenderOptions &o) { o.width = 70000, o.height = 1; });
  refuse([](RenderOptions &o) { o.crop = {500, 0, 13, 1}; });
  refuse([](RenderOptions &o) { o.crop = {-1, 0, 2, 2}; });
  refuse([](RenderOptions &o) { o.tile_size = 12; });
  refuse([](RenderOptions &o) { o.wave_size = 3; });
}

TEST_CASE("plan: blue noise is refused where its numbers do not suffice") {
  BuiltScene b = build_file("scenes/cornell-box.json", isas_here().front());
  b.description.sampler.kind = kBlueNoiseSampler;
  RenderOptions o;
  o.width = 4096, o.height = 100, o.spp = 256;  // 2^24 places along the curve
  CHECK(make_plan(b.description, b.scene, o).frame.spp == 256);
  o.spp = 257;
  CHECK_THROWS_AS(make_plan(b.description, b.scene, o), InputError);
  b.description.sampler.kind = kSobolSampler;
  CHECK(make_plan(b.description, b.scene, o).spp == 257);
}

TEST_CASE("plan: recursive refuses depths that its stack does not hold") {
  RenderOptions o;
  o.mode = Mode::kRecursive;
  o.max_depth = kMaxRecursiveDepth;
  CHECK(plan_of("scenes/cornell-box.json", o).frame.max_depth == kMaxRecursiveDepth);
  o.max_depth += 1;
  CHECK_THROWS_AS(plan_of("scenes/cornell-box.json", o), InputError);
  o.mode = Mode::kDepthFirst;
  CHECK(plan_of("scenes/cornell-box.json", o).frame.max_depth == kMaxRecursiveDepth + 1);
}
