// Surfaces at hits: on the ray, on the shape, facing the viewer; and rays that leave them for good.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "../../kernels/physics/first_hit.h"
#include "../../src/core/parallel.h"
#include "support/statistics.h"
#include "support/toy_scene.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

double d(float x) { return static_cast<double>(x); }
double dot64(Vec3 a, Vec3 b) { return d(a.x) * d(b.x) + d(a.y) * d(b.y) + d(a.z) * d(b.z); }

double distance_to_line(Vec3 p, Vec3 origin, Vec3 direction) {
  const Vec3 r = p - origin;
  const double along = dot64(r, direction);
  return std::sqrt(std::max(dot64(r, r) - along * along / dot64(direction, direction), 0.0));
}

/// Float Moeller-Trumbore: does the ray meet the parallelogram (or triangle) beyond PHALANX_NEAR?
bool meets_plane(Vec3 origin, Vec3 direction, Vec3 corner, Vec3 u, Vec3 v, bool triangle) {
  const Vec3 p = cross(direction, v);
  const float det = dot(u, p);
  if (det == 0.0f) return false;
  const Vec3 t = origin - corner, q = cross(t, u);
  const float a = dot(t, p) / det, b = dot(direction, q) / det;
  if (a < 0 || b < 0 || (triangle ? a + b > 1 : a > 1 || b > 1)) return false;
  return dot(v, q) / det > PHALANX_NEAR;
}

/// Does a ray that left the surface at `hit` meet the same primitive again at once?
bool meets_itself(const ToyScene &scene, Hit hit, Vec3 origin, Vec3 direction) {
  const Geometry &g = scene.geometries[static_cast<std::size_t>(hit.geometry)];
  const auto i = static_cast<std::size_t>(g.first + hit.primitive);
  if (hit.instance >= 0) {
    const Affine &m = scene.instances[static_cast<std::size_t>(hit.instance)].to_object;
    origin = transform_point(m, origin);
    direction = transform_vector(m, direction);
  }
  if (g.shape == kSpheres) {
    // Inward rays must meet the far side only, outward rays nothing.
    const ShapeHit again =
        intersect_sphere(origin, direction, scene.spheres[i], PHALANX_NEAR, PHALANX_FAR);
    const bool inward = dot64(origin - scene.spheres[i].center, direction) < 0;
    return again.t > 0 && (again.far_root == 0 || !inward);
  }
  if (g.shape == kDisks)
    return intersect_disk(origin, direction, scene.disks[i], PHALANX_NEAR, PHALANX_FAR).t > 0;
  if (g.shape == kQuads) {
    const Quad &q = scene.quads[i];
    return meets_plane(origin, direction, q.corner, q.edge_u, q.edge_v, false);
  }
  const Vec3 a = load_vec3(scene.positions.data(), scene.triangles[i].v0);
  const Vec3 b = load_vec3(scene.positions.data(), scene.triangles[i].v1);
  const Vec3 c = load_vec3(scene.positions.data(), scene.triangles[i].v2);
  return meets_plane(origin, direction, a, b - a, c - a, true);
}

}  // namespace

TEST_CASE("meet_plane: coordinates agree with double precision, from near and far") {
  for (const float scale : {1e-6f, 1.0f, 1e6f})
    for (const float far : {1.0f, 100.0f}) {
      Random random(1);
      double worst = 0, worst_normal = 0;
      for (int i = 0; i < 100000; ++i) {
        const Vec3 corner = random.point(scale), u = random.direction() * scale;
        const Vec3 v = random.direction() * (scale * random.between(0.2f, 2));
        const double nx = d(u.y) * d(v.z) - d(u.z) * d(v.y), ny = d(u.z) * d(v.x) - d(u.x) * d(v.z);
        const double nz = d(u.x) * d(v.y) - d(u.y) * d(v.x), area = std::hypot(nx, ny, nz);
        if (area < 0.1 * d(scale) * d(scale)) continue;
        const float a = random.unit(), b = random.unit();
        const Vec3 origin = random.point(far * scale);
        const Vec3 direction = normalize(corner + u * a + v * b - origin);
        const double slope =
            (nx * d(direction.x) + ny * d(direction.y) + nz * d(direction.z)) / area;
        if (std::fabs(slope) < 0.1) continue;
        // The true crossing of the rounded ray, in double.
        const double ox = d(origin.x) - d(corner.x), oy = d(origin.y) - d(corner.y);
        const double oz = d(origin.z) - d(corner.z);
        const double t = -(nx * ox + ny * oy + nz * oz) / area / slope;
        const double qx = ox + t * d(direction.x), qy = oy + t * d(direction.y);
        const double qz = oz + t * d(direction.z);
        const auto triple = [&](double x, double y, double z, Vec3 w) {  // (xyz x w) . n / area^2
          return ((y * d(w.z) - z * d(w.y)) * nx + (z * d(w.x) - x * d(w.z)) * ny +
                  (x * d(w.y) - y * d(w.x)) * nz) /
                 (area * area);
        };
        const double pu = triple(qx, qy, qz, v), pv = -triple(qx, qy, qz, u);
        if (pu < 0 || pu > 1 || pv < 0 || pv > 1) continue;
        const PlanePoint p = meet_plane(origin, direction, corner, u, v);
        worst = std::max({worst, std::fabs(d(p.u) - pu), std::fabs(d(p.v) - pv)});
        worst_normal =
            std::max(worst_normal, std::hypot(d(p.normal.x) - nx / area, d(p.normal.y) - ny / area,
                                              d(p.normal.z) - nz / area));
      }
      CAPTURE(scale);
      CHECK(worst < 5e-5 * d(far));  // metres / edge: far * eps / slope / sine of the corner
      CHECK(worst_normal < 5e-6);
    }
}

