// A scene of random primitives of every shape and material, as kernels see it, without Embree.
#pragma once
#include <vector>

#include "../../kernels/physics/any_vertex.h"
#include "random.h"
#include "textures.h"

namespace phalanx::test {

struct ToyScene {
  std::vector<Material> materials;
  std::vector<Geometry> geometries;
  std::vector<float> positions, normals;
  std::vector<Triangle> triangles;
  std::vector<Quad> quads;
  std::vector<Sphere> spheres;
  std::vector<Disk> disks;
  std::vector<Instance> instances;
  std::vector<Light> lights;
  std::vector<float> alias_threshold, filter_offsets;
  std::vector<float> tables;  // of albedos; any numbers in (0, 1)
  std::vector<int32> alias_other;
  // Two strands; no geometry refers to them.
  std::vector<float> curve_points, curve_along;
  std::vector<int32> curve_segments;
  TextureSet textures;

  /// Valid while this lives and does not change.
  SceneView view() const;
  /// 64 x 48 pixels, looking down -z from (0,0,5), thin lens, Sobol, roulette from depth 2.
  FrameView frame() const;

  int32 add_geometry(ShapeKind shape, int32 material, std::size_t first);
  /// Gives the geometry one light per primitive. Its material must emit.
  void add_lights(int32 geometry, int32 num_primitives);
};

/// Primitives of every shape with every material, four each, in a cube of half-width `size`; those
/// of emitting materials are lights; six instances: rotated, scaled, mirrored.
ToyScene random_scene(std::uint64_t seed, float size);

/// A ray that meets a primitive of the scene, and the hit it must report.
struct AimedRay {
  Vec3 origin, direction;
  Hit hit;
};
AimedRay aimed_ray(const ToyScene &scene, Random &random, float size);

}  // namespace phalanx::test
