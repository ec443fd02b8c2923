// What a kernel may read of a scene and of a frame: plain structs shared by host and kernels.
//
// The host owns the arrays (src/scene/scene.h); a view only points at them and is valid while the
// scene lives. Layout is the same in both languages; tests/twin/ compares sizes and offsets.
#pragma once
#include "physics/vec.h"

PHALANX_BEGIN

// ---- materials --------------------------------------------------------------------------------

/// Every kind of scattering: constant, name, 1 if it has a density that light can be sampled for.
/// One line here gives a kind its shade kernel, its place in every schedule, its stage and its name;
/// its functions are named in physics/bsdf.h (docs/add-a-material.md).
///   mirror: perfect specular reflection     dielectric: smooth, delta reflection and transmission
///   conductor: rough, GGX                   black: scatters nothing: pure emitters and absorbers
#define PHALANX_MATERIAL_KINDS(X) \
  X(kDiffuse, diffuse, 1)         \
  X(kMirror, mirror, 0)           \
  X(kDielectric, dielectric, 0)   \
  X(kConductor, conductor, 1)     \
  X(kBlack, black, 0)

/// kNumMaterialKinds is also the bucket of rays that left the scene.
enum MaterialKind {
#define PHALANX_KIND(constant, name, density) constant,
  PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
  kNumMaterialKinds
};

struct Material {
  int32 kind;              // MaterialKind
  Vec3 reflectance;        // diffuse: albedo. mirror, conductor: reflectance at normal incidence (F0)
  Vec3 eta, k;             // conductor: complex index of refraction, used when has_ior is not 0
  int32 has_ior;
  float alpha;             // conductor: GGX roughness, in [1e-3, 1]
  float ior;               // dielectric: inside over outside, > 0
  Vec3 emission;           // radiance leaving the surface, W sr^-1 m^-2
  int32 two_sided;         // emission: 1 emits on both sides, 0 on the side of the geometric normal
};

// ---- geometry ---------------------------------------------------------------------------------

enum ShapeKind { kMesh = 0, kQuads = 1, kSpheres = 2, kDisks = 3 };

/// One per Embree geometry.
struct Geometry {
  int32 shape;           // ShapeKind
  int32 material;        // index into materials
  int32 kind;            // MaterialKind of that material
  int32 first;           // index of primitive 0 in triangles / quads / spheres / disks
  int32 first_light;     // light of primitive 0, the others follow; -1 when it does not emit
  int32 normal_offset;   // meshes: normal of vertex v is vertex_normals[v + normal_offset]
  int32 has_normals;     // meshes: 1 if it has shading normals
};

/// Vertex indices, absolute in SceneView::positions. Counter-clockwise seen from outside.
struct Triangle {
  int32 v0, v1, v2;
};

/// Parallelogram corner + u * edge_u + v * edge_v, u, v in [0,1]. Normal: edge_u x edge_v.
struct Quad {
  Vec3 corner, edge_u, edge_v;
};

struct Sphere {
  Vec3 center;
  float radius;  // > 0
};

/// Points center + x * axis_u + y * axis_v with x^2 + y^2 <= 1; the axes are orthogonal and both
/// have the length of the radius. Normal: axis_u x axis_v.
struct Disk {
  Vec3 center, axis_u, axis_v;
};

struct Instance {
  int32 first_geometry;  // record of geometry 0 of the instanced group
  Affine to_world;
  Affine to_object;      // inverse of to_world
};

// ---- lights -----------------------------------------------------------------------------------

enum LightKind { kTriangleLight = 0, kQuadLight = 1, kSphereLight = 2, kDiskLight = 3 };

/// One per emitting primitive, in world space.
///   triangle: p + u * a + v * b, u + v <= 1     quad: p + u * a + v * b
///   disk:     centre p, axes a, b               sphere: centre p, radius
struct Light {
  int32 kind;        // LightKind
  int32 two_sided;
  Vec3 p, a, b;
  Vec3 normal;       // unit, geometric; unused for spheres
  float radius;      // spheres
  float area;        // > 0
  float select_pdf;  // probability that choose_light returns this light, > 0
  float error;       // bound on the rounding error of a sampled point, in metres
  Vec3 emission;     // W sr^-1 m^-2
};

// ---- the scene --------------------------------------------------------------------------------

struct SceneView {
  void *UNI accel;                        // Embree's scene (src/scene/accel.h)
  const UNI Material *UNI materials;      // [num_materials]
  const UNI Geometry *UNI geometries;     // [num_geometries]
  const UNI float *UNI positions;         // [num_vertices * 3] object space of the mesh's group
  const UNI float *UNI vertex_normals;    // [num_normals * 3] unit
  const UNI Triangle *UNI triangles;      // [num_triangles]
  const UNI Quad *UNI quads;
  const UNI Sphere *UNI spheres;
  const UNI Disk *UNI disks;
  const UNI Instance *UNI instances;      // [num_instances]
  const UNI Light *UNI lights;            // [num_lights]
  const UNI float *UNI alias_threshold;   // [num_lights] Walker's alias table over select_pdf
  const UNI int32 *UNI alias_other;       // [num_lights]
  int32 num_materials, num_geometries, num_lights, num_instances, num_spheres;
  int32 num_top_geometries;  // Embree ids below this are geometries, from it on instances
  int32 has_environment;     // 0: rays that leave the scene bring nothing
  Vec3 environment;          // constant radiance from all directions
};

// ---- the frame --------------------------------------------------------------------------------

struct Camera {
  Vec3 position;
  Vec3 right, up, forward;  // unit, orthogonal; forward points into the picture
  float tan_half_fov_y;     // > 0
  float lens_radius;        // metres; 0 is a pinhole
  float focus_distance;     // metres along forward, > 0
};

enum FilterKind { kBoxFilter = 0, kGaussianFilter = 1, kBlackmanHarrisFilter = 2 };
#define PHALANX_FILTER_CELLS 1024  // of the table that inverts a filter's distribution function
enum SamplerKind { kSobolSampler = 0, kIndependentSampler = 1 };

/// Everything about a picture that is not the scene.
struct FrameView {
  Camera camera;
  int32 width, height;      // of the full picture, pixels
  // Reconstruction filter by importance sampling: [PHALANX_FILTER_CELLS + 1] offsets from the
  // pixel's centre in pixels, at equal steps of the filter's 1-D distribution function.
  const UNI float *UNI filter_offsets;
  int32 sampler;            // SamplerKind
  int32 seed;
  int32 max_depth;          // scattering events after the camera; 0 shows emission only
  int32 roulette_depth;     // Russian roulette from this scattering event on
};

PHALANX_END