TEST_CASE("meet_plane: clamped to the primitive, and finite for parallel rays") {
  const PlanePoint beside =
      meet_plane(vec3(5, -5, 1), vec3(0, 0, -1), vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0));
  CHECK((beside.u == 1.0f && beside.v == 0.0f));
  const PlanePoint parallel =
      meet_plane(vec3(0.2f, 0.3f, 1), vec3(1, 0, 0), vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0));
  CHECK((is_finite(parallel.u) && is_finite(parallel.v)));
  CHECK(parallel.normal.z == 1.0f);
}

TEST_CASE("make_surface: the point is on the ray and both normals face the viewer") {
  const ToyScene scene = random_scene(1, 1);
  const SceneView view = scene.view();
  Random random(2);
  double worst = 0;
  int fronts = 0;
  for (int i = 0; i < 200000; ++i) {
    const AimedRay ray = aimed_ray(scene, random, 1);
    const Surface s = make_surface<kPlain>(view, ray.hit, ray.origin, ray.direction);
    REQUIRE(all_finite(s.position));
    REQUIRE(std::fabs(length(s.normal) - 1) < 1e-6f);
    REQUIRE(std::fabs(length(s.shading.n) - 1) < 1e-6f);
    REQUIRE(dot(s.normal, ray.direction) <= 0.0f);
    if (dot(s.normal, ray.direction) < 0.0f) REQUIRE(dot(s.shading.n, ray.direction) < 0.0f);
    REQUIRE(s.offset > 0.0f);
    REQUIRE(s.offset < 4e-5f);
    const Geometry &g = scene.geometries[static_cast<std::size_t>(ray.hit.geometry)];
    REQUIRE(s.material == g.material);
    REQUIRE(s.light == (g.first_light < 0 ? -1 : g.first_light + ray.hit.primitive));
    fronts += s.front;
    const double slope = std::fabs(dot64(s.normal, ray.direction));
    if (slope > 0.1)
      worst = std::max(worst, distance_to_line(s.position, ray.origin, ray.direction));
  }
  CHECK(worst < 4e-6);
  CHECK(std::abs(fronts - 100000) < 20000);
}

TEST_CASE("make_surface: front is the side of the shape's normal, in mirrored instances, too") {
  ToyScene scene = random_scene(3, 1);
  scene.quads[0] = {{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}};  // normal +z
  scene.spheres[0] = {{0, 0, 0}, 1};
  scene.disks[0] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.instances[0].to_world = scene.instances[0].to_object = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  scene.instances[1].to_world =
      scene.instances[1].to_object = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0};
  const SceneView view = scene.view();
  for (const int32 shape : {kQuads, kSpheres, kDisks}) {
    Hit hit = {shape * 8, 0, -1, 0};  // eight materials per shape
    REQUIRE(scene.geometries[static_cast<std::size_t>(hit.geometry)].shape == shape);
    const auto front = [&](int32 instance, float from, int32 far_root) {
      hit.instance = instance;
      hit.far_root = far_root;
      return make_surface<kPlain>(view, hit, vec3(0.1f, 0.2f, from), vec3(0, 0, from > 0 ? -1.0f : 1.0f))
          .front;
    };
    CAPTURE(shape);
    const bool closed = shape == kSpheres;
    CHECK(front(-1, 3, 0) == 1);
    CHECK(front(-1, -3, 0) == (closed ? 1 : 0));
    CHECK(front(0, 3, 0) == 1);
    CHECK(front(1, 3, 0) == (closed ? 1 : 0));  // mirrored: the quad faces -z
    CHECK(front(1, -3, 0) == 1);
    if (closed) CHECK(front(-1, 0.1f, 1) == 0);
  }
}

