// Hair of every sort of material, in instances and with holes: schedules do not change a bit.
#include <doctest/doctest.h>

#include "support/scenes.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

const char *const kScene = R"({"version": 1,
  "camera": {"position": [0, 1, 5], "look_at": [0, 0, 0], "fov": 40},
  "materials": [
    {"name": "hair", "type": "hair", "reflectance": [0.6, 0.3, 0.15]},
    {"name": "grey", "type": "diffuse", "reflectance": 0.6},
    {"name": "metal", "type": "conductor", "metal": "copper", "roughness": 0.3},
    {"name": "glass", "type": "dielectric"},
    {"name": "film", "type": "thin_dielectric"},
    {"name": "gauze", "type": "diffuse", "opacity": 0.5},
    {"name": "lamp", "type": "black", "emission": 8}],
  "lights": [{"type": "environment", "radiance": [0.3, 0.4, 0.5]}],
  "shapes": [
    {"type": "quad", "material": "grey", "corner": [-9, -1.6, 9], "edge_u": [18, 0, 0], "edge_v": [0, 0, -18]},
    {"type": "quad", "material": "lamp", "corner": [-1, 4, -1], "edge_u": [2, 0, 0], "edge_v": [0, 0, 2]},
    {"type": "sphere", "material": "grey", "center": [0, 0, 0], "radius": 0.7},
    {"type": "fur", "material": "hair", "radius": 0.7, "count": 3000, "length": 0.3, "thickness": [0.02, 0.005]},
    {"type": "fur", "material": "metal", "radius": 0.7, "count": 300, "length": 0.5, "thickness": 0.03, "seed": 1}],
  "groups": [{"name": "tuft", "shapes": [
    {"type": "icosphere", "material": "grey", "radius": 0.3, "subdivisions": 2},
    {"type": "fur", "material": "grey", "radius": 0.3, "count": 500, "length": 0.3, "thickness": 0.02, "curl": 0.2},
    {"type": "fur", "material": "glass", "radius": 0.3, "count": 100, "length": 0.4, "thickness": 0.04, "seed": 2},
    {"type": "fur", "material": "film", "radius": 0.3, "count": 100, "length": 0.4, "thickness": 0.04, "seed": 3},
    {"type": "curves", "material": "gauze", "radius": [0.2, 0.05], "basis": "bspline",
     "strands": [[[0, 0, 0], [0, 0.5, 0], [0.5, 0.5, 0.5]]]}]}],
  "instances": [
    {"group": "tuft", "transform": [{"rotate": {"axis": [1, 2, 3], "angle": 70}}, {"translate": [1.4, -0.3, 0.5]}]},
    {"group": "tuft", "transform": [{"scale": -1.5}, {"translate": [-1.6, -0.2, 0.3]}]}]})";

RenderOptions small(Mode mode) {
  RenderOptions o;
  o.mode = mode;
  o.width = o.height = 64;
  o.spp = 16;
  o.threads = 1;
  o.aovs = true;
  return o;
}

}  // namespace

TEST_CASE("curves: wavefront, megakernel and depth-first give the same bits") {
  for (const std::string &isa : isas_here()) {
    CAPTURE(isa);
    const BuiltScene scene = build_text(kScene, isa);
    const RenderResult depth_first = render_scene(scene, small(Mode::kDepthFirst));
    const RenderResult wavefront = render_scene(scene, small(Mode::kWavefront));
    CHECK(pixels_that_differ(wavefront.film, depth_first.film) == 0);
    CHECK(wavefront.stats.rays.total() == depth_first.stats.rays.total());
    CHECK(pixels_that_differ(render_scene(scene, small(Mode::kMegakernel)).film,
                             depth_first.film) == 0);
    CHECK(depth_first.stats.invalid.count == 0);
  }
}
