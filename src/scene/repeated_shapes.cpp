#include "repeated_shapes.h"

#include <bit>
#include <initializer_list>

namespace phalanx {
namespace {

using std::size_t;

std::uint64_t mix(std::uint64_t x) {  // SplitMix64
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// Two sums of hashes: they do not depend on the order of corners and of primitives.
struct Sums {
  std::uint64_t a = 0, b = 0;

  void add(std::uint64_t item) {
    a += mix(item + 0x9e3779b97f4a7c15u);
    b += mix(item ^ 0xd1b54a32d192ed03u);
  }
};

std::uint64_t hash_of(std::initializer_list<float> values) {
  std::uint64_t h = 0;
  for (const float v : values) h = mix(h + std::bit_cast<std::uint32_t>(v + 0.0f) + 0x632be59bd9b4e019u);  // -0 is 0
  return h;
}
std::uint64_t hash_of(Vec3 p) { return hash_of({p.x, p.y, p.z}); }

std::uint64_t hash_of(const Scene &scene, const Geometry &geometry, size_t primitive) {
  const size_t i = static_cast<size_t>(geometry.first) + primitive;
  if (geometry.shape == kMesh) {
    std::uint64_t sum = 0;
    const Triangle &t = scene.triangles[i];
    for (const std::int32_t v : {t.v0, t.v1, t.v2}) {
      const float *const p = &scene.positions[static_cast<size_t>(v) * 3];
      sum += hash_of({p[0], p[1], p[2]});
    }
    return sum;
  }
  if (geometry.shape == kQuads) {
    const Quad &q = scene.quads[i];
    return hash_of(q.corner) + hash_of(q.corner + q.edge_u) + hash_of(q.corner + q.edge_v) +
           hash_of(q.corner + q.edge_u + q.edge_v);
  }
  if (geometry.shape == kSpheres) {
    const Sphere &s = scene.spheres[i];
    return hash_of({s.center.x, s.center.y, s.center.z, s.radius});
  }
  const Disk &d = scene.disks[i];
  return hash_of(d.center) + hash_of(abs3(d.axis_u)) + hash_of(abs3(d.axis_v));
}

}  // namespace

std::optional<std::string> RepeatedShapes::find(const Scene &scene, size_t g, const std::string &origin) {
  const Geometry &geometry = scene.geometries[g];
  const Material &material = scene.materials[static_cast<size_t>(geometry.material)];
  if (geometry.shape == kCurves || material.opacity < 1 || material.opacity_texture >= 0) return std::nullopt;
  Sums sums;
  const auto count = static_cast<size_t>(scene.num_prims[g]);
  for (size_t i = 0; i < count; ++i) sums.add(hash_of(scene, geometry, i));
  sums.add(static_cast<std::uint64_t>(geometry.shape) << 40 | count);
  const auto [place, is_new] = seen_.try_emplace({sums.a, sums.b}, origin);
  if (is_new) return std::nullopt;
  return place->second;
}

}  // namespace phalanx
