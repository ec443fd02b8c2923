// A scene as its author wrote it: plain data, checked, with every name resolved to an index.
//
// scene_file.h fills it from JSON; build.h turns it into the arrays that kernels read. Lengths are
// metres, angles degrees, radiance W sr^-1 m^-2, colours linear RGB.
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "../../kernels/scene_view.h"

namespace phalanx {

using Double3 = std::array<double, 3>;

/// Affine map, rows of (linear | translation).
struct Transform {
  double m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

struct CameraDescription {
  Double3 position = {0, 0, 0};
  Double3 look_at = {0, 0, -1};
  Double3 up = {0, 1, 0};
  double fov = 45;              // full vertical angle, degrees, in (0, 180)
  double aperture_radius = 0;   // metres; 0 is a pinhole
  double focus_distance = 0;    // metres; 0 means |look_at - position|
};

struct FilmDescription {
  int width = 512, height = 512;
  FilterKind filter = kBlackmanHarrisFilter;
  double filter_radius = 1.5;   // pixels
  double filter_sigma = 0.5;    // pixels, Gaussian only
  std::array<int, 4> crop = {0, 0, 0, 0};  // x, y, width, height; width 0 = whole picture
  double exposure = 0;          // stops, for PNG output only
};

struct SamplerDescription {
  SamplerKind kind = kSobolSampler;
  int spp = 64;                 // samples per pixel
  int seed = 0;
};

struct IntegratorDescription {
  int max_depth = 16;           // scattering events after the camera
  int roulette_depth = 4;       // Russian roulette from this event on
};

struct MaterialDescription {
  std::string name;
  MaterialKind kind = kDiffuse;
  Double3 reflectance = {0.5, 0.5, 0.5};  // diffuse albedo, or F0
  bool has_ior = false;                   // conductor: use eta and k instead of reflectance
  Double3 eta = {1, 1, 1}, k = {0, 0, 0};
  double roughness = 0.1;                 // conductor: perceptual, alpha = roughness^2
  double ior = 1.5;                       // dielectric
  Double3 emission = {0, 0, 0};
  bool two_sided = false;                 // emission on both sides
};

// ---- shapes -----------------------------------------------------------------------------------

/// Triangles with positions and, unless empty, one normal per vertex.
struct MeshData {
  std::vector<float> positions;         // [num_vertices * 3]
  std::vector<float> normals;           // [num_vertices * 3] or empty
  std::vector<std::int32_t> indices;    // [num_triangles * 3]
};

struct MeshShape {
  MeshData data;                        // inline, or read from a file, or generated
};
/// Parallelogram. Emits and faces along edge_u x edge_v.
struct QuadShape {
  Double3 corner, edge_u, edge_v;
};
/// A set of spheres: one from the file, or many from a generator (sphere flake).
struct SpheresShape {
  std::vector<std::array<double, 4>> spheres;  // x, y, z, radius
};
struct DiskShape {
  Double3 center, normal;
  double radius = 1;
};

struct ShapeDescription {
  std::string origin;                   // for messages: "scene.json: /shapes/3"
  std::int32_t material = 0;            // index into materials
  Transform transform;
  std::variant<MeshShape, QuadShape, SpheresShape, DiskShape> shape;
};

/// Shapes that instances place.
struct GroupDescription {
  std::string name;
  std::vector<ShapeDescription> shapes;
};
struct InstanceDescription {
  std::int32_t group = 0;               // index into groups
  Transform transform;
  std::string origin;
};

struct SceneDescription {
  std::string file;
  CameraDescription camera;
  FilmDescription film;
  SamplerDescription sampler;
  IntegratorDescription integrator;
  std::vector<MaterialDescription> materials;
  std::vector<ShapeDescription> shapes;
  std::vector<GroupDescription> groups;
  std::vector<InstanceDescription> instances;
  bool has_environment = false;
  Double3 environment = {0, 0, 0};
};

}  // namespace phalanx
