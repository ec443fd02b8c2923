// Description to scene: transforms, degenerate input, lights. STABILITY: G1-G3, G10, G11, G13, S5, S7, L6, L8.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "../../src/scene/alias_table.h"
#include "../../src/scene/build.h"
#include "../../src/scene/transform.h"

using namespace phalanx;

namespace {

constexpr double kPi = 3.14159265358979323846;
const float kNan = std::numeric_limits<float>::quiet_NaN();
const float kInf = std::numeric_limits<float>::infinity();

Transform linear(const Double3 &x, const Double3 &y, const Double3 &z) {
  Transform t;
  for (std::size_t i = 0; i < 3; ++i) t.m[i][0] = x[i], t.m[i][1] = y[i], t.m[i][2] = z[i];
  return t;
}
Transform scaling(double x, double y, double z) { return linear({x, 0, 0}, {0, y, 0}, {0, 0, z}); }
Transform moved(Transform t, double x, double y, double z) {
  t.m[0][3] = x, t.m[1][3] = y, t.m[2][3] = z;
  return t;
}
/// Turns by 30 degrees about z, then 50 about x.
Transform turn() {
  const double c = std::cos(30 * kPi / 180), s = std::sin(30 * kPi / 180);
  const double d = std::cos(50 * kPi / 180), r = std::sin(50 * kPi / 180);
  return compose(linear({1, 0, 0}, {0, d, r}, {0, -r, d}),
                 linear({c, s, 0}, {-s, c, 0}, {0, 0, 1}));
}

constexpr std::int32_t kGrey = 0, kLamp = 1, kTwoSidedLamp = 2;

SceneDescription empty_scene() {
  SceneDescription d;
  d.file = "scene.json";
  d.materials.resize(3);
  d.materials[kGrey].name = "grey";
  d.materials[kLamp].name = "lamp";
  d.materials[kLamp].kind = kBlack;
  d.materials[kLamp].emission = {1, 2, 3};
  d.materials[kTwoSidedLamp] = d.materials[kLamp];
  d.materials[kTwoSidedLamp].two_sided = true;
  return d;
}

template <class Shape>
ShapeDescription shape(Shape s, std::int32_t material = kGrey, const Transform &transform = {},
                       const std::string &origin = "scene.json: /shapes/0") {
  ShapeDescription d;
  d.origin = origin;
  d.material = material;
  d.transform = transform;
  d.shape = std::move(s);
  return d;
}

MeshShape triangle() { return {{{0, 0, 0, 1, 0, 0, 0, 1, 0}, {}, {0, 1, 2}}}; }
QuadShape unit_quad() { return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}; }
SpheresShape unit_sphere() { return {{{0, 0, 0, 1}}}; }
DiskShape unit_disk() { return {{0, 0, 0}, {0, 0, 1}, 1}; }

template <class Shape>
SceneDescription one_shape(Shape s, std::int32_t material = kGrey,
                           const Transform &transform = {}) {
  SceneDescription d = empty_scene();
  d.shapes.push_back(shape(std::move(s), material, transform));
  return d;
}

Scene build(const SceneDescription &description) {
  Diagnostics diagnostics;
  Scene scene = build_scene(description, diagnostics);
  for (const Problem &problem : diagnostics.errors()) FAIL_CHECK(problem.text());
  return scene;
}

std::string error_of(const SceneDescription &description) {
  Diagnostics diagnostics;
  build_scene(description, diagnostics);
  return diagnostics.has_errors() ? diagnostics.errors()[0].text() : "no error";
}

void check_error(const SceneDescription &description, const std::string &expected) {
  const std::string error = error_of(description);
  INFO(error);
  CHECK(error.find(expected) != std::string::npos);
}

Vec3 position(const Scene &scene, std::int32_t vertex) {
  const float *const p = &scene.positions[static_cast<std::size_t>(vertex) * 3];
  return {p[0], p[1], p[2]};
}

Vec3 triangle_normal(const Scene &scene, std::size_t i) {
  const Triangle &t = scene.triangles[i];
  return normalize(cross(position(scene, t.v1) - position(scene, t.v0),
                         position(scene, t.v2) - position(scene, t.v0)));
}

void check_near(Vec3 a, Vec3 b, double tolerance = 1e-6) {
  INFO(a.x, " ", a.y, " ", a.z, " against ", b.x, " ", b.y, " ", b.z);
  CHECK(std::fabs(a.x - b.x) <= tolerance);
  CHECK(std::fabs(a.y - b.y) <= tolerance);
  CHECK(std::fabs(a.z - b.z) <= tolerance);
}

bool has_note(const Scene &scene, const std::string &text) {
  for (const std::string &note : scene.notes)
    if (note.find(text) != std::string::npos) return true;
  return false;
}

double total_pdf(const Scene &scene) {
  double sum = 0;
  for (const Light &light : scene.lights) sum += static_cast<double>(light.select_pdf);
  return sum;
}

}  // namespace

// ---- arrays -----------------------------------------------------------------------------------

