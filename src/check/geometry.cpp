// Geometry that is degenerate, coincident, grazing or leaky.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../kernels/physics/light.h"
#include "../core/timer.h"
#include "../scene/trace.h"
#include "case.h"
#include "groups.h"
#include "statistics.h"
#include "tracing.h"

namespace phalanx::check {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

SceneText under_the_sky() {
  SceneText scene;
  scene.camera = camera({0, 0, 5}, {0, 0, 0}, 40, {0, 1, 0});
  scene.lights = {kSky};
  return scene;
}

/// A floor lit by a mesh lamp overhead with these triangles of four points in a plane.
SceneText lit_by(const std::string &triangles) {
  SceneText scene;
  scene.shapes = {level("grey", 2, 0),
                  mesh("lamp", R"("positions": [[0,1,0],[1,1,0],[2,1,0],[0,1,1]], "indices": )" + triangles)};
  return scene;
}

void triangles_without_area(Case &c) {
  const auto scene_with = [](const std::string &triangles) {
    SceneText scene = under_the_sky();
    scene.shapes = {mesh("grey", R"("positions": [[0,0,0],[1,0,0],[2,0,0],[0,1,0],[1,0,0]], "indices": )" + triangles)};
    return scene;
  };
  const SceneText clean = scene_with("[[0,1,3]]");
  const SceneText dirty = scene_with("[[0,1,2],[0,1,3],[1,1,3],[1,4,3]]");
  c.same_bits("with and without collinear, repeated index, repeated vertex", dirty, clean);
  Stage stage = c.stage(dirty);
  c.equal("triangles left out", static_cast<double>(stage.scene().num_dropped), 3);
  c.equal("notes about them", static_cast<double>(stage.scene().notes.size()), 1);
}

void lamps_without_area(Case &c) {
  const SceneText dirty = lit_by("[[0,1,2],[0,1,3],[1,1,3]]");
  c.same_bits("with and without faces of no area", dirty, lit_by("[[0,1,3]]"), c.count(64, 1024));
  c.equal("lights", static_cast<double>(c.stage(dirty).scene().lights.size()), 1);
}

void numbers_that_are_none(Case &c) {
  SceneText scene = under_the_sky();
  scene.textures = {R"({"name": "tiles", "type": "checker"})"};
  scene.materials = {material("tiled", "diffuse", R"("reflectance": "tiles")")};
  scene.shapes = {mesh("tiled", R"("positions": [[-1,-1,0],[1,-1,0],[0,1,0]], "indices": [[0,1,2]],
    "normals": [[0,0,1],[0,0,1],[0,0,1]], "uvs": [[0,0],[1,0],[0,1]])")};
  const SceneDescription good = c.stage(scene).description();
  for (const float bad : {kNan, kInf, -kInf}) {
    const auto with = [&](const auto &change) {
      SceneDescription description = good;
      change(std::get<MeshShape>(description.shapes[0].shape).data);
      return description;
    };
    const std::string value = fmt::format("{}", bad);
    c.rejects("a vertex with " + value, with([&](MeshData &m) { m.positions[4] = bad; }), "vertex 1");
    c.rejects("texture coordinates with " + value, with([&](MeshData &m) { m.uvs[3] = bad; }), "vertex 1");
    Stage replaced(with([&](MeshData &m) { m.normals[4] = bad; }));
    c.equal("notes about a normal with " + value, static_cast<double>(replaced.scene().notes.size()), 1);
    for (const std::string &isa : c.isas())
      c.within(with_isa(c, "mean with that normal replaced", isa), measure(c.film(replaced, 16, isa)).mean, 0.1, 1);
  }
  c.rejects("1e999 in a scene file", R"({"version": 1, "shapes": [{"type": "mesh", "material": "m",
    "positions": [[0,0,1e999],[1,0,0],[0,1,0]], "indices": [[0,1,2]]}], "materials": [{"name": "m", "type": "black"}]})",
            "/shapes/0");
}

/// Rays straight down on the square [0,1]^2 of the plane z = 0; how many go through it.
std::int64_t rays_through_square(const SceneView &view, int rays, float lo, float hi) {
  Random random(3);
  std::int64_t lost = 0;
  for (int i = 0; i < rays; ++i) {
    const Vec3 to = {random.between(lo, hi), random.between(lo, hi), 0};
    const Vec3 from = {random.between(-1, 2), random.between(-1, 2), random.between(0.5f, 3)};
    lost += trace_closest(view, from, normalize(to - from)).geometry < 0;
  }
  return lost;
}

