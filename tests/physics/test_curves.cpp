// Hair as geometry: points of its surface against double, rays that leave it or cross it, energy.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "../../kernels/physics/estimator.h"
#include "../../src/scene/trace.h"
#include "support/random.h"
#include "support/scenes.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

double d(float x) { return static_cast<double>(x); }

struct Point {
  double x, y, z;
};
Point point(Vec3 v) { return {d(v.x), d(v.y), d(v.z)}; }
Point mix64(Point a, Point b, double t) {
  return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t};
}
double dot64(Point a, Point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Point minus(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

/// A segment, a ray, and in double the crossing of the ray with the sphere at u.
struct Segment {
  Vec3 a, b;
  float radius_a, radius_b;

  /// far: the second crossing. Negative where the ray misses the sphere.
  double crossing(Vec3 origin, Vec3 direction, double u, bool far) const {
    const Point f = minus(point(origin), mix64(point(a), point(b), u)), w = point(direction);
    const double r = d(radius_a) + (d(radius_b) - d(radius_a)) * u;
    const double wf = dot64(w, f), ww = dot64(w, w);
    const double under = wf * wf - ww * (dot64(f, f) - r * r);
    if (under < 0) return -1;
    return (-wf + (far ? 1 : -1) * std::sqrt(under)) / ww;
  }
};

/// One segment as a scene; its view must not outlive it.
struct OneSegment {
  Geometry geometry = {};
  std::vector<float> points, along = {0.25f, 0.75f};
  std::vector<int32> segments = {0};
  SceneView view = {};

  explicit OneSegment(const Segment &s)
      : points{s.a.x, s.a.y, s.a.z, s.radius_a, s.b.x, s.b.y, s.b.z, s.radius_b} {
    geometry.shape = kCurves;
    view.curve_points = points.data();
    view.curve_along = along.data();
    view.curve_segments = segments.data();
    view.num_curve_segments = 1;
    view.geometries = &geometry;
  }
};

Segment random_segment(Random &random, float scale) {
  Segment s;
  s.a = random.point(scale);
  s.b = s.a + random.direction() * (scale * random.between(0.01f, 1));
  const float length_of = length(s.b - s.a);
  s.radius_a = length_of * random.between(0.01f, 0.3f);
  s.radius_b = length_of * random.between(0.01f, 0.3f);
  return s;
}

/// A point of the swept surface at u: its normal leans by what the radius changes.
Vec3 normal_at(const Segment &s, Random &random) {
  const Vec3 axis = normalize(s.b - s.a);
  const float sine = (s.radius_a - s.radius_b) / length(s.b - s.a);
  const Vec3 around = normalize(cross(axis, random.direction()));
  return axis * sine + around * std::sqrt(1 - sine * sine);
}

std::string fur_text(const char *material, float scale, int count) {
  return fmt::format(R"({{"version": 1, "materials": [{}],
    "shapes": [{{"type": "fur", "material": "m", "radius": {}, "length": {}, "count": {},
                 "thickness": [{}, {}], "curl": 0.1, "center": [{}, 0, 0]}}]}})",
                     material, scale, 0.5f * scale, count, 0.02f * scale, 0.005f * scale, 2 * scale);
}

const char *const kGrey = R"({"name": "m", "type": "diffuse"})";

struct FurHit {
  Vec3 direction;
  Hit hit;
  Surface surface;
};

/// What random rays into the scene of fur_text meet.
std::vector<FurHit> hits_of_fur(const SceneView &view, float scale, int n) {
  Random random(3);
  std::vector<FurHit> found;
  while (static_cast<int>(found.size()) < n) {
    const Vec3 center = {2 * scale, 0, 0};
    const Vec3 origin = center + random.direction() * (random.between(1.0f, 4.0f) * scale);
    FurHit f;
    f.direction = normalize(center + random.point(1.3f * scale) - origin);
    f.hit = trace_closest(view, origin, f.direction);
    if (f.hit.geometry < 0) continue;
    f.surface = make_surface<kRich>(view, f.hit, origin, f.direction);
    found.push_back(f);
  }
  return found;
}

}  // namespace

