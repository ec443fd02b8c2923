// From a hit to a surface: where, which way it faces, and how far a new ray must start off it.
#pragma once
#include "mathx.h"
#include "motion.h"
#include "shape.h"
#include "texture.h"

PHALANX_BEGIN

/// What a ray query returns: which primitive, not where. geometry is -1 where nothing was hit, else
/// a record of SceneView::geometries. Where on the primitive is computed here from the ray, so that
/// the picture does not depend on how Embree rounds in packets and in single rays.
struct Hit {
  int32 geometry, primitive;
  int32 instance;   // -1 outside instances
  int32 far_root;   // spheres: 1 if the ray met the far side
  int32 material;   // 1 + the material that a blend came down to; 0: the geometry's own
  float time;       // of the path, in [0, 1]; 0 in scenes without motion
  float u;          // curves: place on the segment in [0, 1], negative (or -0) on the far side
};

/// Is the hit on a curve? `geometry` and `instance` are Embree's ids.
PHYS bool hits_curve(const UNI SceneView &scene, int32 geometry, int32 instance) {
  if (scene.num_curve_segments == 0) return false;
  int32 record = geometry;
  if (scene.num_instances > 0 && instance >= 0)
    record = geometry + scene.instances[instance - scene.num_top_geometries].first_geometry;
  return scene.geometries[record].shape == kCurves;
}

/// Hit::u from what Embree says of a hit on a curve: u, and the normal in the space of the curve's group.
PHYS float curve_hit_u(const UNI SceneView &scene, int32 instance, float time, float u,
                       Vec3 normal, Vec3 direction) {
  Vec3 d = direction;
  if (scene.num_instances > 0 && instance >= 0) {
    const Instance i = instance_at(scene, instance - scene.num_top_geometries, time);
    d = transform_vector(i.to_object, direction);
  }
  return copy_sign(u, dot(normal, d) > 0.0f ? -1.0f : 1.0f);
}

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
  int32 material;    // of the geometry: a blend where it is one
  int32 light;       // -1 where the material does not emit
  // kRich only.
  TexturePoint at;
  Vec3 dpdu, dpdv;   // how position moves with uv; either may be 0
  Vec3 solid_s, solid_t;  // shading.s and shading.t as steps of at.position
  float thickness;   // metres across a curve; 0 for everything else
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
  Vec2 uv;                                // kRich only, like what follows
  Vec3 dpdu, dpdv, colour;
  float thickness;                        // curves only
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

PHYS Vec2 load_vec2(const UNI float *UNI values, int32 index) {
  return vec2(values[2 * index], values[2 * index + 1]);
}

/// Texture coordinates and vertex colours of a mesh at barycentric u, v. Without texture coordinates, uv
/// are the barycentric ones.
PHYS LocalSurface add_mesh_texture(const UNI SceneView &scene, Geometry g, Triangle t, float u,
                                   float v, Vec3 edge_u, Vec3 edge_v, LocalSurface surface) {
  LocalSurface s = surface;
  const float w = 1.0f - u - v;
  s.uv = vec2(u, v);
  s.dpdu = edge_u;
  s.dpdv = edge_v;
  s.colour = vec3(1.0f, 1.0f, 1.0f);
  if (g.has_uvs != 0) {
    const Vec2 a = load_vec2(scene.vertex_uvs, t.v0 + g.uv_offset);
    const Vec2 b = load_vec2(scene.vertex_uvs, t.v1 + g.uv_offset);
    const Vec2 c = load_vec2(scene.vertex_uvs, t.v2 + g.uv_offset);
    s.uv = vec2(a.x * w + b.x * u + c.x * v, a.y * w + b.y * u + c.y * v);
    // The inverse of (u, v) -> uv, by Cramer's rule; a texture that is collapsed here has no direction.
    const float bu = b.x - a.x;
    const float bv = b.y - a.y;
    const float cu = c.x - a.x;
    const float cv = c.y - a.y;
    const float determinant = bu * cv - bv * cu;
    const float inverse = abs_of(determinant) > 1e-30f ? 1.0f / determinant : 0.0f;
    s.dpdu = (edge_u * cv - edge_v * bv) * inverse;
    s.dpdv = (edge_v * bu - edge_u * cu) * inverse;
  }
  if (g.has_colours != 0) {
    s.colour = load_vec3(scene.vertex_colours, t.v0 + g.colour_offset) * w +
               load_vec3(scene.vertex_colours, t.v1 + g.colour_offset) * u +
               load_vec3(scene.vertex_colours, t.v2 + g.colour_offset) * v;
  }
  return s;
}

template <int D>
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
  if (D == kRich) s = add_mesh_texture(scene, g, t, p.u, v, b - a, c - a, s);
  return s;
}