void slivers(Case &c) {
  SceneText scene = under_the_sky();
  scene.shapes = {mesh("grey", R"("positions": [[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0.4999999,0.5000001,0]],
    "indices": [[0,1,2],[0,2,4],[0,4,3],[4,2,3]])")};
  Stage square = c.stage(scene);
  scene.shapes = {mesh("grey", R"("positions": [[0,0,0],[1e4,0,0],[1e4,1e-4,0],[0,1e-4,0]], "indices": [[0,1,2],[0,2,3]])")};
  Stage needle = c.stage(scene);
  const int rays = c.count(100000, 2000000);
  for (const std::string &isa : c.isas()) {
    c.equal(with_isa(c, "rays lost in a square with a sliver 1e-7 wide on its diagonal", isa),
            static_cast<double>(rays_through_square(square.view(isa), rays, 1e-3f, 1 - 1e-3f)), 0);
    const SceneView view = needle.view(isa);
    Random random(4);
    std::int64_t wrong = 0, outside = 0;
    for (int i = 0; i < rays; ++i) {
      const float y = random.between(-1e-4f, 2e-4f);
      const Vec3 from = {random.between(1, 9999), y, 1};
      const Landing l = land(view, from, {0, 0, -1});
      const bool inside = y > 1e-7f && y < 1e-4f - 1e-7f, beyond = y < -1e-7f || y > 1e-4f + 1e-7f;
      wrong += (inside && !l.landed()) || (beyond && l.landed());
      if (l.landed())
        outside += l.surface.position.y < 0 || l.surface.position.y > 1e-4f || l.surface.position.x < 0 ||
                   l.surface.position.x > 1e4f;
    }
    c.at_most(with_isa(c, "wrong hits and misses on a needle 1e4 long and 1e-4 wide", isa),
              static_cast<double>(wrong) / rays, 1e-6);
    c.equal(with_isa(c, "points of hits outside the needle", isa), static_cast<double>(outside), 0);
  }
}

/// Rays from near the middle aimed exactly at vertices, or at points of edges.
std::int64_t lost_rays_at(bool vertices, const SceneView &view, const Scene &scene, Vec3 middle, int rays) {
  Random random(6);
  std::int64_t lost = 0;
  const auto at = [&](int32 v) { return load_vec3(scene.positions.data(), v); };
  for (int i = 0; i < rays; ++i) {
    const Triangle &t = scene.triangles[static_cast<std::size_t>(random.below(static_cast<int>(scene.triangles.size())))];
    const float share = random.between(0.1f, 0.9f);
    const Vec3 target = vertices ? at(t.v0) : at(t.v0) * (1 - share) + at(t.v1) * share;
    const Vec3 from = middle + random.point(0.5f);
    lost += trace_closest(view, from, normalize(target - from)).geometry < 0;
  }
  return lost;
}

void closed_meshes_do_not_leak(Case &c) {
  SceneText scene = under_the_sky();
  const int subdivisions = c.count(5, 7);
  scene.shapes = {fmt::format(R"({{"type": "icosphere", "material": "grey", "radius": 2, "subdivisions": {}}})", subdivisions)};
  Stage here = c.stage(scene);
  // In memory, past the reader, which would move it back to the origin.
  const Vec3 place = {148376, 1234, -223423};
  SceneDescription moved = here.description();
  for (int i = 0; i < 3; ++i) moved.shapes[0].transform.m[i][3] = static_cast<double>((&place.x)[i]);
  Stage there(moved);
  const int rays = c.count(100000, 10000000), edge_rays = c.count(20000, 1000000);
  for (const std::string &isa : c.isas()) {
    for (Stage *stage : {&here, &there}) {
      const Vec3 middle = stage == &here ? Vec3{0, 0, 0} : place, reach = {1, 1, 1};
      const char *where = stage == &here ? "at the origin" : "at (148376, 1234, -223423)";
      const int n = stage == &here ? rays / 10 : rays;
      c.equal(with_isa(c, fmt::format("{} random rays lost {}", n, where), isa),
              static_cast<double>(lost_rays(stage->view(isa), middle - reach, middle + reach, n, 9)), 0);
      c.at_most(with_isa(c, fmt::format("share of {} rays at edges lost {}", edge_rays, where), isa),
                static_cast<double>(lost_rays_at(false, stage->view(isa), stage->scene(), middle, edge_rays)) / edge_rays,
                stage == &here ? 0 : 2e-3);
      c.at_most(with_isa(c, fmt::format("share of {} rays at vertices lost {}", edge_rays, where), isa),
                static_cast<double>(lost_rays_at(true, stage->view(isa), stage->scene(), middle, edge_rays)) / edge_rays, 0.03);
    }
  }
  c.remark("a ray aimed exactly at a vertex can slip through between the triangles around it: the ray query decides each "
           "edge by itself. Up to 3 % of such rays are accepted; none of the random ones is lost");
  c.remark("far from the origin vertices are rounded to steps of 1/64 m, about as long as the finest edges: triangles collapse, "
           "and neighbours no longer share all of their edges. Up to 0.2 % of the rays aimed at such edges are accepted");
}

void coincident_surfaces(Case &c) {
  const auto twice = [](const std::string &first, const std::string &second) {
    SceneText scene = under_the_sky();
    scene.materials = {material("dark", "diffuse", R"("reflectance": 0.2)"), material("glass", "dielectric", R"("ior": 1.5)")};
    scene.shapes = {quad(first, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}), quad(second, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0})};
    return scene;
  };
  c.radiance("the first of two diffuse quads is seen", twice("grey", "dark"), 1024, 0.5);
  c.radiance("the other way round", twice("dark", "grey"), 1024, 0.2);
  c.radiance("a lamp before grey", twice("lamp", "grey"), 256, 1);
  c.equal("lights of grey before a lamp", static_cast<double>(c.stage(twice("grey", "lamp")).scene().lights.size()), 0);
  SceneText balls = under_the_sky();
  balls.integrator = R"("max_depth": 1000, "roulette_depth": 1000)";
  balls.materials = {material("glass", "dielectric", R"("ior": 1.5)")};
  balls.shapes = {sphere("glass", {0, 0, 0}, 1), sphere("glass", {0, 0, 0}, 1)};
  c.radiance("two glass balls in one place under a white sky", balls, 4096, 1, 1e-3);
  balls.shapes = {R"({"type": "icosphere", "material": "glass", "subdivisions": 2})", R"({"type": "icosphere", "material": "grey", "subdivisions": 2})"};
  // Facets hold some light for longer than any depth.
  c.bounded_radiance("a glass mesh and a grey one in one place", balls, 1024, 0.98, 1.001);
  Stage stage = c.stage(twice("grey", "dark"));
  for (const std::string &isa : c.isas()) {
    RenderOptions options;
    options.isa = isa;
    options.spp = 16;
    const Film one = c.render(stage, options).film;
    options.threads = 2;
    options.tile_size = 2;
    c.equal(with_isa(c, "pixels that differ with other threads and tiles", isa),
            static_cast<double>(pixels_that_differ(one, c.render(stage, options).film)), 0);
  }
}