TEST_CASE("an empty scene is a scene") {
  SceneDescription d = empty_scene();
  d.has_environment = true;
  d.environment = {1, 2, 3};
  const Scene scene = build(d);
  CHECK(scene.geometries.empty());
  CHECK(scene.num_vertices() == 0);
  CHECK(scene.bounds_lo.x > scene.bounds_hi.x);
  const SceneView view = scene.view();
  CHECK(view.num_geometries == 0);
  CHECK(view.num_lights == 0);
  CHECK(view.num_materials == 3);
  CHECK(view.has_environment == 1);
  CHECK(view.environment.z == 3);
  CHECK(Scene().num_vertices() == 0);
}

TEST_CASE("records, absolute indices, padding and normals of several meshes") {
  SceneDescription d = empty_scene();
  d.shapes.push_back(shape(triangle()));
  MeshShape smooth = triangle();
  smooth.data.normals = {0, 0, 2, 0, 0, 1, 0, 3, 4};
  d.shapes.push_back(shape(smooth, kGrey, moved({}, 0, 0, 5)));
  d.shapes.push_back(shape(unit_quad()));
  d.shapes.push_back(shape(SpheresShape{{{0, 0, 0, 1}, {3, 0, 0, 0.5}}}));
  const Scene scene = build(d);
  REQUIRE(scene.geometries.size() == 4);
  CHECK(scene.num_prims == std::vector<std::int32_t>{1, 1, 1, 2});
  CHECK(scene.num_vertices() == 6);
  CHECK(scene.positions.size() == 6 * 3 + 4);
  CHECK(scene.triangles[1].v0 == 3);
  CHECK(scene.geometries[1].first == 1);
  CHECK(scene.geometries[0].has_normals == 0);
  CHECK(scene.geometries[1].has_normals == 1);
  CHECK(scene.geometries[1].normal_offset == -3);
  CHECK(scene.geometries[2].shape == kQuads);
  CHECK(scene.geometries[3].shape == kSpheres);
  CHECK(scene.geometries[3].first == 0);
  const std::size_t last = static_cast<std::size_t>(5 + scene.geometries[1].normal_offset) * 3;
  CHECK(scene.vertex_normals[last + 1] == doctest::Approx(0.6));
  CHECK(scene.vertex_normals[2] == 1.0f);
  CHECK(position(scene, 3).z == 5);
  check_near(scene.bounds_lo, {-1, -1, -1});
  check_near(scene.bounds_hi, {3.5f, 1, 5});
  CHECK(scene.top_level.count == 4);
  CHECK(scene.view().num_top_geometries == 4);
  CHECK(scene.bytes() > 0);
  for (const Geometry &geometry : scene.geometries) CHECK(geometry.first_light == -1);
}

TEST_CASE("the outside stays outside under every transform") {
  MeshShape smooth = triangle();
  smooth.data.normals = {0, 0, 1, 0, 0, 1, 0, 0, 1};
  const Transform transforms[] = {{},
                                  turn(),
                                  scaling(-1, 1, 1),
                                  scaling(1, 1, -1),
                                  scaling(-2, -3, -4),
                                  scaling(1e4, 1, 1e-4),
                                  compose(turn(), scaling(1, -2, 5)),
                                  compose(scaling(1e-6, 1e-6, 1e-6), turn()),
                                  compose(compose(turn(), scaling(-1, 2, 3)), turn()),
                                  scaling(1e9, 1e9, 1e9)};
  for (const Transform &transform : transforms) {
    // A point outside the untransformed shapes stays on the normal's side.
    const Double3 outside = transform_vector(transform, {0, 0, 1});
    const Vec3 up = normalize({static_cast<float>(outside[0] / length(outside)),
                               static_cast<float>(outside[1] / length(outside)),
                               static_cast<float>(outside[2] / length(outside))});
    const Scene mesh = build(one_shape(smooth, kGrey, transform));
    REQUIRE(mesh.triangles.size() == 1);
    const Vec3 n = triangle_normal(mesh, 0);
    CHECK(dot(n, up) > 0);
    for (std::size_t i = 0; i < 3; ++i)
      check_near({mesh.vertex_normals[i * 3], mesh.vertex_normals[i * 3 + 1],
                  mesh.vertex_normals[i * 3 + 2]},
                 n, 2e-4);
    const Scene quad = build(one_shape(unit_quad(), kGrey, transform));
    REQUIRE(quad.quads.size() == 1);
    check_near(safe_normalize(cross(safe_normalize(quad.quads[0].edge_u, {0, 0, 0}),
                                    safe_normalize(quad.quads[0].edge_v, {0, 0, 0})),
                              {0, 0, 0}),
               n, 1e-4);
    if (similarity_scale(transform) > 0) {
      const Scene disk = build(one_shape(unit_disk(), kGrey, transform));
      REQUIRE(disk.disks.size() == 1);
      const Vec3 u = disk.disks[0].axis_u, v = disk.disks[0].axis_v;
      check_near(safe_normalize(cross(safe_normalize(u, {0, 0, 0}), safe_normalize(v, {0, 0, 0})),
                                {0, 0, 0}),
                 n);
      CHECK(length(u) == doctest::Approx(similarity_scale(transform)));
      CHECK(length(v) == doctest::Approx(similarity_scale(transform)));
      CHECK(std::fabs(dot(u, v)) < 1e-6f * length_squared(u));
    }
  }
}

