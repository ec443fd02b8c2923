// The built scene: the arrays that kernels read, in one owner.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "../../kernels/scene_view.h"

namespace phalanx {

/// Floats after the last vertex: Embree reads 16 bytes from the address of each.
constexpr std::size_t kPositionPadding = 4;

/// A half-open run of geometry records: those of the top level, or of one group.
struct GeometryRange {
  std::int32_t first = 0, count = 0;
};

/// Owns everything that a SceneView points at. Build with build_scene(); immutable afterwards.
struct Scene {
  std::vector<Material> materials;
  std::vector<Geometry> geometries;       // top level first, then group after group; none is empty
  std::vector<std::int32_t> num_prims;    // per geometry
  std::vector<float> positions;           // [num_vertices * 3] + 4 floats of padding for Embree
  std::vector<float> vertex_normals;      // [num_normals * 3]
  std::vector<float> vertex_uvs;          // [2 a vertex] of meshes with textures
  std::vector<float> vertex_colours;      // [3 a vertex] of meshes whose textures use them
  std::vector<Triangle> triangles;
  std::vector<Quad> quads;
  std::vector<Sphere> spheres;
  std::vector<Disk> disks;
  std::vector<float> curve_points;        // [4 a point] see SceneView; Embree wants 16-byte alignment
  std::vector<float> curve_along;
  std::vector<std::int32_t> curve_segments;
  std::vector<Instance> instances;
  std::vector<Motion> motions;            // per instance if one moves, else empty
  std::vector<std::int32_t> instance_group;  // per instance: index into groups
  std::vector<GeometryRange> groups;
  GeometryRange top_level;                // first is 0
  std::vector<Texture> textures;
  std::vector<std::uint32_t> byte_texels;  // red in the lowest byte, then green, blue, alpha
  std::vector<float> float_texels;        // 4 a texel
  std::vector<float> decode;              // [512] bytes to floats: linear, then sRGB
  std::vector<Light> lights;
  std::vector<float> alias_threshold;
  std::vector<std::int32_t> alias_other;
  std::vector<float> tables;              // directional albedos, light profiles
  std::vector<LightProfile> profiles;
  std::vector<LightNode> light_nodes;     // the tree of lights, if they are chosen by one
  std::int32_t num_infinite_lights = 0;   // the last of lights
  float infinite_share = 0;               // see SceneView
  std::vector<float> environment_texels;  // the environment map: see SceneView
  std::vector<double> environment_rows, environment_columns;
  std::int32_t environment_width = 0, environment_height = 0;
  Vec3 environment_x = {1, 0, 0}, environment_y = {0, 1, 0}, environment_z = {0, 0, 1};
  bool has_environment = false;           // rays that leave the scene bring something
  Vec3 environment = {0, 0, 0};           // the same from all directions

  // Facts gathered while building, for `info` and for warnings.
  Vec3 bounds_lo = {0, 0, 0}, bounds_hi = {0, 0, 0};  // world space; lo > hi when empty
  std::int64_t num_dropped = 0;           // degenerate primitives left out
  std::vector<std::string> notes;         // e.g. "12 zero-area triangles left out of /shapes/3"

  std::int64_t num_vertices() const;      // without the padding
  std::int64_t bytes() const;             // of all arrays
  SceneView view() const;                 // valid while this scene lives and is not changed
};

}  // namespace phalanx
