// Shapes made by a formula (generate.h): their keys, defaults and limits.
//
// Limits keep a slip of the finger from asking for more than about 50 million triangles.
#include <climits>

#include "generate.h"
#include "read_scene.h"

namespace phalanx {

namespace {

constexpr int kMaxTriangles = 50'000'000;
constexpr int kMaxSphereResolution = 2040;   // 12 n^2 triangles
constexpr int kMaxTerrainResolution = 5000;  // 2 n^2 triangles
constexpr Range kFrequency = {1e-6, 1e6, "noise cells"};

/// Fractal noise, as displaced_sphere and terrain use it.
struct Noise {
  double frequency;
  int octaves, seed = 0, resolution = 256;

  void read(ObjectReader &object, int max_resolution) {
    object.number("frequency", kFrequency, frequency);
    object.integer("octaves", 1, 16, octaves);
    object.integer("seed", 0, INT_MAX, seed);
    object.integer("resolution", 1, max_resolution, resolution);
  }
};

Generator read_displaced_sphere(ObjectReader &object) {
  double radius = 1, amplitude = 0.1;
  Noise noise = {4, 4};
  object.number("radius", kLength, radius);
  object.number("amplitude", {0, kMaxCoordinate, "metres"}, amplitude);
  noise.read(object, kMaxSphereResolution);
  if (object.ok() && amplitude >= radius)
    object.error("the amplitude must be less than the radius");
  return [=] {
    return MeshShape{generate_displaced_sphere(radius, amplitude, noise.frequency, noise.octaves,
                                               noise.seed, noise.resolution)};
  };
}

Generator read_terrain(ObjectReader &object) {
  double size = 10, height = 1;
  Noise noise = {4, 6};
  object.number("size", kLength, size);
  object.number("height", kCoordinate, height);
  noise.read(object, kMaxTerrainResolution);
  return [=] {
    return MeshShape{generate_terrain(size, height, noise.frequency, noise.octaves, noise.seed,
                                      noise.resolution)};
  };
}

Generator read_menger(ObjectReader &object) {
  double size = 2;
  int level = 3;
  object.number("size", kLength, size);
  object.integer("level", 0, 5, level);
  return [=] { return MeshShape{generate_menger(size, level)}; };
}

Generator read_torus_knot(ObjectReader &object) {
  int p = 2, q = 3, segments = 512, sides = 32;
  double radius = 1, tube_radius = 0.25;
  object.integer("p", 1, 64, p);
  object.integer("q", 1, 64, q);
  object.number("radius", kLength, radius);
  object.number("tube_radius", kLength, tube_radius);
  object.integer("segments", 3, 1'000'000, segments);
  object.integer("sides", 3, 1'000'000, sides);
  if (2.0 * segments * sides > kMaxTriangles) {
    object.error("2 x segments x sides is more than 50 million triangles");
  }
  return [=] { return MeshShape{generate_torus_knot(p, q, radius, tube_radius, segments, sides)}; };
}

Generator read_sphere_flake(ObjectReader &object) {
  double radius = 1, ratio = 1.0 / 3;
  int level = 3;
  object.number("radius", kLength, radius);
  object.integer("level", 0, 6, level);
  object.number("ratio", {0.01, 0.99}, ratio);
  return [=] { return SpheresShape{generate_sphere_flake(radius, level, ratio)}; };
}

Generator read_icosphere(ObjectReader &object) {
  double radius = 1;
  int subdivisions = 4;
  object.number("radius", kLength, radius);
  object.integer("subdivisions", 0, 9, subdivisions);
  return [=] { return MeshShape{generate_icosphere(radius, subdivisions)}; };
}

Generator read_fur(ObjectReader &object) {
  constexpr double kMaxSegments = 50e6;
  Fur fur;
  object.vector("center", kCoordinate, fur.center);
  object.number("radius", kLength, fur.radius);
  object.integer("count", 1, 10'000'000, fur.count);
  object.number("length", kLength, fur.length);
  read_root_and_tip("thickness", object, fur.thickness);
  object.number("bend", kUnitInterval, fur.bend);
  object.number("curl", kUnitInterval, fur.curl);
  object.number("spread", kUnitInterval, fur.spread);
  object.integer("segments", 1, 1000, fur.segments);
  object.integer("seed", 0, INT_MAX, fur.seed);
  if (static_cast<double>(fur.count) * fur.segments > kMaxSegments)
    object.error("count x segments is more than 50 million");
  return [=] { return generate_fur(fur); };
}

Generator read_box(ObjectReader &object) {
  Double3 lo = {-1, -1, -1}, hi = {1, 1, 1};
  object.vector("lo", kCoordinate, lo);
  object.vector("hi", kCoordinate, hi);
  for (std::size_t i = 0; i < 3; i++) {
    if (!(lo[i] < hi[i])) {
      object.error("every component of lo must be less than that of hi");
      break;
    }
  }
  return [=] { return MeshShape{generate_box(lo, hi)}; };
}

}  // namespace

const std::vector<GeneratedType> &generated_types() {
  static const std::vector<GeneratedType> types = {
      {"displaced_sphere", read_displaced_sphere},
      {"terrain", read_terrain},
      {"menger", read_menger},
      {"torus_knot", read_torus_knot},
      {"sphere_flake", read_sphere_flake},
      {"icosphere", read_icosphere},
      {"box", read_box},
      {"fur", read_fur},
  };
  return types;
}

}  // namespace phalanx
