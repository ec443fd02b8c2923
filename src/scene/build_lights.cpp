#include "build_lights.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "alias_table.h"
#include "build_materials.h"
#include "light_power.h"
#include "light_tree_build.h"
#include "source_lights.h"
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
  Light light = blank_light();
  light.kind = kTriangleLight;
  set_plane(light, p, q - p, r - p, 0.5);
  light.error = point_error(
      std::max({sum_of_abs(to_double3(p)), sum_of_abs(to_double3(q)), sum_of_abs(to_double3(r))}));
  return light;
}

Light quad_light(const Quad &quad) {
  Light light = blank_light();
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
  Light light = blank_light();
  light.kind = kDiskLight;
  set_plane(light, disk.center, disk.axis_u, disk.axis_v, kPi);
  light.error = round_error(disk.center, length(to_double3(disk.axis_u)));
  return light;
}

Light sphere_light(const Sphere &sphere) {
  Light light = blank_light();
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

/// Texture coordinates and colours of a triangle's point, as at a hit (kernels/physics/surface.h).
void set_triangle_texture(const Scene &scene, const Geometry &geometry, const Triangle &t,
                          Light &light) {
  light.uv_a = {1, 0};
  light.uv_b = {0, 1};
  light.colour = {1, 1, 1};
  if (geometry.has_uvs != 0) {
    const auto at = [&](std::int32_t v) {
      const float *const p = &scene.vertex_uvs[static_cast<size_t>(v + geometry.uv_offset) * 2];
      return Vec2{p[0], p[1]};
    };
    const Vec2 p = at(t.v0), q = at(t.v1), r = at(t.v2);
    light.uv = p;
    light.uv_a = {q.x - p.x, q.y - p.y};
    light.uv_b = {r.x - p.x, r.y - p.y};
  }
  if (geometry.has_colours != 0) {
    const auto at = [&](std::int32_t v) {
      const float *const p =
          &scene.vertex_colours[static_cast<size_t>(v + geometry.colour_offset) * 3];
      return Vec3{p[0], p[1], p[2]};
    };
    light.colour = at(t.v0);
    light.colour_a = at(t.v1) - light.colour;
    light.colour_b = at(t.v2) - light.colour;
  }
}

void set_emission(const Material &material, Light &light) {
  light.emission = material.emission * material.opacity;
  light.two_sided = material.two_sided;
  light.emission_texture = material.emission_texture;
  light.opacity_texture = material.opacity_texture;
}

void add_area_lights(Scene &scene) {
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
      if (geometry.shape == kMesh)
        set_triangle_texture(scene, geometry,
                             scene.triangles[static_cast<size_t>(geometry.first + i)], light);
      set_emission(material, light);
      scene.lights.push_back(light);
    }
  }
}

/// Triangles and rectangles are; other parallelograms are not.
void sample_by_solid_angle(std::vector<Light> &lights) {
  constexpr double kSquare = 1e-5;  // largest cosine of a right angle
  for (Light &light : lights) {
    const Double3 a = to_double3(light.a), b = to_double3(light.b);
    const bool is_rectangle =
        light.kind == kQuadLight && std::fabs(dot(a, b)) <= kSquare * length(a) * length(b);
    light.by_solid_angle = is_rectangle || light.kind == kTriangleLight ? 1 : 0;
  }
}

/// One table over the lights from `first` on.
void choose_by_table(Scene &scene, const std::vector<double> &weights, size_t first, double share) {
  AliasTable table =
      make_alias_table({weights.begin() + static_cast<std::ptrdiff_t>(first), weights.end()});
  scene.alias_threshold.assign(first, 1.0f);
  scene.alias_other.assign(first, 0);
  for (size_t i = 0; i < table.probability.size(); ++i) {
    scene.lights[first + i].select_pdf = static_cast<float>(share * table.probability[i]);
    scene.alias_threshold.push_back(table.threshold[i]);
    scene.alias_other.push_back(table.other[i] + static_cast<std::int32_t>(first));
  }
}

/// The tree for lights at finite distance, a table for the others. Which of the two is a matter of power,
/// but neither is forgotten: what is near or unshadowed may be the weaker.
void choose_by_tree(Scene &scene, const std::vector<double> &weights) {
  constexpr double kLeastShare = 0.1;
  const auto num_infinite = static_cast<size_t>(scene.num_infinite_lights);
  const size_t num_finite = scene.lights.size() - num_infinite;
  const auto border = weights.begin() + static_cast<std::ptrdiff_t>(num_finite);
  const double finite = std::accumulate(weights.begin(), border, 0.0);
  const double infinite = std::accumulate(border, weights.end(), 0.0);
  const double share =
      num_infinite == 0 ? 0
                        : std::clamp(infinite / (finite + infinite), kLeastShare, 1 - kLeastShare);
  scene.infinite_share = static_cast<float>(share);
  choose_by_table(scene, weights, num_finite, static_cast<double>(scene.infinite_share));
  scene.light_nodes = build_light_tree(scene.lights, {weights.begin(), border});
  for (size_t i = 0; i < num_finite; ++i)  // informative only
    scene.lights[i].select_pdf = static_cast<float>((1 - share) * weights[i] / finite);
}

bool wants_tree(LightChoice choice, size_t num_finite) {
  if (choice == LightChoice::kTree) return num_finite > 1;
  return choice == LightChoice::kAuto && num_finite > kMaxLightsByPower;
}

}  // namespace

void build_lights(Scene &scene, const SceneDescription &description, Diagnostics &diagnostics) {
  add_area_lights(scene);
  add_point_lights(description, scene, diagnostics);
  const size_t num_finite = scene.lights.size();
  const std::vector<double> infinite = add_infinite_lights(description, scene, diagnostics);
  if (description.integrator.light_points == LightPoints::kSolidAngle)
    sample_by_solid_angle(scene.lights);
  std::vector<double> weights = light_powers(scene, infinite);
  const LightChoice choice = description.integrator.light_choice;
  if (wants_tree(choice, num_finite)) return choose_by_tree(scene, weights);
  if (choice == LightChoice::kUniform) weights.assign(weights.size(), 1.0);
  choose_by_table(scene, weights, 0, 1);
}

bool has_rich_lights(const Scene &scene) {
  if (!scene.light_nodes.empty()) return true;
  return std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light &light) {
    return light.kind > kDiskLight || light.by_solid_angle != 0 || light.emission_texture >= 0 ||
           light.opacity_texture >= 0;
  });
}

}  // namespace phalanx
