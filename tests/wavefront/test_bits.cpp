// The first law of this renderer: schedules, threads, tiles and waves do not change a bit.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "support/scenes.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

std::vector<std::string> all_scenes() {
  std::vector<std::string> files;
  for (const auto &entry : std::filesystem::directory_iterator(PHALANX_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".json")
      files.push_back("scenes/" + entry.path().filename().string());
  std::sort(files.begin(), files.end());
  return files;
}

RenderOptions small(Mode mode, int side, int spp) {
  RenderOptions o;
  o.mode = mode;
  o.width = o.height = side;
  o.spp = spp;
  o.threads = 1;
  o.aovs = true;
  return o;
}

/// Largest difference of pixel means, relative where a pixel is brighter than 1.
double largest_difference(const Film &a, const Film &b) {
  double worst = 0;
  for (std::int64_t i = 0; i < a.num_pixels(); ++i) {
    const Vec3 x = a.mean(i), d = abs3(x - b.mean(i));
    worst = std::max(worst, double(max_component(d)) / std::max(1.0, double(max_component(abs3(x)))));
  }
  return worst;
}

}  // namespace

TEST_CASE("schedules: wavefront, megakernel and depth-first give the same bits on every scene") {
  const std::vector<std::string> scenes = all_scenes();
  REQUIRE(scenes.size() >= 8);
  for (const std::string &file : scenes) {
    for (const std::string &isa : isas_here()) {
      CAPTURE(file);
      CAPTURE(isa);
      const BuiltScene scene = build_file(file, isa);
      const RenderResult depth_first = render_scene(scene, small(Mode::kDepthFirst, 64, 16));
      const RenderResult wavefront = render_scene(scene, small(Mode::kWavefront, 64, 16));
      CHECK(pixels_that_differ(wavefront.film, depth_first.film) == 0);
      CHECK(wavefront.stats.rays.camera == depth_first.stats.rays.camera);
      CHECK(wavefront.stats.rays.bounce == depth_first.stats.rays.bounce);
      CHECK(wavefront.stats.rays.shadow == depth_first.stats.rays.shadow);
      const RenderResult megakernel = render_scene(scene, small(Mode::kMegakernel, 64, 16));
      CHECK(pixels_that_differ(megakernel.film, depth_first.film) == 0);
      CHECK(megakernel.stats.rays.total() == depth_first.stats.rays.total());
      CHECK(depth_first.stats.invalid.count == 0);

      const RenderResult recursive = render_scene(scene, small(Mode::kRecursive, 64, 16));
      CHECK(largest_difference(recursive.film, depth_first.film) < 1e-4);
    }
  }
}

TEST_CASE("wavefront: wave size, tile size and threads do not change a bit") {
  for (const std::string &file : all_scenes()) {
    for (const std::string &isa : isas_here()) {
      CAPTURE(file);
      CAPTURE(isa);
      const BuiltScene scene = build_file(file, isa);
      // 30 pixels a side: tiles are cut off at the borders. 13 samples: passes of 8, 4 and 1.
      const RenderResult expected = render_scene(scene, small(Mode::kDepthFirst, 30, 13));
      for (int wave : {64, 100, 1024, 16384}) {
        RenderOptions o = small(Mode::kWavefront, 30, 13);
        o.wave_size = wave;
        CAPTURE(wave);
        CHECK(pixels_that_differ(render_scene(scene, o).film, expected.film) == 0);
      }
      for (int tile : {1, 8, 64}) {
        RenderOptions o = small(Mode::kWavefront, 30, 13);
        o.tile_size = tile;
        CAPTURE(tile);
        CHECK(pixels_that_differ(render_scene(scene, o).film, expected.film) == 0);
      }
      for (int threads : {2, 3}) {
        RenderOptions o = small(Mode::kWavefront, 30, 13);
        o.threads = threads;
        CAPTURE(threads);
        CHECK(pixels_that_differ(render_scene(scene, o).film, expected.film) == 0);
      }
    }
  }
}

TEST_CASE("wavefront: a crop window has the bits of the whole picture") {
  const BuiltScene scene = build_file("scenes/cornell-glass.json", isas_here().back());
  const RenderResult whole = render_scene(scene, small(Mode::kWavefront, 48, 8));
  for (const std::array<int, 4> crop : {std::array{7, 11, 20, 9}, std::array{31, 2, 1, 1}}) {
    RenderOptions o = small(Mode::kWavefront, 48, 8);
    o.crop = crop;
    const RenderResult part = render_scene(scene, o);
    int differ = 0;
    for (int y = 0; y < crop[3]; ++y)
      for (int x = 0; x < crop[2]; ++x) {
        const Vec3 a = part.film.mean(y * crop[2] + x);
        const Vec3 b = whole.film.mean((y + crop[1]) * 48 + x + crop[0]);
        differ += a.x != b.x || a.y != b.y || a.z != b.z;
      }
    CHECK(differ == 0);
  }
}

TEST_CASE("wavefront: another seed gives another picture, the same seed the same") {
  const BuiltScene scene = build_file("scenes/cornell-box.json", isas_here().back());
  RenderOptions o = small(Mode::kWavefront, 32, 4);
  o.seed = 5;
  const RenderResult a = render_scene(scene, o);
  CHECK(pixels_that_differ(a.film, render_scene(scene, o).film) == 0);
  o.seed = 6;
  CHECK(pixels_that_differ(a.film, render_scene(scene, o).film) > 900);
}

TEST_CASE("wavefront: stages that work on lists fill their gangs") {
  const BuiltScene scene = build_file("scenes/cornell-glass.json", isas_here().front());
  const RenderResult r = render_scene(scene, small(Mode::kWavefront, 64, 16));
  std::int64_t active = 0, total = 0;
  for (const StageStats &s : r.stats.stages) {
    // These two look at every slot, also while the last paths of a tile end.
    if (s.name == "compact" || s.name == "bucket") continue;
    active += s.lanes_active;
    total += s.lanes_total;
  }
  CHECK(double(active) > 0.95 * double(total));
}
