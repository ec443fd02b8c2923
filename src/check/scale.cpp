// Scale and position: the same scene from a micrometre to a million kilometres, here and far away.
#include <fmt/format.h>

#include <cmath>

#include "../../kernels/physics/fresnel.h"
#include "../../kernels/physics/shape.h"
#include "../scene/transform.h"
#include "case.h"
#include "groups.h"
#include "statistics.h"
#include "tracing.h"

namespace phalanx::check {
namespace {

/// A room with a lamp, a glass ball and a block, all lengths times `s`, moved by `t`.
SceneText room(double s, double t = 0) {
  const auto at = [&](double x, double y, double z) { return Double3{x * s + t, y * s + t, z * s + t}; };
  const auto by = [&](double x, double y, double z) { return Double3{x * s, y * s, z * s}; };
  SceneText scene;
  scene.width = scene.height = 16;
  scene.camera = camera(at(0, 1, 3.5), at(0, 1, 0), 40, {0, 1, 0});
  scene.integrator = R"("max_depth": 12, "roulette_depth": 4)";
  scene.materials = {emitter("light", 12), material("glass", "dielectric", R"("ior": 1.5)"),
                     material("red", "diffuse", R"("reflectance": [0.6, 0.1, 0.1])")};
  scene.shapes = {quad("grey", at(-1, 0, 1), by(2, 0, 0), by(0, 0, -2)),
                  quad("grey", at(-1, 2, -1), by(2, 0, 0), by(0, 0, 2)),
                  quad("grey", at(-1, 0, -1), by(2, 0, 0), by(0, 2, 0)),
                  quad("red", at(-1, 0, 1), by(0, 0, -2), by(0, 2, 0)),
                  quad("grey", at(1, 0, -1), by(0, 0, 2), by(0, 2, 0)),
                  quad("light", at(-0.3, 1.99, -0.3), by(0.6, 0, 0), by(0, 0, 0.6)),
                  sphere("glass", at(0.35, 0.4, 0.3), 0.4 * s),
                  fmt::format(R"({{"type": "box", "material": "grey", "lo": {}, "hi": {}, "transform": {{"translate": {}}}}})",
                              vec(by(-0.7, 0, -0.6)), vec(by(-0.1, 1.1, 0)), vec({t, t, t}))};
  return scene;
}

/// Mean squared difference of two pictures over what the noise of both explains.
double difference_over_noise(const Film &a, const Film &b) {
  double difference = 0, noise = 0;
  for (std::int64_t i = 0; i < a.num_pixels(); ++i) {
    const double d = static_cast<double>(a.mean(i).y) - static_cast<double>(b.mean(i).y);
    difference += d * d;
    noise += static_cast<double>(a.variance_of_mean(i).y) + static_cast<double>(b.variance_of_mean(i).y);
  }
  return difference / noise;
}

void compare_rooms(Case &c, const std::string &what, const SceneText &scene, const SceneText &reference) {
  Stage moved = c.stage(scene), original = c.stage(reference);
  const int spp = c.count(16, 256);
  for (const std::string &isa : c.isas()) {
    const Film a = c.film(moved, spp, isa), b = c.film(original, spp, isa);
    const Measured ma = measure(a), mb = measure(b);
    c.near(with_isa(c, what + ": mean", isa), ma.mean, mb.mean, 4 * std::hypot(ma.standard_error, mb.standard_error));
    c.at_most(with_isa(c, what + ": squared difference over noise", isa), difference_over_noise(a, b), 1);
  }
}

void same_picture_at_every_scale(Case &c) {
  for (const double s : {1e-6, 1e-3, 1.0, 1e3, 1e6, 1e9}) {
    const std::string what = fmt::format("S = {:g}", s);
    if (s != 1) compare_rooms(c, what, room(s), room(1));
    Stage stage = c.stage(room(s));
    for (const std::string &isa : c.isas()) {
      const auto f = [s](double x) { return static_cast<float>(x * s); };
      const SelfHits found = self_hits(stage.view(isa), {f(-0.9), f(0.1), f(-0.9)}, {f(0.9), f(1.9), f(0.9)},
                                       c.count(20000, 300000));
      c.at_most(with_isa(c, what + ": rays that meet what they left", isa), found.rate(), 1e-5);
      c.at_most(with_isa(c, what + ": largest offset / S", isa), found.largest_offset / s, 4e-6);
    }
  }
}

void moved_far_away(Case &c) {
  for (const double t : {1e3, 1e6, 1e8}) {
    compare_rooms(c, fmt::format("moved by {:g} S", t), room(1, t), room(1));
    compare_rooms(c, fmt::format("moved by {:g} S, S = 1e-3", t), room(1e-3, 1e-3 * t), room(1e-3));
  }
  // Without help from the reader: geometry and camera moved in memory.
  Stage centred = c.stage(room(1));
  SceneDescription there = centred.description();
  const double t = 1e3;
  for (double *p : {there.camera.position.data(), there.camera.look_at.data()})
    for (int i = 0; i < 3; ++i) p[i] += t;
  for (ShapeDescription &shape : there.shapes)
    for (auto &row : shape.transform.m) row[3] += t;
  Stage far(there);
  for (const std::string &isa : c.isas()) {
    const Measured a = measure(c.film(far, c.count(16, 256), isa)), b = measure(c.film(centred, c.count(16, 256), isa));
    c.near(with_isa(c, "moved by 1000 S without recentring: mean", isa), a.mean, b.mean,
           4 * std::hypot(a.standard_error, b.standard_error));
  }
}

/// The nearer crossing in double precision; negative: none.
double crossing(Vec3 o, Vec3 d, const Sphere &s) {
  const long double f[] = {static_cast<long double>(o.x) - static_cast<long double>(s.center.x),
                           static_cast<long double>(o.y) - static_cast<long double>(s.center.y),
                           static_cast<long double>(o.z) - static_cast<long double>(s.center.z)};
  const long double v[] = {d.x, d.y, d.z}, r = s.radius;
  long double a = 0, b = 0, q = 0;
  for (int i = 0; i < 3; ++i) {
    a += v[i] * v[i];
    b -= f[i] * v[i];
  }
  for (int i = 0; i < 3; ++i) {
    const long double p = f[i] + v[i] * (b / a);
    q += p * p;
  }
  if (q > r * r) return -1;
  return static_cast<double>((b - sqrtl(a * (r * r - q))) / a);
}

void spheres_from_afar(Case &c) {
  const int rays = c.count(100000, 2000000);
  for (const float radius : {1e-3f, 1.0f, 3e5f})
    for (const float ratio : {3.0f, 8e3f, 1e4f, 2e5f}) {
      const Sphere s = {{0, 0, 0}, radius};
      Random random(5);
      std::int64_t wrong = 0;
      double worst = 0;
      const Vec3 origin = random.direction() * (radius * ratio);
      for (int i = 0; i < rays; ++i) {
        const Vec3 aim = random.direction() * (1.5f * radius * random.unit());
        const Vec3 d = normalize(aim - origin);
        const ShapeHit hit = intersect_sphere(origin, d, s, PHALANX_NEAR, PHALANX_FAR);
        const double t = crossing(origin, d, s);
        wrong += (hit.t > 0) != (t > 0);
        // Rays that graze are ill-conditioned: there the question is whether they hit.
        if (hit.t > 0 && t > 0 && length(aim) < 0.9f * radius)
          worst = std::fmax(worst, std::fabs(static_cast<double>(hit.t) - t) / static_cast<double>(radius));
      }
      const std::string what = fmt::format("R = {:g}, d = {:g} R", radius, ratio);
      const bool far = ratio > 1e4f;
      c.at_most(what + ": wrong hits and misses", static_cast<double>(wrong) / rays, far ? 5e-3 : 1e-4);
      c.at_most(what + ": error of the distance / R", worst, far ? 0.2 : 1e-2);
    }
  // The silhouette, with the camera moved or the sphere.
  for (const double radius : {1e-3, 3e5})
    for (const double ratio : {3.0, 8e3, 2e5}) {
      const double d = radius * ratio, sine = 1 / ratio, tangent = sine / std::sqrt(1 - sine * sine);
      const double fov = 2 * std::atan(1.5 * tangent) * 180 / kPi;
      const double covered = kPi / 9;  // a circle of radius tan in a square of 3 tan
      SceneText scene;
      scene.camera = camera({0, 0, d}, {0, 0, 0}, fov, {0, 1, 0});
      scene.shapes = {sphere("lamp", {0, 0, 0}, radius)};
      c.radiance(fmt::format("covered by R = {:g} at {:g} R, camera away", radius, ratio), scene, 32768, covered, 1e-3);
      scene.camera = camera({0, 0, 0}, {0, 0, -d}, fov, {0, 1, 0});
      scene.shapes = {sphere("lamp", {0, 0, -d}, radius)};
      c.radiance(fmt::format("covered by R = {:g} at {:g} R, sphere away", radius, ratio), scene, 32768, covered, 1e-3);
    }
}

void shell_around_a_ball(Case &c) {
  SceneText scene;
  scene.camera = camera({0, 0, 5}, {0, 0, 0}, 20, {0, 1, 0});
  scene.integrator = R"("max_depth": 1000, "roulette_depth": 1000)";
  scene.materials = {material("glass", "dielectric", R"("ior": 1.5)")};
  scene.shapes = {sphere("white", {0, 0, 0}, 1), sphere("glass", {0, 0, 0}, 1.00004)};
  scene.lights = {kSky};
  Stage stage = c.stage(scene);
  const int rays = c.count(100000, 1000000);
  for (const std::string &isa : c.isas()) {
    const SceneView view = stage.view(isa);
    Random random(8);
    std::int64_t lost_inwards = 0, lost_outwards = 0;
    for (int i = 0; i < rays; ++i) {
      const Vec3 from = random.direction() * 3.0f;
      const Vec3 d = normalize(random.direction() * 0.99f - from);
      const Landing shell = land(view, from, d);
      if (!shell.landed() || shell.hit.geometry != 1) continue;
      // Refracted inwards: within 41.8 degrees of the normal, so that the ball is always in the way.
      const Refraction r = fresnel_dielectric(-dot(d, shell.surface.normal), 1.5f);
      const Vec3 wi = normalize((d + shell.surface.normal * -dot(d, shell.surface.normal)) * (1 / 1.5f) -
                                shell.surface.normal * r.cos_t);
      const Landing ball = land(view, spawn_origin(shell.surface, wi), wi);
      lost_inwards += !ball.landed() || ball.hit.geometry != 0;
      if (!ball.landed()) continue;
      const Vec3 out = direction_beside(ball.surface.normal, random);
      const Landing back = land(view, spawn_origin(ball.surface, out), out);
      lost_outwards += !back.landed() || back.hit.geometry != 1;
    }
    c.equal(with_isa(c, fmt::format("rays lost on the way in, of {}", rays), isa), static_cast<double>(lost_inwards), 0);
    c.equal(with_isa(c, "rays lost on the way out", isa), static_cast<double>(lost_outwards), 0);
  }
  c.radiance("a white ball in a glass shell under a white sky", scene, 4096, 1, 2e-4);
}

void coordinates_beyond_floats(Case &c) {
  for (const char *x : {"2e18", "1e30", "3.4028235e38", "1e39"}) {
    SceneText scene;
    scene.shapes = {mesh("grey", fmt::format(R"("positions": [[0,0,0],[1,0,0],[0,{},0]], "indices": [[0,1,2]])", x))};
    c.rejects(fmt::format("a vertex at {}", x), scene.text(), "/shapes/0");
    scene.shapes = {fmt::format(R"({{"type": "sphere", "material": "grey", "center": [{}, 0, 0], "radius": 1}})", x)};
    c.rejects(fmt::format("a sphere at {}", x), scene.text(), "/shapes/0");
  }
  // From memory, as a mesh file would bring it: the message names the vertex.
  SceneText scene;
  scene.shapes = {mesh("grey", R"("positions": [[0,0,0],[1,0,0],[0,1,0]], "indices": [[0,1,2]])")};
  for (const float x : {2e18f, 1e30f, 3.4028235e38f}) {
    SceneDescription description = c.stage(scene).description();
    std::get<MeshShape>(description.shapes[0].shape).data.positions[7] = x;
    c.rejects(fmt::format("vertex 2 of a mesh at {:g}", x), description, "vertex 2");
  }
}

void emission_of_every_strength(Case &c) {
  const auto lit = [](double k) {
    SceneText scene;
    scene.camera = camera({0, 2, 3}, {0, 0.3, 0}, 40, {0, 1, 0});
    scene.materials = {emitter("light", k), material("metal", "conductor", R"("reflectance": 0.9, "alpha": 0.2)")};
    scene.shapes = {level("grey", 3, 0), quad("light", {-0.5, 2, -0.5}, {1, 0, 0}, {0, 0, 1}),
                    sphere("metal", {0.5, 0.5, 0}, 0.5)};
    return scene;
  };
  Stage one = c.stage(lit(1));
  for (const double k : {1e-30, 1e-20, 1e20, 1e30}) {
    Stage stage = c.stage(lit(k));
    const bool moderate = k == 1e-20 || k == 1e20;
    for (const std::string &isa : c.isas()) {
      const double reference = measure(c.film(one, 64, isa)).mean, mean = measure(c.film(stage, 64, isa)).mean / k;
      c.near(with_isa(c, fmt::format("k = {:g}: mean / k", k), isa), mean, reference,
             (moderate ? 1e-5 : 1e-2) * reference);
    }
  }
}

void instances_like_baked(Case &c) {
  const auto scene_with = [](const std::string &transform, bool baked, double size) {
    SceneText scene;
    scene.camera = camera({0, 0.2 * size, 4 * size}, {0, 0, 0}, 40, {0, 1, 0});
    scene.lights = {R"({"type": "directional", "direction": [-1, -2, -1], "irradiance": 3})"};
    const std::string shape = R"({"type": "displaced_sphere", "material": "grey", "resolution": 16, "amplitude": 0.3)";
    const std::string step = R"(, "transform": )" + transform + "}";
    if (baked) {
      scene.shapes = {shape + step};
    } else {
      scene.groups = {R"({"name": "g", "shapes": [)" + shape + "}]}"};
      scene.instances = {R"({"group": "g")" + step};
    }
    return scene;
  };
  struct Map {
    const char *what, *transform;
    double size;
  };
  for (const Map &map : {Map{"scale 1e-6", R"({"scale": 1e-6})", 1e-6},
                         Map{"scale 1e6, turned", R"([{"rotate": {"axis": [1,2,3], "angle": 77}}, {"scale": 1e6}])", 1e6},
                         Map{"scale (1e4, 1, 1e-4)", R"({"scale": [1e4, 1, 1e-4]})", 1},
                         Map{"mirrored", R"([{"scale": [-1, 1, 1]}, {"rotate": {"axis": [0,1,0], "angle": 30}}])", 1}})
    c.same_mean(map.what, scene_with(map.transform, false, map.size), scene_with(map.transform, true, map.size), 1024, 1e-4);
  c.rejects("scale 0", scene_with(R"({"scale": 0})", false, 1).text(), "");
  c.rejects("scale (1, 0, 1)", scene_with(R"({"scale": [1, 0, 1]})", false, 1).text(), "");
  SceneDescription broken = c.stage(scene_with(R"({"scale": 1})", false, 1)).description();
  broken.instances[0].transform.m[1][2] = std::nan("");
  c.rejects("a transform with NaN", broken, "not finite");
}

void grain_table_and_terrain(Case &c) {
  SceneText scene;
  const Double3 down = {-1, -1, 0};
  scene.lights = {sun(down, 2)};
  scene.shapes = {level("grey", 1e5, -1), level("grey", 0.5, 0),
                  sphere("grey", {0, 5e-4, 0}, 5e-4)};
  // The grain's shadow falls towards -x; its centre's is at x = -5e-4.
  const auto look_at = [&](double x, double y) {
    scene.camera = camera({x, y + 0.05, 0}, {x, y, 0}, 1e-4);
    return scene;
  };
  scene.integrator = R"("max_depth": 1, "roulette_depth": 64)";
  c.exact_radiance("in the grain's shadow", look_at(-6e-4, 0), 0);
  const double lit = 0.5 * 2 / kPi / std::sqrt(2.0);
  c.exact_radiance("on the table beside it", look_at(-3e-3, 0), lit, 1e-5);
  c.exact_radiance("on the terrain", look_at(7e4, -1), lit, 1e-5);
  Stage stage = c.stage(scene);
  for (const std::string &isa : c.isas()) {
    const SceneView view = stage.view(isa);
    const int rays = c.count(20000, 300000);
    c.at_most(with_isa(c, "rays that meet the grain they left", isa),
              self_hits(view, {-2e-3f, 1e-5f, -2e-3f}, {2e-3f, 2e-3f, 2e-3f}, rays).rate(), 1e-5);
    c.at_most(with_isa(c, "rays that meet the terrain they left", isa),
              self_hits(view, {-9e4f, -0.5f, -9e4f}, {9e4f, 1e4f, 9e4f}, rays).rate(), 1e-5);
  }
}

}  // namespace

Group scale_group() {
  return {"scale",
          {{"S1", "one room from a micrometre to a million kilometres", same_picture_at_every_scale},
           {"S2", "the room far from the origin", moved_far_away},
           {"S3", "spheres seen from up to 2e5 radii", spheres_from_afar},
           {"S4", "a glass shell 4e-5 above a ball", shell_around_a_ball},
           {"S5", "coordinates beyond what ray queries take", coordinates_beyond_floats},
           {"S6", "emission from 1e-30 to 1e30", emission_of_every_strength},
           {"S7", "instances with extreme, mirrored and broken transforms", instances_like_baked},
           {"S8", "a grain of 1e-3 m, a table, a terrain of 1e5 m", grain_table_and_terrain}}};
}

}  // namespace phalanx::check
