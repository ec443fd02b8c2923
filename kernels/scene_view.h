// What a kernel may read of a scene and of a frame: plain structs shared by host and kernels.
//
// The host owns the arrays (src/scene/scene.h); a view only points at them and is valid while the
// scene lives. Layout is the same in both languages; tests/twin/ compares sizes and offsets.
#pragma once
#include "physics/vec.h"

PHALANX_BEGIN

// ---- materials --------------------------------------------------------------------------------

/// Every kind of scattering: constant, name, 1 if it has a density that light can be sampled for, 1 if
/// it lets light through. One line here gives a kind its shade kernels, its place in every schedule, its
/// stage and its name; its functions are named in physics/bsdf.h (docs/add-a-material.md).
/// The basic kinds need nothing but constants, and have kernels without textures and the like, too.
///   mirror: perfect specular reflection     dielectric: smooth, delta reflection and transmission
///   conductor: rough, GGX                   black: scatters nothing: pure emitters and absorbers
#define PHALANX_BASIC_KINDS(X)      \
  X(kDiffuse, diffuse, 1, 0)        \
  X(kMirror, mirror, 0, 0)          \
  X(kDielectric, dielectric, 0, 1)  \
  X(kConductor, conductor, 1, 0)    \
  X(kBlack, black, 0, 0)
///   rough_diffuse: energy-preserving Oren-Nayar     glossy_conductor: anisotropic, compensated GGX
///   coated: dielectric coat over a diffuse base     principled: glTF's metallic-roughness set
///   phong, blinn_phong: as in "dirt" scenes
#define PHALANX_RICH_KINDS(X)                  \
  X(kRoughDiffuse, rough_diffuse, 1, 0)        \
  X(kGlossyConductor, glossy_conductor, 1, 0)  \
  X(kRoughDielectric, rough_dielectric, 1, 1)  \
  X(kThinDielectric, thin_dielectric, 0, 1)    \
  X(kCoated, coated, 1, 0)                     \
  X(kPrincipled, principled, 1, 1)             \
  X(kPhong, phong, 1, 0)                       \
  X(kBlinnPhong, blinn_phong, 1, 0)            \
  X(kHair, hair, 1, 1)
#define PHALANX_MATERIAL_KINDS(X) \
  PHALANX_BASIC_KINDS(X)          \
  PHALANX_RICH_KINDS(X)

enum MaterialKind {
#define PHALANX_KIND(constant, name, density, transmits) constant,
  PHALANX_MATERIAL_KINDS(PHALANX_KIND)
#undef PHALANX_KIND
  kNumMaterialKinds
};
#define kNumBasicKinds (kBlack + 1)
/// Not a surface: the kind of rays that left the scene.
#define kEscaped kNumMaterialKinds
/// Two materials: one of them is chosen before anything else happens (physics/resolve.h).
#define kBlend (kNumMaterialKinds + 1)
#define PHALANX_MAX_BLEND_DEPTH 16  // blends of blends; the scene's reader refuses more

/// What code a kernel holds. kRich adds textures, normal maps, vertex colours, every light but plain area
/// lights, blends; a scene without them runs kernels in which none of that exists.
enum Detail { kPlain = 0, kRich = 1 };

/// How the rays of a list are traced; what they hit is the same. Packets of coherent rays share a frustum.
/// Single rays are faster where most of what they meet is not Embree's own (decision 0014).
enum RayOrder { kIncoherentPackets = 0, kCoherentPackets = 1, kSingleRays = 2 };

/// Constants of a material. A texture index, -1 for none, says where a parameter comes from instead.
struct Material {
  int32 kind;              // MaterialKind, or kBlend
  Vec3 reflectance;        // diffuse: albedo. mirror, conductor: reflectance at normal incidence (F0)
                           // glossy_conductor with has_ior: average reflectance over the hemisphere
  Vec3 eta, k;             // conductor: complex index of refraction, used when has_ior is not 0
  int32 has_ior;
  float alpha;             // GGX roughness, in [1e-3, 1]; 0: smooth (rough_dielectric, coated)
  float ior;               // dielectric: inside over outside, > 0
  Vec3 emission;           // radiance leaving the surface, W sr^-1 m^-2
  int32 two_sided;         // emission: 1 emits on both sides, 0 on the side of the geometric normal