TEST_CASE("spheres and disks take similarities only") {
  const Scene scene = build(one_shape(SpheresShape{{{1, 0, 0, 2}}}, kGrey,
                                      moved(compose(turn(), scaling(-3, 3, 3)), 1, 1, 1)));
  REQUIRE(scene.spheres.size() == 1);
  CHECK(scene.spheres[0].radius == doctest::Approx(6));
  const Double3 center =
      transform_point(moved(compose(turn(), scaling(-3, 3, 3)), 1, 1, 1), {1, 0, 0});
  check_near(scene.spheres[0].center, {static_cast<float>(center[0]), static_cast<float>(center[1]),
                                       static_cast<float>(center[2])});
  check_error(one_shape(unit_sphere(), kGrey, scaling(1, 1, 1.01)),
              "scene.json: /shapes/0: a sphere can be");
  check_error(one_shape(unit_sphere(), kGrey, linear({1, 0, 0}, {0.1, 1, 0}, {0, 0, 1})),
              "a sphere can be");
  check_error(one_shape(unit_sphere(), kGrey, scaling(0, 0, 0)), "a sphere can be");
  check_error(one_shape(unit_disk(), kGrey, scaling(1, 2, 1)), "a disk can be");
  check_error(one_shape(DiskShape{{0, 0, 0}, {0, 0, 0}, 1}), "the normal has no direction");
  check_error(one_shape(DiskShape{{0, 0, 0}, {0, 0, 1}, 0}), "radii must be above 0");
}

TEST_CASE("G10: sphere radii") {
  check_error(one_shape(SpheresShape{{{0, 0, 0, 0}}}), "radii must be above 0");
  check_error(one_shape(SpheresShape{{{0, 0, 0, 1}, {0, 0, 0, -1}}}), "sphere 1");
  check_error(one_shape(SpheresShape{{{0, 0, 0, 1e19}}}), "at most 1.8e18");
  check_error(one_shape(SpheresShape{{{0, 0, 0, std::nan("")}}}), "radii must be above 0");
  check_error(one_shape(SpheresShape{{{std::nan(""), 0, 0, 1}}}), "coordinates finite");
  const Scene tiny = build(one_shape(SpheresShape{{{0, 0, 0, 1e-20}, {0, 0, 0, 1e-15}}}, kLamp));
  CHECK(tiny.spheres.size() == 1);
  CHECK(tiny.num_dropped == 1);
  CHECK(tiny.lights.size() == 1);
}

// ---- degenerate input -------------------------------------------------------------------------

TEST_CASE("G1, G2: triangles without area are left out, counted, and never lights") {
  MeshShape mesh;
  mesh.data.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0, 0, 0, 0, 5e-8f, 0, 1};
  mesh.data.indices = {0, 0, 1,   // repeated index
                       0, 4, 1,   // repeated place
                       0, 1, 3,   // collinear
                       0, 1, 2,   // good
                       0, 0, 0,   // a point
                       0, 5, 4};  // repeated place
  for (const std::int32_t material : {kGrey, kLamp}) {
    const Scene scene = build(one_shape(mesh, material));
    CHECK(scene.triangles.size() == 1);
    CHECK(scene.num_prims == std::vector<std::int32_t>{1});
    CHECK(scene.num_dropped == 5);
    CHECK(has_note(scene, "5 zero-area triangles left out of scene.json: /shapes/0"));
    CHECK(scene.lights.size() == (material == kLamp ? 1 : 0));
  }
  // Slivers are not degenerate.
  MeshShape sliver;
  sliver.data = {
      {0, 0, 0, 1, 0, 0, 1, 1e-7f, 0, 1e4f, 0, 0, 1e4f, 1e-4f, 0}, {}, {0, 1, 2, 0, 3, 4}};
  CHECK(build(one_shape(sliver)).triangles.size() == 2);
  CHECK(build(one_shape(sliver, kGrey, scaling(1e-6, 1e-6, 1e-6))).triangles.size() == 2);
  CHECK(build(one_shape(triangle(), kGrey, scaling(1e-9, 1e-9, 1e-9))).triangles.size() == 1);
  CHECK(build(one_shape(triangle(), kGrey, scaling(1e-19, 1e-19, 1e-19))).triangles.empty());
}

