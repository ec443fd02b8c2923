// The estimator: weights, roulette, and one vertex's worth of radiance.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../../kernels/physics/any_vertex.h"
#include "support/lights.h"
#include "support/materials.h"
#include "support/random.h"
#include "support/statistics.h"
#include "support/toy_scene.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

double d(float x) { return static_cast<double>(x); }

bool same(Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
bool same(const PathState &a, const PathState &b) {
  return same(a.origin, b.origin) && same(a.direction, b.direction) &&
         same(a.throughput, b.throughput) && a.pdf == b.pdf && a.depth == b.depth &&
         a.scramble == b.scramble && a.sample == b.sample;
}

PathState path_along(const AimedRay &ray, int sample) {
  PathState p = {};
  p.origin = ray.origin;
  p.direction = ray.direction;
  p.throughput = {0.9f, 0.5f, 0.7f};
  p.depth = sample % 5;
  p.pdf = sample % 3 == 0 ? 0.0f : 0.3f;
  p.scramble = sample * 7919;
  p.sample = sample;
  return p;
}

/// A floor (geometry 0) at z = 0 that faces up, under a 2 x 2 light (geometry 1) at z = 1.
ToyScene lit_floor(Material floor) {
  ToyScene scene = random_scene(1, 1);
  scene.geometries.clear();
  scene.lights.clear();
  scene.instances.clear();
  Material lamp = diffuse(0);
  lamp.emission = {1, 1, 1};
  scene.materials = {floor, lamp};
  scene.quads = {{{-9, -9, 0}, {18, 0, 0}, {0, 18, 0}}, {{-1, -1, 1}, {0, 2, 0}, {2, 0, 0}}};
  scene.add_geometry(kQuads, 0, 0);
  scene.add_geometry(kQuads, 1, 1);
  scene.add_lights(1, 1);
  return scene;
}

/// A path that comes down on the floor's origin.
PathState falling(int sample) {
  PathState p = {};
  p.origin = {0, 0, 0.5f};
  p.direction = {0, 0, -1};
  p.throughput = {1, 1, 1};
  p.scramble = 12345;
  p.sample = sample;
  return p;
}
const Hit kFloor = {0, 0, -1, 0}, kLamp = {1, 0, -1, 0};

}  // namespace

TEST_CASE("power_heuristic: in [0,1], sums to 1, never overflows (L12)") {
  const float most = std::numeric_limits<float>::max();
  for (const float a : {1e-38f, 1e-30f, 1e-10f, 0.3f, 1.0f, 7.0f, 1e10f, 1e20f, 1e30f, most})
    for (const float b : {1e-38f, 1e-30f, 1e-10f, 0.3f, 1.0f, 7.0f, 1e10f, 1e20f, 1e30f, most}) {
      const float w = power_heuristic(a, b), v = power_heuristic(b, a);
      CAPTURE(a);
      CAPTURE(b);
      CHECK((w >= 0.0f && w <= 1.0f));
      CHECK(std::fabs(w + v - 1) < 1e-6f);
      const double r = d(b) / d(a);
      CHECK(std::fabs(d(w) - 1 / (1 + r * r)) < 1e-6);
    }
  CHECK(power_heuristic(1.0f, 0.0f) == 1.0f);
  CHECK(power_heuristic(1e30f, 0.0f) == 1.0f);
  CHECK(power_heuristic(2.0f, 2.0f) == 0.5f);
  const float inf = std::numeric_limits<float>::infinity();
  CHECK(power_heuristic(inf, 1.0f) == 1.0f);
  CHECK(power_heuristic(1.0f, inf) == 0.0f);
}

TEST_CASE("start_path: a camera ray with full throughput and no density") {
  const ToyScene scene = random_scene(2, 1);
  const FrameView frame = scene.frame();
  const PathState p = start_path(frame, 12, 34, 56);
  const Ray r = camera_ray(frame, 12, 34, pixel_scramble(12, 34, frame.seed), 56);
  CHECK(same(p.origin, r.origin));
  CHECK(same(p.direction, r.direction));
  CHECK(same(p.throughput, vec3(1, 1, 1)));
  CHECK((p.pdf == 0.0f && p.depth == 0 && p.sample == 56));
  CHECK(static_cast<uint32>(p.scramble) == pixel_scramble(12, 34, frame.seed));
}

TEST_CASE("vertex_pair: every vertex and purpose has a pair of its own, after the camera's") {
  const ToyScene scene = random_scene(3, 1);
  const FrameView frame = scene.frame();
  PathState p = start_path(frame, 1, 2, 3);
  std::vector<float> seen;
  for (int32 pair = 0; pair < PHALANX_PAIR_FIRST_VERTEX; ++pair)
    seen.push_back(sample_pair(frame, static_cast<uint32>(p.scramble), p.sample, pair).x);
  for (p.depth = 0; p.depth < 50; ++p.depth)
    for (int32 pair = 0; pair < PHALANX_PAIRS_PER_VERTEX; ++pair)
      seen.push_back(vertex_pair(frame, p, pair).x);
  std::sort(seen.begin(), seen.end());
  CHECK(std::adjacent_find(seen.begin(), seen.end()) == seen.end());
}

