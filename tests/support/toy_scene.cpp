#include "toy_scene.h"

#include "lights.h"
#include "materials.h"

namespace phalanx::test {
namespace {

constexpr int kPrimitives = 4;  // of each geometry

Material glowing(Material m, int two_sided) {
  m.emission = {3, 2, 1};
  m.two_sided = two_sided;
  return m;
}

std::vector<Material> toy_materials() {
  Material gold = conductor(0.2f);
  gold.has_ior = 1;
  gold.eta = {0.166f, 0.42f, 1.35f};
  gold.k = {3.15f, 2.37f, 1.88f};
  Material red = diffuse(0.5f);
  red.reflectance = {0.8f, 0.2f, 0.1f};
  Material brushed = material(kConductor, 0.7f);
  brushed.alpha = 0.01f;
  std::vector<Material> all = {
      red,     mirror(0.9f),        dielectric(1.5f),          gold,
      brushed, material(kBlack, 0), glowing(diffuse(0.3f), 0), glowing(material(kBlack, 0), 1)};
  for (std::size_t i = 1; i < all.size(); ++i)
    all[i].ior = 1.5f;  // twins try every kind on every one
  return all;
}

Quad random_quad(Random &random, float size) {
  const Vec3 corner = random.point(size), u = random.direction();
  return {corner, u * random.between(0.1f * size, size),
          random.direction() * random.between(0.1f * size, size)};
}

Disk random_disk(Random &random, float size) {
  const Frame f = make_frame(random.direction());
  const float radius = random.between(0.1f * size, size);
  return {random.point(size), f.s * radius, f.t * radius};
}

/// Rotation times scales (two of three differ, one in two mirrors) and a shift.
Instance random_instance(Random &random, float size) {
  const Frame f = make_frame(random.direction());
  const Vec3 shift = random.point(size);
  const float sx = random.between(0.5f, 2), sy = random.between(0.5f, 2);
  const float sz = random.chance(0.5) ? -sx : sx;
  Instance i = {};
  i.to_world = {f.s.x * sx, f.t.x * sy, f.n.x * sz, shift.x,    f.s.y * sx, f.t.y * sy,
                f.n.y * sz, shift.y,    f.s.z * sx, f.t.z * sy, f.n.z * sz, shift.z};
  const Vec3 s = f.s * (1 / sx), t = f.t * (1 / sy), n = f.n * (1 / sz);
  i.to_object = {s.x, s.y, s.z, -dot(s, shift), t.x, t.y, t.z, -dot(t, shift),
                 n.x, n.y, n.z, -dot(n, shift)};
  return i;
}

void add_primitives(ToyScene &scene, ShapeKind shape, Random &random, float size) {
  for (int i = 0; i < kPrimitives; ++i) {
    if (shape == kQuads) scene.quads.push_back(random_quad(random, size));
    if (shape == kSpheres)
      scene.spheres.push_back({random.point(size), random.between(0.1f * size, size)});
    if (shape == kDisks) scene.disks.push_back(random_disk(random, size));
    if (shape != kMesh) continue;
    const auto first = static_cast<int32>(scene.positions.size() / 3);
    const Quad q = random_quad(random, size);
    const Vec3 n = normalize(cross(q.edge_u, q.edge_v));
    for (const Vec3 p : {q.corner, q.corner + q.edge_u, q.corner + q.edge_v}) {
      scene.positions.insert(scene.positions.end(), {p.x, p.y, p.z});
      const Vec3 bent = normalize(n + random.direction() * 0.5f);
      scene.normals.insert(scene.normals.end(), {bent.x, bent.y, bent.z});
    }
    scene.triangles.push_back({first, first + 1, first + 2});
  }
}

std::size_t primitives_of(const ToyScene &scene, ShapeKind shape) {
  return shape == kMesh      ? scene.triangles.size()
         : shape == kQuads   ? scene.quads.size()
         : shape == kSpheres ? scene.spheres.size()
                             : scene.disks.size();
}

Light light_of(const ToyScene &scene, const Geometry &g, std::size_t i) {
  if (g.shape == kSpheres) return sphere_light(scene.spheres[i].center, scene.spheres[i].radius);
  if (g.shape == kQuads) {
    const Quad &q = scene.quads[i];
    return planar_light(kQuadLight, q.corner, q.edge_u, q.edge_v);
  }
  if (g.shape == kDisks) {
    const Disk &d = scene.disks[i];
    return planar_light(kDiskLight, d.center, d.axis_u, d.axis_v);
  }
  const Vec3 a = load_vec3(scene.positions.data(), scene.triangles[i].v0);
  const Vec3 b = load_vec3(scene.positions.data(), scene.triangles[i].v1);
  const Vec3 c = load_vec3(scene.positions.data(), scene.triangles[i].v2);
  return planar_light(kTriangleLight, a, b - a, c - a);
}

/// A point of a primitive in its own space.
Vec3 point_on(const ToyScene &scene, const Geometry &g, std::size_t i, Random &random) {
  const Vec2 u = random.square();
  if (g.shape == kSpheres)
    return scene.spheres[i].center + random.direction() * scene.spheres[i].radius;
  if (g.shape == kQuads)
    return scene.quads[i].corner + scene.quads[i].edge_u * u.x + scene.quads[i].edge_v * u.y;
  if (g.shape == kDisks) {
    const Vec2 d = square_to_disk(u);
    return scene.disks[i].center + scene.disks[i].axis_u * d.x + scene.disks[i].axis_v * d.y;
  }
  const Vec2 b = square_to_triangle(u);
  const Vec3 p = load_vec3(scene.positions.data(), scene.triangles[i].v0);
  return p + (load_vec3(scene.positions.data(), scene.triangles[i].v1) - p) * b.x +
         (load_vec3(scene.positions.data(), scene.triangles[i].v2) - p) * b.y;
}

}  // namespace

int32 ToyScene::add_geometry(ShapeKind shape, int32 material, std::size_t first) {
  Geometry g = {};
  g.shape = shape;
  g.material = material;
  g.kind = materials[static_cast<std::size_t>(material)].kind;
  g.first = static_cast<int32>(first);
  g.first_light = -1;
  geometries.push_back(g);
  return static_cast<int32>(geometries.size()) - 1;
}

void ToyScene::add_lights(int32 geometry, int32 num_primitives) {
  Geometry &g = geometries[static_cast<std::size_t>(geometry)];
  g.first_light = static_cast<int32>(lights.size());
  for (int32 i = 0; i < num_primitives; ++i) {
    Light light = light_of(*this, g, static_cast<std::size_t>(g.first + i));
    light.emission = materials[static_cast<std::size_t>(g.material)].emission;
    light.two_sided = materials[static_cast<std::size_t>(g.material)].two_sided;
    lights.push_back(light);
  }
  const AliasTable table = make_alias_table(std::vector<double>(lights.size(), 1.0));
  alias_threshold = table.threshold;
  alias_other = table.other;
  for (std::size_t i = 0; i < lights.size(); ++i)
    lights[i].select_pdf = static_cast<float>(table.probability[i]);
}

SceneView ToyScene::view() const {
  SceneView v = {};
  v.materials = materials.data();
  v.geometries = geometries.data();
  v.positions = positions.data();
  v.vertex_normals = normals.data();
  v.triangles = triangles.data();
  v.quads = quads.data();
  v.spheres = spheres.data();
  v.disks = disks.data();
  v.instances = instances.data();
  v.lights = lights.data();
  v.alias_threshold = alias_threshold.data();
  v.alias_other = alias_other.data();
  textures.put_into(v);
  v.curve_points = curve_points.data();
  v.curve_along = curve_along.data();
  v.curve_segments = curve_segments.data();
  v.tables = tables.data();
  v.num_materials = static_cast<int32>(materials.size());
  v.num_geometries = static_cast<int32>(geometries.size());
  v.num_lights = static_cast<int32>(lights.size());
  v.num_instances = static_cast<int32>(instances.size());
  v.num_spheres = static_cast<int32>(spheres.size());
  v.environment = {0.1f, 0.2f, 0.3f};
  v.has_environment = 1;
  return v;
}

FrameView ToyScene::frame() const {
  FrameView f = {};
  f.camera = {{0, 0, 5}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 0.5f, 0.1f, 4.0f};
  f.width = 64;
  f.height = 48;
  f.filter_offsets = filter_offsets.data();
  f.sampler = kSobolSampler;
  f.seed = 1;
  f.max_depth = 8;
  f.roulette_depth = 2;
  return f;
}

ToyScene random_scene(std::uint64_t seed, float size) {
  Random random(seed);
  ToyScene scene;
  scene.materials = toy_materials();
  Random texture_random(seed + 1);
  scene.textures = random_textures(texture_random);
  Random table_random(seed + 2);
  constexpr int kTables = 4;
  for (int i = 0; i < kTables * PHALANX_ALBEDO_FLOATS; ++i)
    scene.tables.push_back(table_random.between(0.01f, 0.99f));
  for (int i = 0; i <= PHALANX_FILTER_CELLS; ++i)
    scene.filter_offsets.push_back(static_cast<float>(i) / PHALANX_FILTER_CELLS - 0.5f);
  scene.curve_points = {0, 0, 0, 0.1f,  0.2f, 0.9f, 0.1f, 0.05f, 0.9f, 0.8f, 0.3f, 0.02f,
                        1, 1, 0, 0.01f, 0,    0,    1,    0.3f};
  scene.curve_along = {0, 0.5f, 1, 0, 1};
  scene.curve_segments = {0, 1, 3};
  for (const ShapeKind shape : {kMesh, kQuads, kSpheres, kDisks})
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
      const int32 g = scene.add_geometry(shape, static_cast<int32>(m), primitives_of(scene, shape));
      scene.geometries.back().has_normals = shape == kMesh && m % 2 == 0;
      add_primitives(scene, shape, random, size);
      if (!is_black(scene.materials[m].emission)) scene.add_lights(g, kPrimitives);
    }
  for (int i = 0; i < 6; ++i) scene.instances.push_back(random_instance(random, size));
  return scene;
}