TEST_CASE("curve_surface: point and normal are those of the sphere at u, in double") {
  Random random(1);
  for (const float scale : {1e-4f, 1.0f, 1e4f}) {
    double worst = 0, worst_normal = 0;
    for (int i = 0; i < 100000; ++i) {
      const Segment s = random_segment(random, scale);
      const OneSegment scene(s);
      const float u = random.chance(0.1) ? 0.0f : random.unit();
      const Vec3 n = normal_at(s, random);
      const float r = s.radius_a + (s.radius_b - s.radius_a) * u;
      const Vec3 target = s.a * (1 - u) + s.b * u + n * r;
      const bool inside = random.chance(0.3);
      Vec3 direction = random.direction();
      if ((dot(direction, n) > 0) != inside) direction = neg(direction);
      if (std::fabs(dot(direction, n)) < 0.1f) continue;
      const float distance = inside ? 0.05f * r : scale * random.between(0.1f, 5);
      const Vec3 origin = target - direction * distance;
      Hit hit = {0, 0, -1, 0, 0, 0, copy_sign(u, inside ? -1.0f : 1.0f)};
      const LocalSurface surface = curve_surface(scene.view, scene.geometry, hit, origin, direction);
      const double t = s.crossing(origin, direction, d(u), inside);
      const Point c = mix64(point(s.a), point(s.b), d(u));
      const Point p = minus(point(origin), {-t * d(direction.x), -t * d(direction.y), -t * d(direction.z)});
      const Point off = minus(point(surface.position), p);
      worst = std::max(worst, std::sqrt(dot64(off, off)) / d(scale));
      const Point m = minus(p, c);
      const double radius = std::sqrt(dot64(m, m));
      const Point dn = minus(point(surface.normal), {m.x / radius, m.y / radius, m.z / radius});
      worst_normal = std::max(worst_normal, std::sqrt(dot64(dn, dn)) * radius / d(scale));
      REQUIRE(surface.uv.x == doctest::Approx(0.25 + 0.5 * d(u)));
      REQUIRE(surface.uv.y == 0.0f);
      REQUIRE(d(surface.thickness) == doctest::Approx(2 * radius).epsilon(1e-4));
    }
    CAPTURE(scale);
    CHECK(worst < 3e-5);  // coordinates of up to 6, slopes down to 0.1
    CHECK(worst_normal < 3e-5);
  }
}

TEST_CASE("curves: Embree's hits are where the swept surface is met first, in double") {
  const BuiltScene built = build_text(fur_text(kGrey, 1, 30), isas_here().back());
  SceneView view = built.scene.view();
  view.accel = built.accel->handle();
  Random random(5);
  int num_hits = 0;
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 origin = vec3(2, 0, 0) + random.direction() * 3;
    const Vec3 direction = normalize(vec3(2, 0, 0) + random.point(1.2f) - origin);
    const Hit hit = trace_closest(view, origin, direction);
    // The first crossing of all spheres of all segments, on a grid and then finer.
    double first = 1e30;
    for (std::size_t k = 0; k < built.scene.curve_segments.size(); ++k) {
      const float *const p = &built.scene.curve_points[4 * static_cast<std::size_t>(built.scene.curve_segments[k])];
      const Segment s = {{p[0], p[1], p[2]}, {p[4], p[5], p[6]}, p[3], p[7]};
      const auto at = [&](double u) {
        const double t = s.crossing(origin, direction, u, false);
        return t > 0 ? t : 1e30;
      };
      double best_u = 0;
      for (double u = 0; u <= 1; u += 1.0 / 32)
        if (at(u) < at(best_u)) best_u = u;
      if (at(best_u) > first + 0.1) continue;
      for (double step = 1.0 / 64; step > 1e-7; step /= 2)
        for (const double u : {best_u - step, best_u + step})
          if (u >= 0 && u <= 1 && at(u) < at(best_u)) best_u = u;
      first = std::min(first, at(best_u));
    }
    if (first > 1e29) continue;  // the grid may miss what is only grazed
    REQUIRE(hit.geometry >= 0);
    const Surface s = make_surface<kRich>(view, hit, origin, direction);
    const double slope = std::fabs(d(dot(s.normal, direction)));
    if (slope < 0.1) continue;
    ++num_hits;
    worst = std::max(worst, std::fabs(d(dot(s.position - origin, direction)) - first));
    REQUIRE(s.front == 1);
    REQUIRE(d(s.thickness) > 0.0);
  }
  CHECK(num_hits > 300);
  CHECK(worst < 2e-5);
}