TEST_CASE("escaped and emitted radiance") {
  const ToyScene scene = random_scene(4, 1);
  const SceneView view = scene.view();
  PathState p = falling(0);
  p.throughput = {0.5f, 1, 2};
  CHECK(same(escaped_radiance<kPlain>(view, p), vec3(0.05f, 0.2f, 0.6f)));
  Material m = diffuse(0);
  m.emission = {1, 2, 3};
  Surface s = {};
  s.front = 1;
  CHECK(same(emitted_radiance<kPlain>(view, m, s), m.emission));
  s.front = 0;
  CHECK(is_black(emitted_radiance<kPlain>(view, m, s)));
  m.two_sided = 1;
  CHECK(same(emitted_radiance<kPlain>(view, m, s), m.emission));
}

TEST_CASE("emission_weight: 1 after the camera and delta scattering, else the heuristic") {
  const ToyScene scene = lit_floor(diffuse(0.5f));
  const SceneView view = scene.view();
  PathState p = falling(0);
  p.direction = {0, 0, 1};
  const Surface s = make_surface<kPlain>(view, kLamp, p.origin, p.direction);
  CHECK(emission_weight<kPlain>(view, p, s) == 1.0f);
  p.pdf = 0.2f;
  const float light = light_pdf(scene.lights[0], p.origin, s.position, s.normal);
  CHECK(emission_weight<kPlain>(view, p, s) == power_heuristic(0.2f, light));
  CHECK(light == doctest::Approx(0.25f / 4));  // distance^2 / area
}

TEST_CASE("survival_probability: the largest component, between 0.05 and 1 (Q6)") {
  CHECK(survival_probability(vec3(0.2f, 0.7f, 0.1f)) == 0.7f);
  CHECK(survival_probability(vec3(2, 0, 0)) == 1.0f);
  CHECK(survival_probability(vec3(1e-9f, 0, 0)) == 0.05f);
  CHECK(survival_probability(vec3(std::numeric_limits<float>::quiet_NaN(), 0, 0)) >= 0.05f);
}

TEST_CASE("path_vertex: light sampling and scattering together give rho E / pi (B4 no. 4)") {
  const ToyScene scene = lit_floor(diffuse(0.5f));
  const SceneView view = scene.view();
  FrameView frame = scene.frame();
  for (const int sampler : {kSobolSampler, kIndependentSampler}) {
    frame.sampler = sampler;
    Mean total, by_light, by_scattering;
    for (int i = 0; i < 1 << 16; ++i) {
      const Vertex v = path_vertex<kDiffuse, kPlain>(view, frame, falling(i), kFloor);
      const double direct = d(v.shadow.contribution.x);
      double met = 0;
      if (v.next.depth > 0) {
        const float t = (1 - v.next.origin.z) / v.next.direction.z;
        const Vec3 p = v.next.origin + v.next.direction * t;
        if (std::max(std::fabs(p.x), std::fabs(p.y)) <= 1)
          met = d(path_vertex<kDiffuse, kPlain>(view, frame, v.next, kLamp).emitted.x);
      }
      by_light.add(direct);
      by_scattering.add(met);
      total.add(direct + met);
    }
    CAPTURE(sampler);
    CHECK(total.p(0.27706321) > test::alpha());
    CHECK(total.mean() ==
          doctest::Approx(0.27706321).epsilon(sampler == kSobolSampler ? 1e-4 : 1e-2));
    CHECK(by_light.mean() > 0.05);
    CHECK(by_scattering.mean() > 0.05);
  }
}

TEST_CASE("path_vertex: Russian roulette keeps the mean throughput (Q6)") {
  const ToyScene scene = lit_floor(diffuse(0.3f));
  const SceneView view = scene.view();
  FrameView frame = scene.frame();
  frame.roulette_depth = 0;
  Mean mean;
  int ended = 0;
  for (int i = 0; i < 1 << 16; ++i) {
    const Vertex v = path_vertex<kDiffuse, kPlain>(view, frame, falling(i), kFloor);
    ended += v.next.depth < 0;
    mean.add(v.next.depth < 0 ? 0 : d(v.next.throughput.x));
  }
  CHECK(mean.p(0.3) > test::alpha());
  CHECK(std::abs(ended - 0.7 * 65536) < 100);
  frame.roulette_depth = 100;
  const Vertex v = path_vertex<kDiffuse, kPlain>(view, frame, falling(1), kFloor);
  CHECK(v.next.throughput.x == 0.3f);
  CHECK(v.next.depth == 1);
}

TEST_CASE("path_vertex: roulette begins with the scattering event that roulette_depth names") {
  const ToyScene scene = lit_floor(diffuse(0.3f));
  FrameView frame = scene.frame();
  for (const int32 depth : {1, 2}) {
    frame.roulette_depth = depth;
    int ended = 0;
    for (int i = 0; i < 1000; ++i)
      ended += path_vertex<kDiffuse, kPlain>(scene.view(), frame, falling(i), kFloor).next.depth < 0;
    CHECK((ended > 0) == (depth == 1));
  }
}