template <int D>
PHYS LocalSurface quad_surface(const UNI SceneView &scene, Geometry g, Hit hit, Vec3 origin,
                               Vec3 direction) {
  const Quad q = fetch(scene.quads, g.first + hit.primitive);
  const PlanePoint p = meet_plane(origin, direction, q.corner, q.edge_u, q.edge_v);
  LocalSurface s;
  s.position = q.corner + q.edge_u * p.u + q.edge_v * p.v;
  s.normal = p.normal;
  s.shading_normal = s.normal;
  s.extent = abs3(q.corner) + abs3(q.edge_u) + abs3(q.edge_v);
  if (D == kRich) {
    s.uv = vec2(p.u, p.v);
    s.dpdu = q.edge_u;
    s.dpdv = q.edge_v;
    s.colour = vec3(1.0f, 1.0f, 1.0f);
  }
  return s;
}

template <int D>
PHYS LocalSurface sphere_surface(const UNI SceneView &scene, Geometry g, Hit hit, Vec3 origin,
                                 Vec3 direction) {
  const Sphere sphere = scene.spheres[g.first + hit.primitive];
  const float t = sphere_root(origin, direction, sphere, hit.far_root);
  LocalSurface s;
  s.normal = safe_normalize(origin + direction * t - sphere.center, vec3(0.0f, 0.0f, 1.0f));
  s.position = sphere.center + s.normal * sphere.radius;
  s.shading_normal = s.normal;
  s.extent = abs3(sphere.center) + vec3(sphere.radius, sphere.radius, sphere.radius);
  if (D == kRich) {
    const Vec3 n = s.normal;
    s.uv = sphere_uv(n);
    const float ring = safe_sqrt(n.x * n.x + n.y * n.y);  // radius of the circle of latitude
    const float towards = ring > 0.0f ? n.z / ring : 0.0f;
    s.dpdu = vec3(-n.y, n.x, 0.0f) * (2.0f * PHALANX_PI * sphere.radius);
    s.dpdv = vec3(-n.x * towards, -n.y * towards, ring) * (PHALANX_PI * sphere.radius);
    s.colour = vec3(1.0f, 1.0f, 1.0f);
  }
  return s;
}

template <int D>
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
  if (D == kRich) {
    s.uv = disk_uv(xy);
    const float inverse = s.uv.x > 0.0f ? 1.0f / s.uv.x : 0.0f;
    s.dpdu = (disk.axis_u * xy.x + disk.axis_v * xy.y) * inverse;
    s.dpdv = (disk.axis_v * xy.x - disk.axis_u * xy.y) * (2.0f * PHALANX_PI);
    s.colour = vec3(1.0f, 1.0f, 1.0f);
  }
  return s;
}

/// A segment of a strand is what a sphere sweeps from one point to the next while its radius changes
/// (Embree's round linear curves). The hit lies on the sphere at hit.u. uv: place along the strand, 0.
PHYS LocalSurface curve_surface(const UNI SceneView &scene, Geometry g, Hit hit, Vec3 origin,
                                Vec3 direction) {
  const int32 i = scene.curve_segments[g.first + hit.primitive];
  const Vec3 a = vec3(scene.curve_points[4 * i], scene.curve_points[4 * i + 1],
                      scene.curve_points[4 * i + 2]);
  const Vec3 b = vec3(scene.curve_points[4 * i + 4], scene.curve_points[4 * i + 5],
                      scene.curve_points[4 * i + 6]);
  const float radius_a = scene.curve_points[4 * i + 3];
  const float radius_b = scene.curve_points[4 * i + 7];
  const float u = abs_of(hit.u);
  Sphere sphere;
  sphere.center = a * (1.0f - u) + b * u;
  sphere.radius = radius_a * (1.0f - u) + radius_b * u;
  const float t = sphere_root(origin, direction, sphere, bits_from_float(hit.u) < 0 ? 1 : 0);
  LocalSurface s;
  s.normal = safe_normalize(origin + direction * t - sphere.center, vec3(0.0f, 0.0f, 1.0f));
  s.position = sphere.center + s.normal * sphere.radius;
  s.shading_normal = s.normal;
  s.extent = max3(abs3(a), abs3(b)) + vec3(sphere.radius, sphere.radius, sphere.radius);
  const float along_a = scene.curve_along[i];
  const float along_b = scene.curve_along[i + 1];
  s.uv = vec2(along_a * (1.0f - u) + along_b * u, 0.0f);
  s.dpdu = (b - a) * (1.0f / (along_b - along_a));
  s.dpdv = cross(s.normal, s.dpdu);
  s.colour = vec3(1.0f, 1.0f, 1.0f);
  s.thickness = 2.0f * sphere.radius;
  return s;
}

/// The surface of a primitive of geometry g, in the space of its group; the ray is in that space, too.
template <int D>
PHYS LocalSurface local_surface(const UNI SceneView &scene, Geometry g, Hit hit, Vec3 origin,
                                Vec3 direction) {
  if (g.shape == kMesh) return mesh_surface<D>(scene, g, hit, origin, direction);
  if (g.shape == kQuads) return quad_surface<D>(scene, g, hit, origin, direction);
  if (g.shape == kSpheres) return sphere_surface<D>(scene, g, hit, origin, direction);
  if (D == kRich) {
    if (g.shape == kCurves) return curve_surface(scene, g, hit, origin, direction);
  }
  return disk_surface<D>(scene, g, hit, origin, direction);
}