/// `count` triangles; all the same, or side by side.
SceneDescription many_triangles(const Case &c, int count, bool same, const char *of) {
  SceneText scene = under_the_sky();
  scene.shapes = {mesh(of, R"("positions": [[0,0,0],[1,0,0],[0,1,0]], "indices": [[0,1,2]])")};
  SceneDescription description = c.stage(scene).description();
  MeshData &data = std::get<MeshShape>(description.shapes[0].shape).data;
  data.positions.clear();
  data.indices.clear();
  for (int i = 0; i < count; ++i) {
    const float x = same ? 0.0f : static_cast<float>(i % 317) * 2, y = same ? 0.0f : static_cast<float>(i / 317) * 2;
    for (const float v : {x, y, 0.0f, x + 1, y, 0.0f, x, y + 1, 0.0f}) data.positions.push_back(v);
    for (int k = 0; k < 3; ++k) data.indices.push_back(3 * i + k);
  }
  return description;
}

double build_seconds(const SceneDescription &description, const std::string &isa) {
  double least = 1e9;
  for (int run = 0; run < 3; ++run) {
    const double start = cpu_seconds();
    Stage stage(description);
    stage.accel(isa);
    least = std::min(least, cpu_seconds() - start);
  }
  return least;
}

void everything_on_one_spot(Case &c) {
  const int count = c.count(20000, 100000);
  const std::string isa = c.isas().back();
  for (const char *of : {"grey", "lamp"}) {
    const double apart = build_seconds(many_triangles(c, count, false, of), isa);
    const double together = build_seconds(many_triangles(c, count, true, of), isa);
    c.at_most(fmt::format("{} {} triangles: seconds to build over seconds for as many side by side", count, of),
              together / apart, 3);
  }
  SceneDescription lamps = many_triangles(c, 1000, true, "lamp");
  lamps.has_environment = false;
  lamps.camera.position = {0.3, 0.3, 1};
  lamps.camera.look_at = {0.3, 0.3, 0};
  lamps.camera.fov = 1;
  Stage stage(lamps);
  for (const std::string &used : c.isas())
    c.near(with_isa(c, "radiance of 1000 lamps on one spot", used), measure(c.film(stage, 4, used)).mean, 1, 0);
}

