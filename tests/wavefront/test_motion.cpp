// Motion blur: schedules do not change a bit, and the blur is the mean over the shutter.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "../../kernels/physics/motion.h"
#include "support/scenes.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

RenderOptions options(Mode mode, int side, int spp) {
  RenderOptions o;
  o.mode = mode;
  o.width = o.height = side;
  o.spp = spp;
  o.threads = 1;
  return o;
}

/// A group of every shape, with a glass sphere and holes, that moves as told; another that rests.
std::string scene_text(const std::string &motion) {
  return R"({"version": 1,
  "camera": {"position": [0, 1, 6], "look_at": [0, 0, 0], "fov": 40},
  "film": {"width": 64, "height": 64, "filter": {"type": "box"}},
  "materials": [
    {"name": "grey", "type": "diffuse", "reflectance": 0.6},
    {"name": "glass", "type": "dielectric"},
    {"name": "metal", "type": "conductor", "metal": "gold", "roughness": 0.3},
    {"name": "gauze", "type": "diffuse", "opacity": 0.5},
    {"name": "lamp", "type": "black", "emission": 10}],
  "lights": [{"type": "environment", "radiance": [0.3, 0.4, 0.5]}],
  "shapes": [
    {"type": "quad", "material": "grey", "corner": [-9, -1.2, 9], "edge_u": [18, 0, 0], "edge_v": [0, 0, -18]},
    {"type": "quad", "material": "lamp", "corner": [-1, 4, -1], "edge_u": [2, 0, 0], "edge_v": [0, 0, 2]}],
  "groups": [{"name": "things", "shapes": [
    {"type": "torus_knot", "material": "metal", "radius": 0.4, "tube_radius": 0.1, "segments": 100, "sides": 12},
    {"type": "sphere", "material": "glass", "center": [0.9, 0, 0], "radius": 0.3},
    {"type": "disk", "material": "gauze", "center": [0, 0.8, 0], "normal": [0, 1, 1], "radius": 0.4},
    {"type": "quad", "material": "grey", "corner": [-1.2, -0.4, 0], "edge_u": [0.5, 0, 0.2], "edge_v": [0, 0.7, 0]}]}],
  "instances": [
    {"group": "things", )" + motion + R"(},
    {"group": "things", "transform": {"translate": [1.3, 0.2, -1]}}]})";
}

const char *const kMotion = R"("transform": {"translate": [-1, 0, 0]},
  "transform_end": [{"rotate": {"axis": [1, 2, 3], "angle": 50}}, {"scale": 1.3}, {"translate": [-0.6, 0.3, 0.4]}])";

}  // namespace

TEST_CASE("motion: wavefront, megakernel and depth-first give the same bits") {
  for (const std::string &isa : isas_here()) {
    CAPTURE(isa);
    const BuiltScene scene = build_text(scene_text(kMotion), isa);
    const RenderResult depth_first = render_scene(scene, options(Mode::kDepthFirst, 64, 16));
    const RenderResult wavefront = render_scene(scene, options(Mode::kWavefront, 64, 16));
    CHECK(pixels_that_differ(wavefront.film, depth_first.film) == 0);
    CHECK(wavefront.stats.rays.total() == depth_first.stats.rays.total());
    CHECK(pixels_that_differ(render_scene(scene, options(Mode::kMegakernel, 64, 16)).film,
                             depth_first.film) == 0);
    RenderOptions waves = options(Mode::kWavefront, 64, 16);
    waves.wave_size = 100;
    waves.tile_size = 8;
    waves.threads = 2;
    CHECK(pixels_that_differ(render_scene(scene, waves).film, depth_first.film) == 0);
    CHECK(depth_first.stats.invalid.count == 0);
  }
}

TEST_CASE("motion: an instance that ends where it began is one that rests") {
  const std::string isa = isas_here().back();
  const std::string place = R"([{"rotate": {"axis": [1, 2, 3], "angle": 50}}, {"translate": [-0.6, 0.3, 0.4]}])";
  const BuiltScene moves = build_text(
      scene_text("\"transform\": " + place + ", \"transform_end\": " + place), isa);
  const BuiltScene rests = build_text(scene_text("\"transform\": " + place), isa);
  CHECK(moves.scene.motions.size() == 2);
  CHECK(rests.scene.motions.empty());
  const RenderResult a = render_scene(moves, options(Mode::kWavefront, 32, 256));
  const RenderResult b = render_scene(rests, options(Mode::kWavefront, 32, 256));
  double difference = 0, sum = 0;
  for (std::int64_t i = 0; i < a.film.num_pixels(); ++i) {
    difference += static_cast<double>(std::fabs(a.film.mean(i).y - b.film.mean(i).y));
    sum += static_cast<double>(b.film.mean(i).y);
  }
  CHECK(difference / sum < 0.01);  // the same samples but for rounding; a few paths part
}

TEST_CASE("motion: a black square that crosses the picture darkens it evenly") {
  const BuiltScene scene = build_text(R"({"version": 1,
    "camera": {"position": [0, 0, 1], "look_at": [0, 0, 0], "fov": 90},
    "film": {"width": 20, "height": 20, "filter": {"type": "box"}},
    "materials": [{"name": "black", "type": "black"}],
    "lights": [{"type": "environment", "radiance": 1}],
    "groups": [{"name": "square", "shapes": [
      {"type": "quad", "material": "black", "corner": [-3, -2, 0], "edge_u": [2, 0, 0], "edge_v": [0, 4, 0]}]}],
    "instances": [{"group": "square", "transform_end": {"translate": [2, 0, 0]}}]})",
                                      isas_here().back());
  const RenderResult r = render_scene(scene, options(Mode::kWavefront, 20, 1024));
  double worst = 0;
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 20; ++x)  // its right edge goes from -1 to 1: seen for (x + 0.5) / 20 of the time
      worst = std::max(worst, std::fabs(static_cast<double>(r.film.mean(20 * y + x).y) - (x + 0.5) / 20));
  CHECK(worst < 0.01);  // stratified: 1024 independent samples would be off by 0.05
}

TEST_CASE("motion: the picture is the mean of pictures of the interpolated transforms") {
  const std::string isa = isas_here().back();
  const BuiltScene blurred = build_text(scene_text(kMotion), isa);
  const RenderResult r = render_scene(blurred, options(Mode::kWavefront, 16, 4096));
  std::vector<double> mean(256, 0);
  const Affine a = blurred.scene.instances[0].to_world, b = blurred.scene.motions[0].to_world_end;
  constexpr int kTimes = 32;
  for (int i = 0; i < kTimes; ++i) {
    const Affine m = mix_affine(a, b, (static_cast<float>(i) + 0.5f) / kTimes);
    const std::string place = fmt::format(
        "\"transform\": {{\"matrix\": [{},{},{},{}, {},{},{},{}, {},{},{},{}, 0,0,0,1]}}", m.m00,
        m.m01, m.m02, m.m03, m.m10, m.m11, m.m12, m.m13, m.m20, m.m21, m.m22, m.m23);
    const RenderResult still =
        render_scene(build_text(scene_text(place), isa), options(Mode::kWavefront, 16, 256));
    for (std::int64_t p = 0; p < 256; ++p)
      mean[static_cast<std::size_t>(p)] += static_cast<double>(still.film.mean(p).y) / kTimes;
  }
  double difference = 0, sum = 0;
  for (std::int64_t p = 0; p < 256; ++p) {
    difference += std::fabs(static_cast<double>(r.film.mean(p).y) - mean[static_cast<std::size_t>(p)]);
    sum += mean[static_cast<std::size_t>(p)];
  }
  CHECK(difference / sum < 0.02);
}