/// The shading frame around n whose first axis follows the texture's u; left-handed where the texture is
/// mirrored, so that the second axis always follows v.
PHYS Frame textured_frame(Vec3 n, Vec3 dpdu, Vec3 dpdv) {
  const Vec3 along = safe_normalize(dpdu - n * dot(n, dpdu), vec3(0.0f, 0.0f, 0.0f));
  if (is_black(along)) return make_frame(n);
  Frame f;
  f.n = n;
  f.s = along;
  f.t = cross(n, along);
  if (dot(f.t, dpdv) < 0.0f) f.t = neg(f.t);
  return f;
}

/// The instance of a hit, where it was when the ray met it.
template <int D>
PHYS Instance placed_instance(const UNI SceneView &scene, Hit hit) {
  if (D == kRich) return instance_at(scene, hit.instance, hit.time);
  return fetch(scene.instances, hit.instance);
}

/// The surface at a hit (hit.geometry >= 0) of the ray (origin, direction), direction unit.
template <int D>
PHYS Surface make_surface(const UNI SceneView &scene, Hit hit, Vec3 origin, Vec3 direction) {
  const Geometry g = fetch(scene.geometries, hit.geometry);
  Vec3 o = origin;
  Vec3 d = direction;
  if (scene.num_instances > 0 && hit.instance >= 0) {
    const Instance instance = placed_instance<D>(scene, hit);
    o = transform_point(instance.to_object, origin);
    d = transform_vector(instance.to_object, direction);
  }
  LocalSurface local = local_surface<D>(scene, g, hit, o, d);
  Surface s;
  if (D == kRich) s.at.position = local.position;

  if (scene.num_instances > 0 && hit.instance >= 0) {
    const Instance instance = placed_instance<D>(scene, hit);
    local.position = transform_point(instance.to_world, local.position);
    local.extent = transform_abs(instance.to_world, local.extent);
    local.normal = safe_normalize(transform_transposed(instance.to_object, local.normal),
                                  neg(direction));
    local.shading_normal = transform_transposed(instance.to_object, local.shading_normal);
    if (D == kRich) {
      if (g.shape == kCurves) {  // their instances are similarities
        const Vec3 row = vec3(instance.to_world.m00, instance.to_world.m01, instance.to_world.m02);
        local.thickness = local.thickness * length(row);
      }
      local.dpdu = transform_vector(instance.to_world, local.dpdu);
      local.dpdv = transform_vector(instance.to_world, local.dpdv);
    }
  }

  const Vec3 outward = local.normal;
  s.position = local.position;
  s.front = dot(outward, direction) <= 0.0f ? 1 : 0;
  s.normal = s.front != 0 ? outward : neg(outward);
  Vec3 ns = safe_normalize(local.shading_normal, s.normal);
  // Shading normals that face away from the viewer would give black or leaking pixels: there the
  // geometric normal takes over.
  if (s.front == 0) ns = neg(ns);
  if (!(dot(ns, direction) < 0.0f)) ns = s.normal;
  if (D == kRich) {
    s.at.uv = local.uv;
    s.at.colour = local.colour;
    s.dpdu = local.dpdu;
    s.dpdv = local.dpdv;
    s.shading = textured_frame(ns, local.dpdu, local.dpdv);
    s.solid_s = s.shading.s;
    s.solid_t = s.shading.t;
    if (scene.num_instances > 0 && hit.instance >= 0) {
      const Instance instance = placed_instance<D>(scene, hit);
      s.solid_s = transform_vector(instance.to_object, s.shading.s);
      s.solid_t = transform_vector(instance.to_object, s.shading.t);
    }
  } else {
    s.shading = make_frame(ns);
  }
  s.offset = offset_bound(local.extent, s.normal);
  if (D == kRich) {
    s.thickness = 0.0f;
    if (g.shape == kCurves) {
      s.thickness = local.thickness;
      s.offset = max_of(s.offset, 5.0e-4f * s.thickness);  // Embree's curves are less precise
    }
  }
  s.material = g.material;
  s.light = g.first_light >= 0 ? g.first_light + hit.primitive : -1;
  return s;
}

/// Where a ray leaving the surface in direction w must start so that it cannot hit it again.
PHYS Vec3 spawn_origin(Surface s, Vec3 w) {
  const float side = dot(w, s.normal) >= 0.0f ? s.offset : -s.offset;
  return s.position + s.normal * side;
}

/// The same for what crosses a curve as a whole: directions below the normal start at the other end of
/// the chord that they cut off the cross section.
PHYS Vec3 spawn_beyond(Surface s, Vec3 w) {
  if (!(s.thickness > 0.0f) || s.front == 0 || dot(w, s.normal) >= 0.0f) return spawn_origin(s, w);
  const Vec3 axis = safe_normalize(s.dpdu, s.shading.s);
  const Vec3 across = safe_normalize(w - axis * dot(w, axis), neg(s.normal));
  Vec3 normal = s.normal - across * (2.0f * dot(across, s.normal));
  // From round ends and along cones that widen: from the side that faces w most.
  if (!(dot(normal, w) > 0.0f)) normal = across;
  return s.position + (normal - s.normal) * (0.5f * s.thickness) + normal * s.offset;
}

PHALANX_END