  // Only read by kRich kernels from here on.
  int32 one_sided;         // scattering: 1 absorbs on the back
  Vec3 specular;           // tint of reflection: dielectrics, coats, Phong. 1 is physical
  Vec3 transmittance;      // tint of transmission: dielectrics; hair: absorption
  float alpha_x, alpha_y;  // GGX roughness along the tangent and across; alpha is their geometric mean
  float roughness;         // rough_diffuse: sigma of Oren-Nayar in [0, 1]; hair: longitudinal
  float exponent;          // phong, blinn_phong: in [0, 1e6]
  float tilt;              // hair: sine of the angle by which its scales are tilted
  int32 compensate;        // glossy_conductor: 1 adds multiple scattering
  int32 table;             // first float of its table of directional albedos in SceneView::tables, or -1
  float metallic, transmission, specular_level, clearcoat, clearcoat_alpha, sheen_alpha;  // principled
  Vec3 sheen;
  int32 blend_a, blend_b;  // kBlend: material b with probability weight, else a
  float weight;
  float opacity;           // in [0, 1]
  float bump_scale, normal_scale;
  int32 textured;          // 1: at least one parameter of scattering comes from a texture
  int32 reflectance_texture, specular_texture, transmittance_texture, roughness_texture;
  int32 metallic_texture, transmission_texture, clearcoat_texture, sheen_texture;
  int32 emission_texture, weight_texture, opacity_texture, normal_texture, bump_texture;
};

// ---- textures ---------------------------------------------------------------------------------

enum TextureKind {
  kConstantTexture = 0,
  kImageTexture = 1,
  kCheckerTexture = 2,
  kMarbleTexture = 3,
  kNoiseTexture = 4,
  kVertexColourTexture = 5
};
enum WrapMode { kRepeat = 0, kClamp = 1, kMirrored = 2 };
enum TexelFormat { kByteTexels = 0, kFloatTexels = 1 };

/// A function of the surface's uv, or of its position (marble, noise). Images store rows from the top;
/// v = 0 is their lower edge.
struct Texture {
  int32 kind;             // TextureKind
  int32 channel;          // 0 to 3: what a parameter that is one number reads; 4: luminance
  Vec3 a, b;              // constant, image: a times the value. checker, marble, noise: the two colours
  float m00, m01, m02, m10, m11, m12;  // uv to texture coordinates
  int32 format;           // TexelFormat
  int32 first;            // first texel in byte_texels (one a texel), or float in float_texels (4 a texel)
  int32 width, height;
  int32 wrap_u, wrap_v;   // WrapMode
  int32 nearest;          // 1: no interpolation
  int32 srgb;             // bytes: 1 if sRGB-encoded
  float scale;            // marble, noise: cells per metre
  float turbulence;       // marble, noise: weight of the noise
  int32 octaves;
};

// ---- geometry ---------------------------------------------------------------------------------

enum ShapeKind { kMesh = 0, kQuads = 1, kSpheres = 2, kDisks = 3, kCurves = 4 };

/// One per Embree geometry.
struct Geometry {
  int32 shape;           // ShapeKind
  int32 material;        // index into materials
  int32 kind;            // MaterialKind of that material, or kBlend
  int32 first;           // index of primitive 0 in triangles / quads / spheres / disks / curve_segments
  int32 first_light;     // light of primitive 0, the others follow; -1 when it does not emit
  int32 normal_offset;   // meshes: normal of vertex v is vertex_normals[v + normal_offset]
  int32 has_normals;     // meshes: 1 if it has shading normals
  int32 uv_offset;       // meshes: uv of vertex v is vertex_uvs[v + uv_offset]
  int32 has_uvs;         // meshes: 1 if it has texture coordinates
  int32 colour_offset;   // meshes: colour of vertex v is vertex_colours[v + colour_offset]
  int32 has_colours;     // meshes: 1 if it has vertex colours
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

/// How an instance moves while the shutter is open, if it does: from Instance::to_world at time 0 in a
/// straight line, entry by entry, to to_world_end at time 1.
struct Motion {
  int32 moves;
  Affine to_world_end;
};

// ---- lights -----------------------------------------------------------------------------------

enum LightKind {
  kTriangleLight = 0, kQuadLight = 1, kSphereLight = 2, kDiskLight = 3,
  // Only in kRich kernels from here on. Those of no extent are found by sampling only.
  kPointLight = 4, kSpotLight = 5,
  // At infinity: last in the list of lights.
  kDirectionalLight = 6, kEnvironmentLight = 7
};

/// One per emitting primitive, in world space, and one for each light that is no surface.
///   triangle: p + u * a + v * b, u + v <= 1     quad: p + u * a + v * b
///   disk:     centre p, axes a, b               sphere: centre p, radius
///   point, spot: at p, emission is intensity, W sr^-1; spot along normal
///   directional: from direction normal; a disc of one_minus_cos, emission is radiance; if that is 0 a
///                delta, emission is irradiance, W m^-2
struct Light {
  int32 kind;        // LightKind
  int32 two_sided;
  Vec3 p, a, b;
  Vec3 normal;       // unit, geometric; unused for spheres
  float radius;      // spheres
  float area;        // > 0
  float select_pdf;  // probability that choose_light returns this light, > 0; but see light_nodes
  float error;       // bound on the rounding error of a sampled point, in metres
  Vec3 emission;     // W sr^-1 m^-2