TEST_CASE("make_surface: instances equal what their transform makes of the shape (S7)") {
  const ToyScene scene = random_scene(4, 1);
  const SceneView view = scene.view();
  Random random(5);
  double worst = 0, worst_normal = 0;
  for (int i = 0; i < 50000; ++i) {
    const AimedRay ray = aimed_ray(scene, random, 1);
    if (ray.hit.instance < 0) continue;
    const Instance &instance = scene.instances[static_cast<std::size_t>(ray.hit.instance)];
    Hit local = ray.hit;
    local.instance = -1;
    const Vec3 o = transform_point(instance.to_object, ray.origin);
    const Vec3 w = normalize(transform_vector(instance.to_object, ray.direction));
    const Surface in_world = make_surface<kPlain>(view, ray.hit, ray.origin, ray.direction);
    const Surface in_group = make_surface<kPlain>(view, local, o, w);
    if (std::fabs(dot(in_world.normal, ray.direction)) < 0.1f) continue;
    const Vec3 p = transform_point(instance.to_world, in_group.position);
    const Vec3 n = normalize(transform_transposed(instance.to_object, in_group.normal));
    worst = std::max(worst, d(length(p - in_world.position)));
    worst_normal = std::max(worst_normal, d(length(n - in_world.normal)));
    REQUIRE(in_world.front == in_group.front);
  }
  CHECK(worst < 2e-4);  // where small spheres are met at grazing angles
  CHECK(worst_normal < 1e-3);
}

TEST_CASE("spawn_origin: rays never meet the surface they leave, at any scale (S1)") {
  const FlushDenormals flush;
  for (const float scale : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f, 1e9f}) {
    const ToyScene scene = random_scene(6, scale);
    const SceneView view = scene.view();
    Random random(7);
    const int n = 300000;
    int self_hits = 0;
    double worst = 0;
    for (int i = 0; i < n; ++i) {
      const AimedRay ray = aimed_ray(scene, random, scale);
      const Surface s = make_surface<kPlain>(view, ray.hit, ray.origin, ray.direction);
      const Vec3 w = random.direction();
      self_hits += meets_itself(scene, ray.hit, spawn_origin(s, w), w);
      const Geometry &g = scene.geometries[static_cast<std::size_t>(ray.hit.geometry)];
      const float reach = max_component(abs3(s.position));
      worst = std::max(worst, d(s.offset / std::max(reach, scale)) * (g.shape == kMesh ? 1 : 0.5));
    }
    CAPTURE(scale);
    CAPTURE(self_hits);
    CHECK(self_hits <= n * 1e-5);
    CHECK(worst < 1.5e-5);  // primitives of this scene reach 3 scales out, instances 9
  }
}

TEST_CASE("spawn_origin: in a box of size S the offset is at most 4e-6 S (S1)") {
  for (const float s : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f, 1e9f}) {
    ToyScene scene;
    scene.materials.push_back({});
    // The walls, a tilted block's side, and a sphere of a Cornell box around the origin.
    scene.quads = {{{-s, -s, -s}, {2 * s, 0, 0}, {0, 0, 2 * s}},
                   {{-s, s, -s}, {0, 0, 2 * s}, {2 * s, 0, 0}},
                   {{-s, -s, s}, {0, 2 * s, 0}, {0, 0, -2 * s}},
                   {{-s, -s, -s}, {0, 2 * s, 0}, {2 * s, 0, 0}},
                   {{0.1f * s, -s, 0.2f * s}, {0.5f * s, 0, 0.2f * s}, {0, 0.6f * s, 0}}};
    scene.spheres = {{{0.4f * s, -0.6f * s, 0.3f * s}, 0.4f * s}};
    scene.add_geometry(kQuads, 0, 0);
    scene.add_geometry(kSpheres, 0, 0);
    const SceneView view = scene.view();
    Random random(8);
    double worst = 0;
    int self_hits = 0;
    for (int i = 0; i < 100000; ++i) {
      const bool sphere = random.chance(0.3);
      const Hit hit = {sphere ? 1 : 0, sphere ? 0 : random.below(5), -1, 0};
      const auto q = static_cast<std::size_t>(hit.primitive);
      const Vec3 target =
          sphere ? scene.spheres[0].center + random.direction() * scene.spheres[0].radius
                 : scene.quads[q].corner + scene.quads[q].edge_u * random.unit() +
                       scene.quads[q].edge_v * random.unit();
      Vec3 origin = random.point(s);
      Vec3 direction = normalize(target - origin);
      if (sphere && dot(target - scene.spheres[0].center, direction) > 0) continue;
      const Surface surface = make_surface<kPlain>(view, hit, origin, direction);
      const Vec3 w = random.direction();
      worst = std::max(worst, d(surface.offset) / d(s));
      self_hits += meets_itself(scene, hit, spawn_origin(surface, w), w);
    }
    CAPTURE(s);
    CAPTURE(worst);
    CHECK(worst <= 4e-6);
    CHECK(self_hits <= 1);
  }
}