AimedRay aimed_ray(const ToyScene &scene, Random &random, float size) {
  AimedRay ray;
  ray.hit.geometry = random.below(static_cast<int>(scene.geometries.size()));
  ray.hit.primitive = random.below(kPrimitives);
  ray.hit.instance = -1;
  ray.hit.far_root = 0;
  const Geometry &g = scene.geometries[static_cast<std::size_t>(ray.hit.geometry)];
  const auto primitive = static_cast<std::size_t>(g.first + ray.hit.primitive);
  Vec3 target = point_on(scene, g, primitive, random);
  if (g.first_light < 0 && random.chance(0.3)) {
    ray.hit.instance = random.below(static_cast<int>(scene.instances.size()));
    target = transform_point(scene.instances[static_cast<std::size_t>(ray.hit.instance)].to_world,
                             target);
  }
  ray.origin = random.point(3 * size);
  ray.direction = normalize(target - ray.origin);
  if (g.shape == kSpheres) {
    Vec3 o = ray.origin, to = target;
    if (ray.hit.instance >= 0) {
      const Affine &m = scene.instances[static_cast<std::size_t>(ray.hit.instance)].to_object;
      o = transform_point(m, o);
      to = transform_point(m, to);
    }
    // The target is the far crossing where its normal points along the ray.
    ray.hit.far_root = dot(to - scene.spheres[primitive].center, to - o) > 0 ? 1 : 0;
  }
  return ray;
}

}  // namespace phalanx::test