void grazing(Case &c) {
  SceneText scene;
  scene.camera = camera({-1e3, 1e-3, 0}, {0, 0, 0}, 1e-5, {0, 1, 0});
  scene.lights = {kSky};
  scene.shapes = {level("grey", 1e4, 0)};
  c.radiance("a floor seen at a cosine of 1e-6 under a white sky", scene, 16384, 0.5, 1e-4);
  scene.camera = SceneText().camera;
  for (const double cosine : {1e-3, 1e-6}) {
    scene.lights = {sun({1, -cosine, 0}, 1 / cosine)};
    c.exact_radiance(fmt::format("a floor lit at a cosine of {:g}", cosine), scene,
                     0.5 / kPi / std::sqrt(1 + cosine * cosine), 1e-5);
  }
}

void in_and_on_spheres(Case &c) {
  const auto inside = [](Double3 at, Double3 normal) {
    SceneText scene;
    const double h = 1e-3;
    const Double3 u = std::fabs(normal[0]) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0};
    const Double3 v = {normal[1] * u[2] - normal[2] * u[1], normal[2] * u[0] - normal[0] * u[2],
                       normal[0] * u[1] - normal[1] * u[0]};
    Double3 corner, eu, ev, eye;
    for (std::size_t i = 0; i < 3; ++i) {
      eu[i] = 2 * h * u[i];
      ev[i] = 2 * h * v[i];
      corner[i] = at[i] - h * (u[i] + v[i]);
      eye[i] = at[i] + 1e-3 * normal[i];
    }
    scene.camera = camera(eye, at, 1, u);
    scene.materials = {emitter("walls", 1, R"("two_sided": true)")};
    scene.shapes = {sphere("walls", {0, 0, 0}, 1), quad("grey", corner, eu, ev)};
    return scene;
  };
  struct Place {
    const char *what;
    Double3 at, normal;
  };
  for (const Place &p : {Place{"in the middle", {0, 0, 0}, {0, 1, 0}}, Place{"off the middle", {0.3, 0.5, 0.1}, {0, 0, 1}},
                         Place{"near the wall, facing away", {0.995, 0, 0}, {-1, 0, 0}},
                         Place{"near the wall, facing it", {0.995, 0, 0}, {1, 0, 0}}})
    c.radiance(fmt::format("diffuse 0.5 {} of a sphere of radiance 1", p.what), inside(p.at, p.normal), 16384, 0.5);

  // Light samples for points in, on and next to the sphere.
  Stage stage = c.stage(inside({0, 0, 0}, {0, 1, 0}));
  const SceneView view = stage.scene().view();
  Random random(12);
  std::int64_t bad = 0, useful = 0;
  for (const float r : {0.0f, 0.5f, std::nextafter(1.0f, 0.0f), 1.0f, std::nextafter(1.0f, 2.0f), 1.5f})
    for (int i = 0; i < 2000; ++i) {
      const LightSample s = sample_light(view, random.direction() * r, random.square(), random.square());
      useful += s.pdf > 0;
      bad += s.pdf != 0 && !(is_finite(s.pdf) && s.pdf > 0 && all_finite(s.direction) && is_finite(s.distance));
    }
  c.equal("light samples that are not finite, for points in, on and off the sphere", static_cast<double>(bad), 0);
  c.at_least("usable light samples, of 12000", static_cast<double>(useful), 11000);

  SceneText scene;
  scene.materials = {emitter("walls", 1, R"("two_sided": true)")};
  scene.shapes = {sphere("walls", {0, 0, 0}, 1)};
  const double ulp = 0x1p-23;
  for (const double z : {0.0, 0.5, 1 - ulp / 2, 1.0, 1 + ulp}) {
    scene.camera = camera({0, 0, z}, {0, 0, -5}, 30, {0, 1, 0});
    c.exact_radiance(fmt::format("seen from {:.8g} radii, inwards", z), scene, 1);
  }
  scene.camera = camera({0, 0, 1 + 2 * ulp}, {0, 0, 5}, 30, {0, 1, 0});
  c.exact_radiance("seen from just outside, outwards", scene, 0);
}