TEST_CASE("spawn_origin: goes to the side the ray leaves on") {
  Surface s = {};
  s.position = {1, 2, 3};
  s.normal = {0, 0, 1};
  s.offset = 0.5f;
  CHECK(spawn_origin(s, vec3(0, 0.6f, 0.8f)).z == 3.5f);
  CHECK(spawn_origin(s, vec3(0, 0.6f, -0.8f)).z == 2.5f);
  CHECK(offset_bound(vec3(1, 2, 4), vec3(0, 0, -1)) ==
        doctest::Approx(4 * 32 * 0x1p-24).epsilon(1e-3).scale(0));
}

TEST_CASE("make_surface: a shading normal that turns away gives way to the geometric one (G11)") {
  ToyScene scene = random_scene(9, 1);
  scene.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  scene.triangles[0] = {0, 1, 2};
  scene.geometries[0].has_normals = 1;
  const Hit hit = {0, 0, -1, 0};
  for (const Vec3 n : {vec3(0, 0, 0), vec3(0, 0, -1), vec3(1, 0, -1e-3f), vec3(0, 0, 1)}) {
    for (std::size_t v = 0; v < 3; ++v)
      scene.normals[3 * v] = n.x, scene.normals[3 * v + 1] = n.y, scene.normals[3 * v + 2] = n.z;
    for (const float side : {1.0f, -1.0f}) {
      const Surface s = make_surface<kPlain>(scene.view(), hit, vec3(0.2f, 0.2f, side), vec3(0, 0, -side));
      CHECK(all_finite(s.shading.n));
      CHECK(s.normal.z == side);
      CHECK(s.shading.n.z * side > 0.0f);
      CHECK(s.front == (side > 0 ? 1 : 0));
    }
  }
}

TEST_CASE("make_surface: shading normals are interpolated") {
  ToyScene scene = random_scene(10, 1);
  scene.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  scene.normals = {0, 0, 1, 0.6f, 0, 0.8f, 0, 0, 1};
  scene.triangles[0] = {0, 1, 2};
  scene.geometries[0].has_normals = 1;
  const Vec3 n =
      make_surface<kPlain>(scene.view(), {0, 0, -1, 0}, vec3(0.5f, 0.25f, 1), vec3(0, 0, -1)).shading.n;
  const Vec3 expected = normalize(vec3(0.3f, 0, 0.9f));
  CHECK(length(n - expected) < 1e-6f);
}

TEST_CASE("first_hit: albedo, normal and depth of what the camera sees") {
  ToyScene scene = random_scene(11, 1);
  scene.quads[0] = {{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}};
  const Hit nothing = {-1, 0, -1, 0};
  const FirstHit sky = first_hit<kPlain>(scene.view(), nothing, vec3(0, 0, 4), vec3(0, 0, -1));
  CHECK((is_black(sky.albedo) && is_black(sky.normal) && sky.depth == 0.0f));
  const int32 first_quads = 8;
  for (int32 material = 0; material < 8; ++material) {
    scene.geometries[first_quads].material = material;
    const FirstHit f =
        first_hit<kPlain>(scene.view(), {first_quads, 0, -1, 0}, vec3(0, 0, 4), vec3(0, 0, -1));
    const Material &m = scene.materials[static_cast<std::size_t>(material)];
    CHECK(f.depth == doctest::Approx(4));
    CHECK(f.normal.z == 1.0f);
    if (m.kind == kDielectric)
      CHECK(f.albedo.x == 1.0f);
    else if (m.kind == kBlack)
      CHECK(is_black(f.albedo));
    else if (m.has_ior != 0)
      CHECK(f.albedo.x == fresnel_conductor(1.0f, m.eta.x, m.k.x));
    else
      CHECK(f.albedo.x == m.reflectance.x);
  }
}
