// From a hit to a surface: where, which way it faces, and how far a new ray must start off it.
#pragma once
#include "shape.h"

PHALANX_BEGIN

/// What a ray query returns: which primitive, not where. geometry is -1 where nothing was hit, else
/// a record of SceneView::geometries. Where on the primitive is computed here from the ray, so that
/// the picture does not depend on how Embree rounds in packets and in single rays.
struct Hit {
  int32 geometry, primitive;
  int32 instance;   // -1 outside instances
  int32 far_root;   // spheres: 1 if the ray met the far side
};

/// True for barycentric coordinates so near an edge that a neighbour can be hit at the same distance.
/// Which of the two a query returns then depends on the order in which it visited them: packets, single
/// rays and differently built trees disagree. Such hits (one in some thousand) are decided once more, by
/// the lowest primitive number: resolve_tie() in src/scene/accel.cpp.
PHYS bool may_tie(float u, float v) {
  const float w = 1.0f - u - v;
  return min_of(min_of(u, v), min_of(abs_of(w), min_of(1.0f - u, 1.0f - v))) < 1.0e-4f;
}

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
  Vec3 position, normal, shading_normal;  // object space; normal is unit, shading_normal is not
  Vec3 extent;                            // largest absolute coordinates that entered position
};

struct PlanePoint {
  Vec3 normal;  // unit, along edge_u x edge_v
  float u, v;   // of the point corner + u * edge_u + v * edge_v
};

/// Where the line (origin, direction), which is known to hit, meets the plane of two edges.
PHYS PlanePoint meet_plane(Vec3 origin, Vec3 direction, Vec3 corner, Vec3 edge_u, Vec3 edge_v) {
  PlanePoint p;
  const Vec3 n = cross(edge_u, edge_v);
  // The length by way of the largest component: squares of tiny or huge areas leave the floats.
  const float m = max_component(abs3(n));
  const Vec3 scaled = n * (1.0f / m);
  const float inv_length = 1.0f / length(scaled);
  p.normal = scaled * inv_length;
  const float inv_area = inv_length / m;
  const Vec3 to_corner = corner - origin;
  const float slope = dot(direction, p.normal);
  const float t = slope != 0.0f ? dot(to_corner, p.normal) / slope : 0.0f;
  const Vec3 q = direction * t - to_corner;
  p.u = clamp_to(dot(cross(q, edge_v), p.normal) * inv_area, 0.0f, 1.0f);
  p.v = clamp_to(dot(cross(edge_u, q), p.normal) * inv_area, 0.0f, 1.0f);
  return p;
}

PHYS LocalSurface mesh_surface(const UNI SceneView &scene, Geometry g, Hit hit, Vec3 origin,
                               Vec3 direction) {
  const Triangle t = scene.triangles[g.first + hit.primitive];
  const Vec3 a = load_vec3(scene.positions, t.v0);
  const Vec3 b = load_vec3(scene.positions, t.v1);
  const Vec3 c = load_vec3(scene.positions, t.v2);
  const PlanePoint p = meet_plane(origin, direction, a, b - a, c - a);
  const float v = min_of(p.v, 1.0f - p.u);
  const float w = 1.0f - p.u - v;
  LocalSurface s;
  s.position = a * w + b * p.u + c * v;
  s.normal = p.normal;
  s.extent = max3(max3(abs3(a), abs3(b)), abs3(c));
  s.shading_normal = s.normal;
  if (g.has_normals != 0) {
    s.shading_normal = load_vec3(scene.vertex_normals, t.v0 + g.normal_offset) * w +
                       load_vec3(scene.vertex_normals, t.v1 + g.normal_offset) * p.u +
                       load_vec3(scene.vertex_normals, t.v2 + g.normal_offset) * v;
  }
  return s;
}

PHYS LocalSurface quad_surface(const UNI SceneView &scene, Geometry g, Hit hit, Vec3 origin,
                               Vec3 direction) {
  const Quad q = fetch(scene.quads, g.first + hit.primitive);
  const PlanePoint p = meet_plane(origin, direction, q.corner, q.edge_u, q.edge_v);
  LocalSurface s;
  s.position = q.corner + q.edge_u * p.u + q.edge_v * p.v;
  s.normal = p.normal;
  s.shading_normal = s.normal;
  s.extent = abs3(q.corner) + abs3(q.edge_u) + abs3(q.edge_v);
  return s;
}

PHYS LocalSurface sphere_surface(const UNI SceneView &scene, Geometry g, Hit hit, Vec3 origin,
                                 Vec3 direction) {
  const Sphere sphere = scene.spheres[g.first + hit.primitive];
  const float t = sphere_root(origin, direction, sphere, hit.far_root);
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
  s.normal = safe_normalize(cross(disk.axis_u, disk.axis_v), vec3(0.0f, 0.0f, 1.0f));
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
  if (g.shape == kMesh) local = mesh_surface(scene, g, hit, o, d);
  else if (g.shape == kQuads) local = quad_surface(scene, g, hit, o, d);
  else if (g.shape == kSpheres) local = sphere_surface(scene, g, hit, o, d);
  else local = disk_surface(scene, g, hit, o, d);

  if (scene.num_instances > 0 && hit.instance >= 0) {
    const Instance instance = fetch(scene.instances, hit.instance);
    local.position = transform_point(instance.to_world, local.position);
    local.extent = transform_abs(instance.to_world, local.extent);
    local.normal = safe_normalize(transform_transposed(instance.to_object, local.normal),
                                  neg(direction));
    local.shading_normal = transform_transposed(instance.to_object, local.shading_normal);
  }

  Surface s;
  const Vec3 outward = local.normal;
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