TEST_CASE("curves: rays that leave a hair never meet it again, at any scale (S1)") {
  for (const float scale : {1e-3f, 1.0f, 1e3f}) {
    const BuiltScene built = build_text(fur_text(kGrey, scale, 5000), isas_here().back());
    SceneView view = built.scene.view();
    view.accel = built.accel->handle();
    Random random(4);
    int reflected = 0, crossed = 0, beyond_inside = 0;
    const std::vector<FurHit> found = hits_of_fur(view, scale, 200000);
    for (const FurHit &f : found) {
      const Surface &s = f.surface;
      if (s.front == 0) continue;  // where hairs cross, rays start in them
      Vec3 w = random.direction();
      if (dot(w, s.normal) < 0) w = neg(w);
      const Hit again = trace_closest(view, spawn_beyond(s, w), w);
      reflected += again.geometry >= 0 && again.primitive == f.hit.primitive;
      w = neg(w);
      const Vec3 start = spawn_beyond(s, w);
      const Hit past = trace_closest(view, start, w);
      crossed += past.geometry >= 0 && past.primitive == f.hit.primitive;
      beyond_inside += length(start - s.position) > 1.01f * s.thickness;
    }
    CAPTURE(scale);
    CAPTURE(reflected);
    CAPTURE(crossed);
    CHECK(reflected <= 2);
    CHECK(crossed <= 60);   // at round ends and kinks
    CHECK(beyond_inside == 0);
  }
}

TEST_CASE("spawn_beyond: leaves at the other end of the chord, outwards") {
  Random random(6);
  for (int i = 0; i < 100000; ++i) {
    const Segment s = random_segment(random, 1);
    const OneSegment scene(s);
    const float u = random.unit();
    const Vec3 n = normal_at(s, random);
    const float r = s.radius_a + (s.radius_b - s.radius_a) * u;
    const Vec3 center = s.a * (1 - u) + s.b * u;
    Surface at = {};
    at.position = center + n * r;
    at.normal = n;
    at.dpdu = s.b - s.a;
    at.front = 1;
    at.thickness = 2 * r;
    at.offset = 1e-5f * r;
    Vec3 w = random.direction();
    if (dot(w, n) > 0) w = neg(w);
    const Vec3 axis = normalize(s.b - s.a);
    if (std::fabs(dot(w, axis)) > 0.999f) continue;
    const Vec3 out = spawn_beyond(at, w) - center;
    REQUIRE(std::fabs(length(out) / r - 1) < 1e-3f);
    const Vec3 across = normalize(w - axis * dot(w, axis));
    REQUIRE(dot(out, across) > -1e-3f * r);  // outwards
    REQUIRE(dot(w, out) > -1e-3f * r);
    // On the line through the point in the cross section, unless the cone widens along w.
    const Vec3 other = n - across * (2 * dot(n, across));
    if (dot(other, w) > 0) REQUIRE(length(cross(out - n * r, across)) < 2e-3f * r);
  }
}

TEST_CASE("curves: hair without absorption is invisible in a white room, lit or seen") {
  const std::string scene = R"({"version": 1,
    "camera": {"position": [0, 0, 4], "look_at": [0, 0, 0], "fov": 20},
    "film": {"width": 16, "height": 16, "filter": {"type": "box"}},
    "integrator": {"max_depth": 200, "roulette_depth": 200},
    "materials": [{"name": "hair", "type": "hair", "absorption": 0},
                  {"name": "room", "type": "black", "emission": 1, "two_sided": true}],
    ROOM
    "shapes": [SHAPE {"type": "curves", "material": "hair", "radius": [0.3, 0.1],
                "strands": [[[-0.5, -1, 0], [0, 0, 0], [0.7, 0.8, 0.3]], [[0.5, -1, -0.5], [0, 1, -0.5]]]}]})";
  const auto mean = [&](const std::string &room, const std::string &shape) {
    std::string text = scene;
    text.replace(text.find("ROOM"), 4, room);
    text.replace(text.find("SHAPE"), 5, shape);
    const BuiltScene built = build_text(text, isas_here().back());
    RenderOptions o;
    o.spp = 256;
    const RenderResult r = render_scene(built, o);
    CHECK(r.stats.invalid.count == 0);
    double sum = 0;
    for (std::int64_t i = 0; i < r.film.num_pixels(); ++i) sum += d(r.film.mean(i).y);
    return sum / static_cast<double>(r.film.num_pixels());
  };
  CHECK(mean(R"("lights": [{"type": "environment", "radiance": 1}],)", "") ==
        doctest::Approx(1).epsilon(1e-3));
  const std::string room = R"({"type": "box", "material": "room", "lo": [-5, -5, -5], "hi": [5, 5, 5]},)";
  CHECK(mean("", room) == doctest::Approx(1).epsilon(0.01));
}