  // Only read by kRich kernels from here on.
  int32 emission_texture, opacity_texture;  // or -1
  Vec2 uv, uv_a, uv_b;      // triangles: texture coordinates are uv + u * uv_a + v * uv_b
  Vec3 colour, colour_a, colour_b;  // triangles: vertex colours, likewise
  int32 by_solid_angle;     // quads (rectangles), triangles: sampled by the solid angle they fill
  float cos_inner, cos_outer;  // spot: full intensity within, none beyond
  int32 profile;            // point, spot: index of its IES profile, or -1
  float one_minus_cos;      // directional: of the half angle of its disc
  int32 path, path_depth;   // its way down the light tree: bit i is 1 where level i goes right
};

/// Node of the tree of lights (Conty and Kulla 2018). Children are neighbours: first, first + 1.
struct LightNode {
  Vec3 lo, hi;       // box around the lights
  Vec3 axis;         // cone of their normals
  float cos_o;       // normals within this angle of axis
  float cos_e;       // and emission within this angle of each normal
  float power;       // > 0
  int32 first;       // first child, or -1 - index of the light
};

/// Luminous intensity over angles, relative to its largest value; bilinear.
struct LightProfile {
  int32 first;                       // in SceneView::tables, row of horizontal angles after row
  int32 num_vertical, num_horizontal;  // vertical 0..180 degrees, horizontal 0..360, equally spaced
  Vec3 s, t, n;                      // frame: n points to vertical angle 0, s to horizontal angle 0
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

  // Only read by kRich kernels from here on.
  const UNI Texture *UNI textures;
  const UNI uint32 *UNI byte_texels;      // red in the lowest byte, then green, blue, alpha
  const UNI float *UNI float_texels;      // 4 a texel
  const UNI float *UNI decode;            // [512] bytes to floats: linear, then sRGB
  const UNI float *UNI vertex_uvs;        // [2 a vertex]
  const UNI float *UNI vertex_colours;    // [3 a vertex]
  const UNI float *UNI tables;            // directional albedos, light profiles
  const UNI LightProfile *UNI profiles;
  const UNI LightNode *UNI light_nodes;   // root first; num_light_nodes is 0 without a tree
  // Strands: points [4 a point] x, y, z, radius; where each lies on its strand, 0 at the root, 1 at the
  // tip; of each segment the first of its two points, which are neighbours.
  const UNI float *UNI curve_points;
  const UNI float *UNI curve_along;
  const UNI int32 *UNI curve_segments;    // [num_curve_segments]
  int32 num_curve_segments;
  const UNI Motion *UNI motions;          // [num_instances] if has_motion
  int32 has_motion;
  int32 num_textures, num_light_nodes;
  int32 num_infinite_lights;              // the last lights of the list
  float infinite_share;                   // with a tree: probability of choosing a light at infinity
  int32 has_blends, has_opacity;
  // Environment map: texels [height * width * 3] in latitude-longitude, row 0 around +y. Its distribution
  // is piecewise constant: rows [height + 1], then columns [height][width + 1], both from 0 to 1.
  const UNI float *UNI environment_texels;
  const UNI double *UNI environment_rows;
  const UNI double *UNI environment_columns;
  int32 environment_width, environment_height;  // 0: no map
  Vec3 environment_x, environment_y, environment_z;  // axes of the map's frame in the world
};

// ---- the frame --------------------------------------------------------------------------------

enum CameraKind {
  kPerspective = 0, kOrthographic = 1, kEquirectangular = 2, kFisheye = 3
};

struct Camera {
  Vec3 position;
  Vec3 right, up, forward;  // unit, orthogonal; forward points into the picture
  float tan_half_fov_y;     // > 0
  float lens_radius;        // metres; 0 is a pinhole
  float focus_distance;     // metres along forward, > 0
  int32 kind;               // CameraKind
  float half_height;        // orthographic: half the picture's height, metres
  float half_angle_turns;   // fisheye: angle at the picture's upper edge, in turns
  int32 blades;             // of the iris; 0: round
  float blade_turns;        // rotation of the iris
};

enum FilterKind { kBoxFilter = 0, kGaussianFilter = 1, kBlackmanHarrisFilter = 2 };
#define PHALANX_FILTER_CELLS 1024  // of the table that inverts a filter's distribution function
enum SamplerKind {
  kSobolSampler = 0, kIndependentSampler = 1, kStratifiedSampler = 2, kHaltonSampler = 3,
  kBlueNoiseSampler = 4
};
/// What a path computes: light, visibility of the surroundings, or a property of the first surface.
enum IntegratorKind {
  kPathIntegrator = 0, kAmbientOcclusion = 1, kViewNormal = 2, kViewAlbedo = 3, kViewUv = 4,
  kViewMaterial = 5
};

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
  int32 integrator;         // IntegratorKind
  float occlusion_distance; // ambient occlusion: how far surfaces are seen, metres
  int32 spp;                // samples per pixel that the sampler may count on
  int32 bounce_order;       // RayOrder of all closest-hit rays but the camera's
};

PHALANX_END