void radii(Case &c) {
  for (const char *radius : {"0", "-1", "1e19", "1e999"}) {
    SceneText scene = under_the_sky();
    scene.shapes = {fmt::format(R"({{"type": "sphere", "material": "grey", "center": [0,0,0], "radius": {}}})", radius)};
    c.rejects(fmt::format("radius {}", radius), scene.text(), "/shapes/0");
  }
  for (const double radius : {1e-20, 1e-17, 1e-10}) {
    SceneText scene = under_the_sky();
    scene.shapes = {sphere("black", {0, 0, 0}, radius)};
    c.exact_radiance(fmt::format("radius {:g} is too small to be seen", radius), scene, 1);
  }
  SceneText scene = under_the_sky();
  scene.shapes = {sphere("lamp", {0, 0, -1e18}, 0.8e18)};
  scene.camera = camera({0, 0, 0}, {0, 0, -1}, 40, {0, 1, 0});
  c.exact_radiance("radius 8e17 fills the picture", scene, 1);
}

void shading_normals(Case &c) {
  const std::string body = R"("positions": [[1,0,0],[-1,0,0],[0,1,0],[0,-1,0],[0,0,1],[0,0,-1]],
    "indices": [[0,2,4],[2,1,4],[1,3,4],[3,0,4],[2,0,5],[1,2,5],[3,1,5],[0,3,5]], "normals": )";
  struct Normals {
    const char *what, *list;
  };
  for (const Normals &n :
       {Normals{"zero", "[[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0]]"},
        Normals{"opposite", "[[-1,0,0],[1,0,0],[0,-1,0],[0,1,0],[0,0,-1],[0,0,1]]"},
        Normals{"tangential", "[[0,1,0],[0,0,1],[1,0,0],[0,0,1],[0,1,0],[1,0,0]]"},
        Normals{"tiny", "[[1e-30,0,0],[-1e-30,0,0],[0,1e-30,0],[0,-1e-30,0],[0,0,1e-30],[0,0,-1e-30]]"},
        Normals{"opposite neighbours", "[[1,0,0],[1,0,0],[0,1,0],[0,1,0],[0,0,1],[0,0,1]]"}})
    for (const char *of : {"white", "glass", "metal"}) {
      SceneText scene = under_the_sky();
      scene.materials = {material("glass", "dielectric", R"("ior": 1.5)"),
                         material("metal", "conductor", R"("reflectance": 1, "alpha": 0.3)")};
      scene.shapes = {mesh(of, body + n.list)};
      c.bounded_radiance(fmt::format("{}, normals {}", of, n.what), scene, 256, 0.1, 1.001);
    }
}

void missing_texture_coordinates(Case &c) {
  const auto with = [](const std::string &uvs) {
    SceneText scene = under_the_sky();
    scene.textures = {R"({"name": "tiles", "type": "checker", "a": 1, "b": 1})"};
    scene.materials = {material("brushed", "conductor",
                                R"("reflectance": "tiles", "roughness_x": 0.3, "roughness_y": 0.7, "multiple_scattering": true)")};
    scene.shapes = {mesh("brushed", R"("positions": [[-9,-9,0],[9,-9,0],[9,9,0],[-9,9,0]], "indices": [[0,1,2],[0,2,3]])" + uvs)};
    return scene;
  };
  for (const char *uvs : {"", R"(, "uvs": [[0,0],[0,0],[0,0],[0,0]])", R"(, "uvs": [[0,0],[1,0],[2,0],[3,0]])",
                          R"(, "uvs": [[1e18,0],[-1e18,1],[1e18,1],[0,-1e18]])"})
    c.bounded_radiance(fmt::format("white brushed metal under a white sky, uvs: {}", uvs[0] == 0 ? "none" : uvs + 9),
                       with(uvs), 1024, 0.97, 1.02);
}