TEST_CASE("path_vertex: black and too deep paths end after emission (Q7, M8)") {
  const ToyScene scene = random_scene(5, 1);
  const SceneView view = scene.view();
  FrameView frame = scene.frame();
  Random random(6);
  for (int i = 0; i < 20000; ++i) {
    const AimedRay ray = aimed_ray(scene, random, 1);
    const PathState p = path_along(ray, i);
    const Vertex any = path_vertex_any<kPlain>(view, frame, p, ray.hit);
    const Vertex black = path_vertex<kBlack, kPlain>(view, frame, p, ray.hit);
    frame.max_depth = p.depth;
    const Vertex deep = path_vertex_any<kPlain>(view, frame, p, ray.hit);
    frame.max_depth = 8;
    for (const Vertex &v : {black, deep}) {
      REQUIRE(same(v.emitted, any.emitted));
      REQUIRE(is_black(v.shadow.contribution));
      REQUIRE(v.next.depth < 0);
    }
  }
  const ToyScene dark = lit_floor(diffuse(0));
  CHECK(path_vertex<kDiffuse, kPlain>(dark.view(), dark.frame(), falling(0), kFloor).next.depth < 0);
}

TEST_CASE("path_vertex: everything it returns is finite, and paths go on from where they were") {
  const ToyScene scene = random_scene(7, 1);
  const SceneView view = scene.view();
  const FrameView frame = scene.frame();
  Random random(8);
  int scattered[kNumMaterialKinds] = {}, lit[kNumMaterialKinds] = {};
  for (int i = 0; i < 100000; ++i) {
    const AimedRay ray = aimed_ray(scene, random, 1);
    const PathState p = path_along(ray, i);
    const Vertex v = path_vertex_any<kPlain>(view, frame, p, ray.hit);
    const Surface s = make_surface<kPlain>(view, ray.hit, ray.origin, ray.direction);
    const int kind = scene.materials[static_cast<std::size_t>(s.material)].kind;
    REQUIRE(all_finite(v.emitted));
    REQUIRE(all_finite(v.shadow.contribution));
    lit[kind] += !is_black(v.shadow.contribution);
    if (!is_black(v.shadow.contribution)) {
      REQUIRE(v.shadow.distance > 0.0f);
      REQUIRE(dot(v.shadow.direction, s.normal) > 0.0f);
      REQUIRE(std::fabs(length(v.shadow.direction) - 1) < 1e-6f);
    }
    if (v.next.depth < 0) continue;
    ++scattered[kind];
    REQUIRE(v.next.depth == p.depth + 1);
    REQUIRE(v.next.scramble == p.scramble);
    REQUIRE(v.next.sample == p.sample);
    REQUIRE(all_finite(v.next.throughput));
    REQUIRE(is_finite(v.next.pdf));
    REQUIRE(std::fabs(length(v.next.direction) - 1) < 1e-6f);
    REQUIRE(same(v.next.origin, spawn_origin(s, v.next.direction)));
    const bool delta = kind == kMirror || kind == kDielectric;
    REQUIRE((v.next.pdf == 0.0f) == delta);
    if (kind != kDielectric) REQUIRE(dot(v.next.direction, s.normal) > 0.0f);
  }
  for (const int kind : {kDiffuse, kMirror, kDielectric, kConductor}) CHECK(scattered[kind] > 1000);
  CHECK(lit[kDiffuse] > 1000);
  CHECK(lit[kConductor] > 100);
  CHECK((lit[kMirror] == 0 && lit[kDielectric] == 0 && lit[kBlack] == 0 && scattered[kBlack] == 0));
}

TEST_CASE("path_vertex_any: picks the kind of the surface's material") {
  const ToyScene scene = random_scene(9, 1);
  const SceneView view = scene.view();
  const FrameView frame = scene.frame();
  Random random(10);
  for (int i = 0; i < 20000; ++i) {
    const AimedRay ray = aimed_ray(scene, random, 1);
    const PathState p = path_along(ray, i);
    const Geometry &g = scene.geometries[static_cast<std::size_t>(ray.hit.geometry)];
    const auto by_kind = [&] {
      switch (scene.materials[static_cast<std::size_t>(g.material)].kind) {
        case kDiffuse:
          return path_vertex<kDiffuse, kPlain>(view, frame, p, ray.hit);
        case kMirror:
          return path_vertex<kMirror, kPlain>(view, frame, p, ray.hit);
        case kDielectric:
          return path_vertex<kDielectric, kPlain>(view, frame, p, ray.hit);
        case kConductor:
          return path_vertex<kConductor, kPlain>(view, frame, p, ray.hit);
        default:
          return path_vertex<kBlack, kPlain>(view, frame, p, ray.hit);
      }
    };
    const Vertex a = path_vertex_any<kPlain>(view, frame, p, ray.hit), b = by_kind();
    REQUIRE(same(a.emitted, b.emitted));
    REQUIRE(same(a.shadow.contribution, b.shadow.contribution));
    REQUIRE(same(a.next, b.next));
  }
}