TEST_CASE("L6: quads without area; shapes of which nothing is left have no record") {
  SceneDescription d = empty_scene();
  d.shapes.push_back(shape(QuadShape{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, kLamp));
  d.shapes.push_back(shape(QuadShape{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}}, kLamp));
  d.shapes.push_back(shape(MeshShape{{{0, 0, 0, 1, 0, 0}, {0, 0, 1, 0, 0, 1}, {0, 1, 1}}}, kLamp));
  d.shapes.push_back(shape(MeshShape{}));
  d.shapes.push_back(shape(SpheresShape{}));
  const Scene scene = build(d);
  CHECK(scene.geometries.empty());
  CHECK(scene.lights.empty());
  CHECK(scene.num_dropped == 3);
  CHECK(scene.num_vertices() == 0);
  CHECK(scene.vertex_normals.empty());
  CHECK(scene.bounds_lo.x > scene.bounds_hi.x);
}

TEST_CASE("S5, G3: coordinates must be finite and at most 1.8e18") {
  for (const float bad : {2e18f, 1e30f, std::numeric_limits<float>::max(), kNan, kInf, -kInf}) {
    MeshShape mesh = triangle();
    mesh.data.positions[4] = bad;
    check_error(one_shape(mesh), "scene.json: /shapes/0: vertex 1 is at");
    check_error(one_shape(mesh, kGrey, moved({}, 0, 0, 1)),
                "scene.json: /shapes/0: vertex 1 is at");
  }
  check_error(one_shape(triangle(), kGrey, scaling(1e19, 1, 1)), "vertex 1 is at");
  check_error(one_shape(triangle(), kGrey, moved({}, 0, 1e19, 0)), "vertex 0 is at");
  check_error(one_shape(triangle(), kGrey, scaling(std::nan(""), 1, 1)),
              "the transform is not finite");
  check_error(one_shape(QuadShape{{1e18, 0, 0}, {1e18, 0, 0}, {0, 1, 0}}), "a corner is at");
  check_error(one_shape(QuadShape{{std::nan(""), 0, 0}, {1, 0, 0}, {0, 1, 0}}), "a corner is at");
  check_error(one_shape(DiskShape{{1.7e18, 0, 0}, {0, 0, 1}, 1e18}), "at most 1.8e18");
  CHECK(build(one_shape(triangle(), kGrey, scaling(1e18, 1e18, 1e18))).triangles.size() == 1);
}

TEST_CASE("inline meshes with wrong arrays are refused") {
  MeshShape mesh = triangle();
  mesh.data.indices = {0, 1, 3};
  check_error(one_shape(mesh), "triangle 0 refers to vertex 3, but there are 3");
  mesh.data.indices = {0, -1, 2};
  check_error(one_shape(mesh), "triangle 0 refers to vertex -1");
  mesh.data.indices = {0, 1};
  check_error(one_shape(mesh), "three a triangle");
  mesh = triangle();
  mesh.data.normals = {0, 0, 1};
  check_error(one_shape(mesh), "3 vertices but 1 normals");
  mesh = triangle();
  mesh.data.positions.push_back(1);
  check_error(one_shape(mesh), "three numbers a vertex");
  check_error(one_shape(triangle(), 3), "there is no material 3");
  check_error(one_shape(triangle(), -1), "there is no material -1");
}

TEST_CASE("G11: normals without direction become those of the faces") {
  MeshShape mesh;
  mesh.data.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  mesh.data.indices = {0, 1, 2, 1, 2, 0, 0, 2, 1};  // vertex 3 is in no triangle
  mesh.data.normals = {0, 0, 0, 0, 1, 0, kNan, 0, 0, 0, 0, 0};
  const Scene scene = build(one_shape(mesh, kGrey, scaling(2, 2, -2)));
  const auto normal = [&](std::size_t i) {
    return Vec3{scene.vertex_normals[i * 3], scene.vertex_normals[i * 3 + 1],
                scene.vertex_normals[i * 3 + 2]};
  };
  check_near(normal(0), {0, 0, -1});
  check_near(normal(1), {0, 1, 0});
  check_near(normal(2), {0, 0, -1});
  check_near(normal(3), {0, 0, 1});
  CHECK(has_note(scene, "3 normals without direction replaced in scene.json: /shapes/0"));
  // Two faces back to back cancel: one of them is taken.
  mesh.data.indices = {0, 1, 2, 0, 2, 1};
  const Scene back_to_back = build(one_shape(mesh));
  CHECK(std::fabs(back_to_back.vertex_normals[2]) == 1.0f);
}

// ---- materials --------------------------------------------------------------------------------

