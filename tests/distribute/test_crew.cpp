// A lease is a pure function, and leases in any cut add up to the picture of the plain renderer.
#include "distribute/crew.h"

#include <doctest/doctest.h>

#include "../support/scenes.h"
#include "distribute/messages.h"
#include "distribute/partition.h"
#include "distribute/screen_box.h"
#include "wavefront/isa.h"

using namespace phalanx;

namespace {

struct Stage {
  explicit Stage(bool aovs, int threads = 1)
      : built(test::build_file("scenes/cornell-glass.json", best_isa())) {
    options.isa = built.isa;
    options.width = 45;
    options.height = 38;
    options.spp = 29;
    options.aovs = aovs;
    options.threads = threads;
    plan = make_plan(built.description, built.scene, options);
  }
  test::BuiltScene built;
  RenderOptions options;
  Plan plan;
};

}  // namespace

TEST_CASE("crew: leases of odd rectangles and odd runs of samples give the bits of one rendering") {
  for (const bool aovs : {false, true}) {
    Stage s(aovs, 2);
    const RenderResult whole = render(s.built.scene, *s.built.accel, s.plan, s.options);
    TileRenderer tiles(s.built.scene, *s.built.accel, s.plan, s.options);
    Crew crew(tiles, s.plan);
    Film film(s.plan.crop, aovs);
    RayCounts rays;
    std::int64_t id = 0;
    for (const auto &[first, end] : {std::pair(0, 3), {3, 4}, {4, 20}, {20, 29}}) {
      const std::vector<Rect> parts = tiles_of(s.plan.crop, first == 3 ? 32 : 11);
      for (const Rect &r : parts) {
        Work work{{++id, r, first, end}, {}};
        if (first > 0) work.film = film.region_bytes(r);
        crew.give(work);
      }
      for (std::size_t came = 0; came < parts.size();)
        for (const Finished &f : crew.take(1)) {
          film.set_region(f.lease.rect, f.film);
          rays.camera += f.rays.camera;
          rays.bounce += f.rays.bounce;
          rays.shadow += f.rays.shadow;
          ++came;
        }
    }
    CHECK(test::pixels_that_differ(film, whole.film) == 0);
    CHECK(film.region_bytes(s.plan.crop) == whole.film.region_bytes(s.plan.crop));
    CHECK(rays.camera == whole.stats.rays.camera);
    CHECK(rays.bounce == whole.stats.rays.bounce);
    CHECK(rays.shadow == whole.stats.rays.shadow);
  }
}

TEST_CASE("crew: the same lease gives the same bytes, also by way of messages") {
  Stage s(false);
  TileRenderer tiles(s.built.scene, *s.built.accel, s.plan, s.options);
  const std::atomic<bool> stop = false;
  const Rect rect = {5, 6, 9, 14};
  Finished first, half, second, again;
  CHECK(render_lease(tiles, s.plan, {{1, rect, 0, 24}, {}}, 0, stop, first));
  CHECK(render_lease(tiles, s.plan, {{2, rect, 0, 10}, {}}, 0, stop, half));
  const Work rest = read_work(bytes_of(Work{{3, rect, 10, 24}, half.film}));
  CHECK(render_lease(tiles, s.plan, rest, 0, stop, second));
  CHECK(render_lease(tiles, s.plan, rest, 0, stop, again));
  CHECK(second.film == first.film);
  CHECK(again.film == first.film);
  const FinishedMessage back = read_finished(bytes_of(FinishedMessage{second, {}}));
  CHECK(back.finished.film == first.film);
  CHECK(back.finished.lease.id == 3);
  CHECK(back.finished.rays.total() == second.rays.total());
}

TEST_CASE("crew: stopping does not wait for what is left") {
  Stage s(false);
  TileRenderer tiles(s.built.scene, *s.built.accel, s.plan, s.options);
  Crew crew(tiles, s.plan);
  for (int i = 0; i < 1000; ++i) crew.give({{i, {0, 0, 32, 32}, 0, 4096}, {}});
  crew.stop();
  CHECK(crew.take(0).empty());
}

TEST_CASE("screen box: a cube before a camera, and one around it") {
  Stage s(false);
  Scene scene;
  FrameView frame = {};
  frame.width = 200;
  frame.height = 100;
  frame.camera = s.plan.frame.camera;
  frame.camera.kind = kPerspective;
  frame.camera.position = {0, 0, 0};
  frame.camera.right = {1, 0, 0};
  frame.camera.up = {0, 1, 0};
  frame.camera.forward = {0, 0, -1};
  frame.camera.tan_half_fov_y = 1;
  scene.bounds_lo = {-1, -1, -6};
  scene.bounds_hi = {1, 1, -4};
  const Rect box = screen_box(scene, frame);  // the near face: 1/4 of the height around the middle
  CHECK(box.x == 87);
  CHECK(box.width == 26);
  CHECK(box.y == 37);
  CHECK(box.height == 26);
  scene.bounds_hi.z = 1;
  CHECK(screen_box(scene, frame).width == 200);
}