void next_to_nothing(Case &c) {
  c.exact_radiance("no shapes under a white sky", under_the_sky(), 1);
  SceneText dark = under_the_sky();
  dark.lights.clear();
  c.exact_radiance("no shapes, no lights", dark, 0);
  SceneText scene = under_the_sky();
  scene.shapes = {mesh("grey", R"("positions": [[0,0,0],[1,0,0],[2,0,0]], "indices": [[0,1,2]])"),
                  quad("grey", {0, 0, 0}, {1, 0, 0}, {2, 0, 0}), sphere("grey", {0, 0, 0}, 1e-25)};
  c.exact_radiance("shapes without area only", scene, 1);
  scene.shapes = {mesh("black", R"("positions": [[-9,-9,0],[9,-9,0],[0,9,0]], "indices": [[0,1,2]])")};
  c.exact_radiance("one black triangle", scene, 0);
}

void rays_that_are_none(Case &c) {
  SceneText scene = under_the_sky();
  scene.shapes = {R"({"type": "icosphere", "material": "grey", "subdivisions": 5})", sphere("grey", {3, 0, 0}, 1)};
  Stage stage = c.stage(scene);
  const int rays = c.count(20000, 500000);
  for (const std::string &isa : c.isas()) {
    const SceneView view = stage.view(isa);
    const auto seconds = [&](const auto &spoil, std::int64_t &hits) {
      Random random(7);
      const double start = cpu_seconds();
      for (int i = 0; i < rays; ++i) {
        Vec3 o = random.point(3), d = random.direction();
        spoil(o, d);
        hits += trace_closest(view, o, d).geometry >= 0;
      }
      return cpu_seconds() - start;
    };
    std::int64_t good_hits = 0;
    const double good = seconds([](Vec3 &, Vec3 &) {}, good_hits);
    c.at_least(with_isa(c, "share of sound rays that hit", isa), static_cast<double>(good_hits) / rays, 0.01);
    struct Fault {
      const char *what;
      void (*spoil)(Vec3 &, Vec3 &);
    };
    for (const Fault &f : {Fault{"origin NaN", [](Vec3 &o, Vec3 &) { o.x = kNan; }},
                           Fault{"origin infinite", [](Vec3 &o, Vec3 &) { o.y = kInf; }},
                           Fault{"direction NaN", [](Vec3 &, Vec3 &d) { d = {kNan, kNan, kNan}; }},
                           Fault{"direction infinite", [](Vec3 &, Vec3 &d) { d.z = kInf; }},
                           Fault{"direction 0", [](Vec3 &, Vec3 &d) { d = {0, 0, 0}; }}}) {
      std::int64_t hits = 0;
      const double bad = seconds(f.spoil, hits);
      c.equal(with_isa(c, fmt::format("{}: hits", f.what), isa), static_cast<double>(hits), 0);
      c.at_most(with_isa(c, fmt::format("{}: seconds over those of sound rays", f.what), isa), bad / good, 2.5);
    }
  }
}

}  // namespace

Group geometry_group() {
  return {"geometry",
          {{"G1", "triangles without area", triangles_without_area},
           {"G2", "lamps with faces without area", lamps_without_area},
           {"G3", "NaN and infinities in meshes", numbers_that_are_none},
           {"G4", "slivers and needles", slivers},
           {"G5", "closed meshes do not leak, far from the origin either", closed_meshes_do_not_leak},
           {"G6", "coincident surfaces", coincident_surfaces},
           {"G7", "everything on one spot", everything_on_one_spot, "", true},
           {"G8", "grazing view and light", grazing},
           {"G9", "in, on and next to emitting spheres", in_and_on_spheres},
           {"G10", "radii from nothing to everything", radii},
           {"G11", "shading normals that are zero or face away", shading_normals},
           {"G12", "missing and degenerate texture coordinates", missing_texture_coordinates},
           {"G13", "next to nothing in the scene", next_to_nothing},
           {"G14", "rays that are not finite", rays_that_are_none, "", true}}};
}

}  // namespace phalanx::check
