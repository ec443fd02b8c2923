#include "build_lights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "alias_table.h"
#include "build_materials.h"
#include "transform.h"

namespace phalanx {
namespace {

using std::size_t;

constexpr double kPi = 3.14159265358979323846;

Double3 to_double3(Vec3 v) { return {v.x, v.y, v.z}; }

double sum_of_abs(const Double3 &p) { return std::fabs(p[0]) + std::fabs(p[1]) + std::fabs(p[2]); }

/// Bound on the rounding error of a point computed on a primitive none of whose points has a larger
/// |x| + |y| + |z|: 32 units of roundoff cover the sampling and the tracing (STABILITY: S1).
float point_error(double largest_sum) { return static_cast<float>(32.0 * 0x1p-24 * largest_sum); }

Vec3 unit_normal(const Double3 &normal, double size) {
  return {static_cast<float>(normal[0] / size), static_cast<float>(normal[1] / size),
          static_cast<float>(normal[2] / size)};
}

/// A light spanned by a and b from p; `share` is its part of the parallelogram's area.
void set_plane(Light &light, Vec3 p, Vec3 a, Vec3 b, double share) {
  light.p = p;
  light.a = a;
  light.b = b;
  const Double3 n = cross(to_double3(a), to_double3(b));
  const double size = length(n);
  light.normal = unit_normal(n, size);
  light.area = static_cast<float>(share * size);
}

Light triangle_light(const Scene &scene, const Triangle &t) {
  const auto at = [&](std::int32_t v) {
    const float *const p = &scene.positions[static_cast<size_t>(v) * 3];
    return Vec3{p[0], p[1], p[2]};
  };
  const Vec3 p = at(t.v0), q = at(t.v1), r = at(t.v2);
  Light light = {};
  light.kind = kTriangleLight;
  set_plane(light, p, q - p, r - p, 0.5);
  light.error = point_error(
      std::max({sum_of_abs(to_double3(p)), sum_of_abs(to_double3(q)), sum_of_abs(to_double3(r))}));
  return light;
}

Light quad_light(const Quad &quad) {
  Light light = {};
  light.kind = kQuadLight;
  set_plane(light, quad.corner, quad.edge_u, quad.edge_v, 1.0);
  double largest = 0;
  for (const float s : {0.0f, 1.0f})
    for (const float t : {0.0f, 1.0f})
      largest = std::max(largest,
                         sum_of_abs(to_double3(quad.corner + quad.edge_u * s + quad.edge_v * t)));
  light.error = point_error(largest);
  return light;
}

/// No point of a sphere or disk has |x| + |y| + |z| above that of the centre + sqrt(3) radii.
float round_error(Vec3 center, double radius) {
  return point_error(sum_of_abs(to_double3(center)) + std::sqrt(3.0) * radius);
}

Light disk_light(const Disk &disk) {
  Light light = {};
  light.kind = kDiskLight;
  set_plane(light, disk.center, disk.axis_u, disk.axis_v, kPi);
  light.error = round_error(disk.center, length(to_double3(disk.axis_u)));
  return light;
}

Light sphere_light(const Sphere &sphere) {
  Light light = {};
  light.kind = kSphereLight;
  light.p = sphere.center;
  light.radius = sphere.radius;
  const double r = sphere.radius;
  light.area = static_cast<float>(4.0 * kPi * r * r);
  light.error = round_error(sphere.center, r);
  return light;
}

Light primitive_light(const Scene &scene, const Geometry &geometry, std::int32_t primitive) {
  const auto i = static_cast<size_t>(geometry.first + primitive);
  switch (geometry.shape) {
    case kMesh:
      return triangle_light(scene, scene.triangles[i]);
    case kQuads:
      return quad_light(scene.quads[i]);
    case kSpheres:
      return sphere_light(scene.spheres[i]);
    default:
      return disk_light(scene.disks[i]);
  }
}

/// Power but for a factor that all lights share; at least kMinLightShare of the mean.
std::vector<double> selection_weights(const Scene &scene) {
  std::vector<double> weights;
  weights.reserve(scene.lights.size());
  for (const Light &light : scene.lights) {
    Material emitter = {};
    emitter.emission = light.emission;
    weights.push_back(emitted_luminance(emitter) * static_cast<double>(light.area) *
                      (light.two_sided != 0 ? 2.0 : 1.0));
  }
  const double mean = std::accumulate(weights.begin(), weights.end(), 0.0) /
                      static_cast<double>(std::max<size_t>(weights.size(), 1));
  for (double &weight : weights) weight = std::max(weight, mean * kMinLightShare);
  return weights;
}

}  // namespace

void build_lights(Scene &scene) {
  const auto emits = [&](size_t g) {
    return emitted_luminance(scene.materials[static_cast<size_t>(scene.geometries[g].material)]) >
           0;
  };
  size_t num_lights = 0;
  for (size_t g = 0; g < static_cast<size_t>(scene.top_level.count); ++g)
    if (emits(g)) num_lights += static_cast<size_t>(scene.num_prims[g]);
  scene.lights.reserve(num_lights);
  for (size_t g = 0; g < static_cast<size_t>(scene.top_level.count); ++g) {
    if (!emits(g)) continue;
    Geometry &geometry = scene.geometries[g];
    const Material &material = scene.materials[static_cast<size_t>(geometry.material)];
    geometry.first_light = static_cast<std::int32_t>(scene.lights.size());
    for (std::int32_t i = 0; i < scene.num_prims[g]; ++i) {
      Light light = primitive_light(scene, geometry, i);
      light.emission = material.emission;
      light.two_sided = material.two_sided;
      scene.lights.push_back(light);
    }
  }
  AliasTable table = make_alias_table(selection_weights(scene));
  for (size_t i = 0; i < scene.lights.size(); ++i)
    scene.lights[i].select_pdf = static_cast<float>(table.probability[i]);
  scene.alias_threshold = std::move(table.threshold);
  scene.alias_other = std::move(table.other);
}

bool has_rich_lights(const Scene &scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light &light) { return light.kind >= kPointLight; });
}

}  // namespace phalanx