TEST_CASE("materials: roughness, smooth conductors, emission") {
  SceneDescription d = empty_scene();
  MaterialDescription metal;
  metal.name = "metal";
  metal.kind = kConductor;
  metal.has_ior = true;
  metal.eta = {0.2, 1, 1};
  metal.k = {3, 1e4, 0};
  for (const double roughness : {0.5, 0.03, 0.0, 1.0}) {
    metal.roughness = roughness;
    d.materials.push_back(metal);
  }
  const Scene scene = build(d);
  CHECK(scene.materials[3].kind == kConductor);
  CHECK(scene.materials[3].alpha == 0.25f);
  CHECK(scene.materials[3].has_ior == 1);
  CHECK(scene.materials[4].kind == kMirror);
  CHECK(scene.materials[4].reflectance.x == doctest::Approx((0.64 + 9) / (1.44 + 9)));
  CHECK(scene.materials[4].reflectance.y <= 1.0f);
  CHECK(scene.materials[4].reflectance.y > 0.9999999f);
  CHECK(scene.materials[4].reflectance.z == 0.0f);
  CHECK(scene.materials[5].kind == kMirror);
  CHECK(scene.materials[5].alpha == 1e-3f);
  CHECK(scene.materials[6].alpha == 1.0f);
  CHECK(has_note(scene, "'metal' is smoother"));
  CHECK(scene.materials[kLamp].emission.z == 3);
  CHECK(scene.materials[kTwoSidedLamp].two_sided == 1);
  for (const double bad : {-1.0, std::nan(""), 1e39, static_cast<double>(kInf)}) {
    SceneDescription lamp = one_shape(unit_quad(), kLamp);
    lamp.materials[kLamp].emission[1] = bad;
    check_error(lamp, "scene.json: /materials/1/emission");
  }
}

TEST_CASE("materials: the basic kind where that will do, else the rich one with its tables") {
  SceneDescription d = empty_scene();
  d.materials.clear();
  const auto add = [&](MaterialKind kind, double roughness) -> MaterialDescription & {
    MaterialDescription m;
    m.kind = kind;
    m.roughness = roughness;
    d.materials.push_back(m);
    return d.materials.back();
  };
  add(kConductor, 0.5);
  add(kConductor, 0.5).multiple_scattering = true;
  for (const auto &[x, y] : {std::pair(0.2, 0.6), std::pair(0.5, 0.5), std::pair(0.01, 0.02)}) {
    MaterialDescription &m = add(kConductor, 0);
    m.anisotropic = m.multiple_scattering = true;
    m.roughness_x = x;
    m.roughness_y = y;
    m.has_ior = true;
    m.eta = {0.2, 0.9, 1};
    m.k = {3, 2, 0};
  }
  add(kDielectric, 0);
  add(kDielectric, 0.03);
  add(kDielectric, 0.5);
  add(kDielectric, 0).transmittance = {1, 1, 0.5};
  add(kCoated, 0);
  add(kCoated, 0.5);
  add(kRoughDiffuse, 0.75);
  const Scene scene = build(d);
  const MaterialKind kinds[] = {kConductor,   kGlossyConductor, kGlossyConductor, kGlossyConductor,
                                kMirror,      kDielectric,      kDielectric,      kRoughDielectric,
                                kRoughDielectric, kCoated,      kCoated,          kRoughDiffuse};
  for (std::size_t i = 0; i < std::size(kinds); ++i) CHECK(scene.materials[i].kind == kinds[i]);
  CHECK(scene.materials[0].table == -1);
  const Material &brushed = scene.materials[2];
  CHECK(brushed.alpha_x == 0.04f);
  CHECK(brushed.alpha_y == 0.36f);
  CHECK(brushed.alpha == doctest::Approx(0.12f));
  CHECK((brushed.compensate == 1 && brushed.table >= 0));
  CHECK(brushed.reflectance.x > 0.9f);  // the average of Fresnel's
  CHECK(brushed.table != scene.materials[1].table);
  CHECK(scene.materials[3].table == scene.materials[1].table);  // isotropic, after all
  CHECK(scene.materials[7].alpha == 0.25f);
  CHECK(scene.materials[8].alpha == 0.0f);
  CHECK(scene.materials[8].transmittance.z == 0.5f);
  CHECK(scene.materials[9].alpha == 0.0f);
  CHECK(scene.materials[10].alpha == 0.25f);
  CHECK(scene.materials[9].table == scene.materials[10].table);  // of the same index
  CHECK(scene.materials[11].roughness == 0.75f);
  CHECK(scene.view().tables == scene.tables.data());
}

// ---- lights -----------------------------------------------------------------------------------

