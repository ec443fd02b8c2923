// From a hit to a surface: where, which way it faces, and how far a new ray must start off it.
#pragma once
#include "shape.h"

PHALANX_BEGIN

/// What a ray query returns. geometry is -1 where nothing was hit, else a record of
/// SceneView::geometries. u, v: barycentric coordinates of the second and third corner (mesh),
/// position in the parallelogram (quad); u: which root (sphere); unused for disks.
struct Hit {
  int32 geometry, primitive, instance;  // instance is -1 outside instances
  float u, v;
};

/// A point on a surface, in world space, seen from the direction that a ray came from.
struct Surface {
  Vec3 position;
  Vec3 normal;       // geometric, unit, on the side of the viewer
  Frame shading;     // its third axis on the side of the viewer, too
  float offset;      // metres along `normal` that clear the rounding error of position
  int32 front;       // 1: the viewer is on the side that the surface faces
  int32 material;
  int32 light;       // -1 where the material does not emit
};

/// A bound on the rounding error of a point whose coordinates were computed from numbers no larger
/// than `extent`, projected on a normal: 32 eps sum |extent_i n_i|. Scale-free (STABILITY S1).
PHYS float offset_bound(Vec3 extent, Vec3 normal) {
  return 1.9073486e-6f * dot(extent, abs3(normal));
}

PHYS Vec3 load_vec3(const UNI float *UNI values, int32 index) {
  return vec3(values[3 * index], values[3 * index + 1], values[3 * index + 2]);
}

struct LocalSurface {
  Vec3 position, normal, shading_normal;  // object space; normals not normalised
  Vec3 extent;                            // largest absolute coordinates that entered position
};

PHYS LocalSurface mesh_surface(const UNI SceneView &scene, Geometry g, Hit hit) {
  const Triangle t = scene.triangles[g.first + hit.primitive];
  const Vec3 a = load_vec3(scene.positions, t.v0);
  const Vec3 b = load_vec3(scene.positions, t.v1);
  const Vec3 c = load_vec3(scene.positions, t.v2);
  const float w = 1.0f - hit.u - hit.v;
  LocalSurface s;
  s.position = a * w + b * hit.u + c * hit.v;
  s.normal = cross(b - a, c - a);
  s.extent = max3(max3(abs3(a), abs3(b)), abs3(c));
  s.shading_normal = s.normal;
  if (g.has_normals != 0) {
    s.shading_normal = load_vec3(scene.vertex_normals, t.v0 + g.normal_offset) * w +
                       load_vec3(scene.vertex_normals, t.v1 + g.normal_offset) * hit.u +
                       load_vec3(scene.vertex_normals, t.v2 + g.normal_offset) * hit.v;
  }
  return s;
}

PHYS LocalSurface quad_surface(const UNI SceneView &scene, Geometry g, Hit hit) {
  const Quad q = fetch(scene.quads, g.first + hit.primitive);
  LocalSurface s;
  s.position = q.corner + q.edge_u * hit.u + q.edge_v * hit.v;
  s.normal = cross(q.edge_u, q.edge_v);
  s.shading_normal = s.normal;
  s.extent = abs3(q.corner) + abs3(q.edge_u) + abs3(q.edge_v);
  return s;
}

PHYS LocalSurface sphere_surface(const UNI SceneView &scene, Geometry g, Hit hit, Vec3 origin,
                                 Vec3 direction) {
  const Sphere sphere = scene.spheres[g.first + hit.primitive];
  const float t = sphere_root(origin, direction, sphere, to_int(hit.u));
  LocalSurface s;
  s.normal = safe_normalize(origin + direction * t - sphere.center, vec3(0.0f, 0.0f, 1.0f));
  s.position = sphere.center + s.normal * sphere.radius;
  s.shading_normal = s.normal;
  s.extent = abs3(sphere.center) + vec3(sphere.radius, sphere.radius, sphere.radius);
  return s;
}

PHYS LocalSurface disk_surface(const UNI SceneView &scene, Geometry g, Hit hit, Vec3 origin,
                               Vec3 direction) {
  const Disk disk = scene.disks[g.first + hit.primitive];
  const float t = disk_plane_distance(origin, direction, disk);
  const Vec2 xy = disk_coordinates(origin + direction * t, disk);
  LocalSurface s;
  s.position = disk.center + disk.axis_u * xy.x + disk.axis_v * xy.y;
  s.normal = cross(disk.axis_u, disk.axis_v);
  s.shading_normal = s.normal;
  s.extent = abs3(disk.center) + abs3(disk.axis_u) + abs3(disk.axis_v);
  return s;
}

/// The surface at a hit (hit.geometry >= 0) of the ray (origin, direction), direction unit.
PHYS Surface make_surface(const UNI SceneView &scene, Hit hit, Vec3 origin, Vec3 direction) {
  const Geometry g = fetch(scene.geometries, hit.geometry);
  Vec3 o = origin;
  Vec3 d = direction;
  if (scene.num_instances > 0 && hit.instance >= 0) {
    const Instance instance = fetch(scene.instances, hit.instance);
    o = transform_point(instance.to_object, origin);
    d = transform_vector(instance.to_object, direction);
  }
  LocalSurface local;
  if (g.shape == kMesh) local = mesh_surface(scene, g, hit);
  else if (g.shape == kQuads) local = quad_surface(scene, g, hit);
  else if (g.shape == kSpheres) local = sphere_surface(scene, g, hit, o, d);
  else local = disk_surface(scene, g, hit, o, d);

  if (scene.num_instances > 0 && hit.instance >= 0) {
    const Instance instance = fetch(scene.instances, hit.instance);
    local.position = transform_point(instance.to_world, local.position);
    local.extent = transform_abs(instance.to_world, local.extent);
    local.normal = transform_transposed(instance.to_object, local.normal);
    local.shading_normal = transform_transposed(instance.to_object, local.shading_normal);
  }

  Surface s;
  const Vec3 outward = safe_normalize(local.normal, neg(direction));
  s.position = local.position;
  s.front = dot(outward, direction) <= 0.0f ? 1 : 0;
  s.normal = s.front != 0 ? outward : neg(outward);
  Vec3 ns = safe_normalize(local.shading_normal, s.normal);
  // Shading normals that face away from the viewer would give black or leaking pixels: there the
  // geometric normal takes over.
  if (s.front == 0) ns = neg(ns);
  if (!(dot(ns, direction) < 0.0f)) ns = s.normal;
  s.shading = make_frame(ns);
  s.offset = offset_bound(local.extent, s.normal);
  s.material = g.material;
  s.light = g.first_light >= 0 ? g.first_light + hit.primitive : -1;
  return s;
}

/// Where a ray leaving the surface in direction w must start so that it cannot hit it again.
PHYS Vec3 spawn_origin(Surface s, Vec3 w) {
  const float side = dot(w, s.normal) >= 0.0f ? s.offset : -s.offset;
  return s.position + s.normal * side;
}

PHALANX_END