TEST_CASE("every emitting primitive is a light") {
  SceneDescription d = empty_scene();
  d.shapes.push_back(shape(triangle()));
  MeshShape mesh = triangle();
  mesh.data.positions.insert(mesh.data.positions.end(), {1, 1, 0});
  mesh.data.indices.insert(mesh.data.indices.end(), {1, 3, 2});
  d.shapes.push_back(shape(mesh, kLamp, moved(scaling(2, 2, 2), 10, 0, 0)));
  d.shapes.push_back(shape(QuadShape{{1, 2, 3}, {2, 0, 0}, {0, 0, 3}}, kTwoSidedLamp));
  d.shapes.push_back(shape(SpheresShape{{{0, 0, 0, 2}, {5, 0, 0, 1}}}, kLamp));
  d.shapes.push_back(shape(DiskShape{{0, 7, 0}, {0, 2, 0}, 0.5}, kLamp));
  const Scene scene = build(d);
  REQUIRE(scene.lights.size() == 6);
  CHECK(scene.geometries[0].first_light == -1);
  CHECK(scene.geometries[1].first_light == 0);
  CHECK(scene.geometries[2].first_light == 2);
  CHECK(scene.geometries[3].first_light == 3);
  CHECK(scene.geometries[4].first_light == 5);
  const int kinds[] = {kTriangleLight, kTriangleLight, kQuadLight,
                       kSphereLight,   kSphereLight,   kDiskLight};
  const double areas[] = {2, 2, 6, 16 * kPi, 4 * kPi, 0.25 * kPi};
  const double extents[] = {
      12, 14, 11, 2 * std::sqrt(3.0), 5 + std::sqrt(3.0), 7 + 0.5 * std::sqrt(3.0)};
  double power = 0;
  for (std::size_t i = 0; i < 6; ++i) power += areas[i] * (i == 2 ? 2 : 1);
  for (std::size_t i = 0; i < 6; ++i) {
    INFO(i);
    const Light &light = scene.lights[i];
    CHECK(light.kind == kinds[i]);
    CHECK(light.area == doctest::Approx(areas[i]).epsilon(1e-6));
    CHECK(light.emission.y == 2);
    CHECK(light.two_sided == (i == 2 ? 1 : 0));
    CHECK(light.select_pdf == doctest::Approx(areas[i] * (i == 2 ? 2 : 1) / power).epsilon(1e-6));
    CHECK(light.error == doctest::Approx(32 * std::pow(2.0, -24) * extents[i]).epsilon(1e-5));
  }
  check_near(scene.lights[1].p, {12, 0, 0});
  check_near(scene.lights[1].p + scene.lights[1].a, {12, 2, 0});
  check_near(scene.lights[1].p + scene.lights[1].b, {10, 2, 0});
  check_near(scene.lights[0].normal, {0, 0, 1});
  check_near(scene.lights[2].normal, {0, -1, 0});
  check_near(scene.lights[5].normal, {0, 1, 0});
  CHECK(scene.lights[4].radius == 1);
  CHECK(total_pdf(scene) == doctest::Approx(1).epsilon(1e-6));
  CHECK(scene.alias_threshold.size() == 6);
}

TEST_CASE("dark and weak emitters") {
  SceneDescription d = empty_scene();
  d.materials[kLamp].emission = {0, 0, 0};
  d.shapes.push_back(shape(unit_quad(), kLamp));
  CHECK(build(d).lights.empty());
  CHECK(build(d).geometries[0].first_light == -1);
  // S6: a lamp 10^30 times as dim as another is still chosen, with the probability it says.
  for (const double factor : {1e-30, 1e-20, 1e20, 1e30}) {
    d = empty_scene();
    d.materials[kLamp].emission = {factor, factor, factor};
    d.materials[kTwoSidedLamp].emission = {1, 1, 1};
    d.shapes.push_back(shape(unit_quad(), kLamp));
    d.shapes.push_back(shape(unit_quad(), kTwoSidedLamp));
    d.shapes.back().transform.m[2][3] = 1;
    const Scene scene = build(d);
    REQUIRE(scene.lights.size() == 2);
    for (const Light &light : scene.lights) CHECK(light.select_pdf > 1e-8f);
    CHECK(total_pdf(scene) == doctest::Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("L8: one strong light among 100,000 weak ones") {
  SceneDescription d = empty_scene();
  d.materials[kLamp].emission = {1, 1, 1};
  d.materials[kTwoSidedLamp] = d.materials[kLamp];
  d.materials[kTwoSidedLamp].emission = {1e-8, 1e-8, 1e-8};
  d.shapes.push_back(shape(unit_quad(), kLamp));
  SpheresShape spheres;
  for (int i = 0; i < 100000; ++i)
    spheres.spheres.push_back({static_cast<double>(i), 5, 0, 1 / std::sqrt(4 * kPi)});
  d.shapes.push_back(shape(spheres, kTwoSidedLamp));
  const Scene scene = build(d);
  REQUIRE(scene.lights.size() == 100001);
  CHECK(scene.lights[0].select_pdf == doctest::Approx(1 / 1.001).epsilon(1e-6));
  CHECK(scene.lights[777].select_pdf == doctest::Approx(1e-8 / 1.001).epsilon(1e-5));
  CHECK(1.0 / static_cast<double>(scene.lights[0].select_pdf) == doctest::Approx(1.001).epsilon(1e-6));
}

// ---- instances --------------------------------------------------------------------------------

namespace {

SceneDescription instanced(const Transform &transform) {
  SceneDescription d = empty_scene();
  d.shapes.push_back(shape(unit_quad()));
  d.groups.resize(1);
  d.groups[0].name = "thing";
  d.groups[0].shapes.push_back(shape(triangle(), kGrey, {}, "scene.json: /groups/0/shapes/0"));
  d.instances.push_back({0, transform, "scene.json: /instances/0"});
  return d;
}

}  // namespace

TEST_CASE("groups come after the top level, instances keep their transforms") {
  SceneDescription d = instanced(moved(scaling(2, 2, 2), 10, 0, 0));
  d.groups.push_back({"other", {shape(unit_sphere()), shape(unit_disk())}});
  d.instances.push_back({1, moved({}, 0, 20, 0), "scene.json: /instances/1"});
  d.instances.push_back({1, scaling(1, 2, 3), "scene.json: /instances/2"});
  const Scene scene = build(d);
  CHECK(scene.top_level.count == 1);
  REQUIRE(scene.groups.size() == 2);
  CHECK(scene.groups[0].first == 1);
  CHECK(scene.groups[0].count == 1);
  CHECK(scene.groups[1].first == 2);
  CHECK(scene.groups[1].count == 2);
  REQUIRE(scene.instances.size() == 3);
  CHECK(scene.instance_group == std::vector<std::int32_t>{0, 1, 1});
  CHECK(scene.instances[1].first_geometry == 2);
  check_near(transform_point(scene.instances[0].to_world, {1, 1, 0}), {12, 2, 0});
  check_near(transform_point(scene.instances[0].to_object, {12, 2, 0}), {1, 1, 0});
  check_near(scene.bounds_hi, {12, 21, 3});
  check_near(scene.bounds_lo, {-1, -2, -3});
  CHECK(scene.lights.empty());
}

TEST_CASE("S7: instance transforms that can and cannot be inverted") {
  for (const Transform &good :
       {scaling(1e-6, 1e-6, 1e-6), scaling(1e4, 1, 1e-4), scaling(-1, 1, 1),
        compose(turn(), scaling(1e6, 1e6, 1e6)), scaling(1e-30, 1e-30, 1e-30)}) {
    const Scene scene = build(instanced(good));
    REQUIRE(scene.instances.size() == 1);
    const Vec3 p =
        transform_point(scene.instances[0].to_object,
                        transform_point(scene.instances[0].to_world, {0.3f, 0.7f, 0.2f}));
    check_near(p, {0.3f, 0.7f, 0.2f}, 1e-5);
  }
  check_error(instanced(scaling(1, 0, 1)), "scene.json: /instances/0: the transform is singular");
  check_error(instanced(scaling(0, 0, 0)), "the transform is singular");
  check_error(instanced(linear({1, 2, 3}, {2, 4, 6}, {0, 0, 1})), "the transform is singular");
  check_error(instanced(scaling(1, 1, 1e-40)), "the transform is singular");
  check_error(instanced(scaling(1, std::nan(""), 1)), "not finite");
  check_error(instanced(moved({}, kInf, 0, 0)), "not finite");
  check_error(instanced(scaling(1e300, 1e300, 1e300)), "not finite");
  check_error(instanced(scaling(1e19, 1e19, 1e19)), "the instance reaches to");
  SceneDescription d = instanced({});
  d.instances[0].group = 1;
  check_error(d, "there is no group 1");
}

TEST_CASE("what emits in a group is baked into the world, once an instance") {
  SceneDescription d = instanced(moved(scaling(2, 2, 2), 10, 0, 0));
  d.groups[0].shapes.push_back(
      shape(unit_quad(), kLamp, moved({}, 0, 0, 1), "scene.json: /groups/0/shapes/1"));
  d.instances.push_back({0, scaling(1, 1, -1), "scene.json: /instances/1"});
  Scene scene = build(d);
  CHECK(scene.top_level.count == 3);
  CHECK(scene.groups[0].count == 1);
  REQUIRE(scene.lights.size() == 2);
  CHECK(scene.geometries[1].first_light == 0);
  CHECK(scene.geometries[2].first_light == 1);
  check_near(scene.lights[0].p, {10, 0, 2});
  CHECK(scene.lights[0].area == doctest::Approx(4));
  check_near(scene.lights[0].normal, {0, 0, 1});
  check_near(scene.lights[1].p, {0, 0, -1});
  check_near(scene.lights[1].normal, {0, 0, -1});  // mirrored, and its outside with it
  CHECK(has_note(scene, "1 emitting shapes of group 'thing'"));
  // Nothing but emitters: the group is empty, and its instances go.
  d.groups[0].shapes.erase(d.groups[0].shapes.begin());
  scene = build(d);
  CHECK(scene.instances.empty());
  CHECK(scene.groups[0].count == 0);
  CHECK(scene.lights.size() == 2);
  CHECK(scene.bounds_hi.x == 12);
  // A sphere that emits cannot become an ellipsoid; one that does not may.
  d.groups[0].shapes = {shape(unit_sphere(), kLamp, {}, "scene.json: /groups/0/shapes/0")};
  d.instances = {{0, scaling(1, 1, 2), "scene.json: /instances/0"}};
  check_error(d,
              "scene.json: /groups/0/shapes/0 placed by scene.json: /instances/0: a sphere can be");
  d.groups[0].shapes[0].material = kGrey;
  CHECK(build(d).instances.size() == 1);
}

// ---- the alias table --------------------------------------------------------------------------

TEST_CASE("alias tables give the weights") {
  std::vector<std::vector<double>> tables = {
      {1}, {1, 1}, {1, 2, 3, 4}, {0, 1, 0, 5}, {1e-300, 2e-300}, {1e300, 1.7e308}, {5, 0}};
  tables.push_back({1});
  tables.back().resize(100001, 1e-8);
  std::vector<double> mixed;
  for (int i = 0; i < 5000; ++i) mixed.push_back(std::exp(10 * std::sin(i * 1.7)));
  tables.push_back(mixed);
  for (const std::vector<double> &weights : tables) {
    const AliasTable table = make_alias_table(weights);
    const std::size_t n = weights.size();
    REQUIRE(table.threshold.size() == n);
    double largest = 0, scaled_sum = 0;
    for (const double w : weights) largest = std::max(largest, w);
    for (const double w : weights) scaled_sum += w / largest;
    std::vector<double> realised(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      const double t = table.threshold[i];
      CHECK((t >= 0 && t <= 1 && table.other[i] >= 0 &&
             static_cast<std::size_t>(table.other[i]) < n));
      realised[i] += t / static_cast<double>(n);
      realised[static_cast<std::size_t>(table.other[i])] += (1 - t) / static_cast<double>(n);
    }
    double total = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double expected = weights[i] / largest / scaled_sum;
      CHECK(std::fabs(realised[i] - expected) <= 1e-6 * expected);
      CHECK(realised[i] == doctest::Approx(table.probability[i]).epsilon(1e-12));
      total += realised[i];
    }
    CHECK(total == doctest::Approx(1).epsilon(1e-9));
  }
  CHECK(make_alias_table({}).threshold.empty());
  CHECK(make_alias_table({0, 0}).threshold.empty());
}

// ---- the camera -------------------------------------------------------------------------------

TEST_CASE("camera: axes, angle, focus") {
  Diagnostics diagnostics;
  CameraDescription d;
  d.position = {1, 2, 3};
  d.look_at = {1, 2, -7};
  d.up = {0.5, 3, 2};
  d.fov = 90;
  d.aperture_radius = 0.25;
  const Camera camera = build_camera(d, diagnostics);
  CHECK_FALSE(diagnostics.has_errors());
  check_near(camera.position, {1, 2, 3});
  check_near(camera.forward, {0, 0, -1});
  CHECK(dot(camera.up, camera.forward) == doctest::Approx(0));
  CHECK(dot(camera.right, camera.up) == doctest::Approx(0));
  check_near(cross(camera.right, camera.up), neg(camera.forward));
  CHECK(camera.up.y > 0.9f);
  CHECK(camera.tan_half_fov_y == doctest::Approx(1));
  CHECK(camera.lens_radius == 0.25f);
  CHECK(camera.focus_distance == doctest::Approx(10));
  d.focus_distance = 4;
  CHECK(build_camera(d, diagnostics).focus_distance == 4);

  const auto error_of_camera = [](const CameraDescription &camera_description) {
    Diagnostics found;
    build_camera(camera_description, found);
    return found.has_errors() ? found.errors()[0].json_path : std::string();
  };
  CameraDescription bad = d;
  bad.look_at = bad.position;
  CHECK(error_of_camera(bad) == "/camera/look_at");
  bad = d;
  bad.up = {0, 0, 5};
  CHECK(error_of_camera(bad) == "/camera/up");
  bad.up = {0, 0, 0};
  CHECK(error_of_camera(bad) == "/camera/up");
  bad = d;
  bad.position[1] = std::nan("");
  CHECK(error_of_camera(bad) == "/camera/position");
  bad = d;
  bad.fov = 180;
  CHECK(error_of_camera(bad) == "/camera/fov");
  bad = d;
  bad.aperture_radius = -1;
  CHECK(error_of_camera(bad) == "/camera/aperture_radius");
  bad = d;
  bad.focus_distance = -1;
  CHECK(error_of_camera(bad) == "/camera/focus_distance");
  bad = d;
  bad.blades = 2;
  CHECK(error_of_camera(bad) == "/camera/blades");
  bad = d;
  bad.height = 0;
  CHECK(error_of_camera(bad) == "/camera/height");
  bad = d;
  bad.angle = 361;
  CHECK(error_of_camera(bad) == "/camera/angle");
}

TEST_CASE("camera: kinds, iris") {
  Diagnostics diagnostics;
  CameraDescription d;
  d.kind = kFisheye;
  d.height = 5;
  d.angle = 270;
  d.aperture_radius = 0.5;
  d.blades = 7;
  d.blade_rotation = -90;
  Camera camera = build_camera(d, diagnostics);
  CHECK(camera.kind == kFisheye);
  CHECK(camera.half_height == 2.5f);
  CHECK(camera.half_angle_turns == 0.375f);
  CHECK(camera.blades == 7);
  CHECK(camera.blade_turns == 0.75f);
  CHECK(camera.lens_radius == 0.0f);  // only perspective cameras have a lens
  d.kind = kPerspective;
  d.blade_rotation = 360;
  camera = build_camera(d, diagnostics);
  CHECK(camera.lens_radius == 0.5f);
  CHECK(camera.blade_turns == 0.0f);
  CHECK_FALSE(diagnostics.has_errors());
}
