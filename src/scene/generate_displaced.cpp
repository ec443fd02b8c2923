// The displaced sphere and the terrain: grids moved by fractal noise.
#include <cmath>
#include <cstdint>

#include "generate.h"
#include "noise.h"
#include "smooth_normals.h"
#include "turn.h"

namespace phalanx {
namespace {

using std::size_t;

constexpr int kMaxOctaves = 16;

bool is_positive(double x) { return x > 0 && x <= 1e30; }
bool is_resolution(int resolution) { return resolution >= 1 && resolution <= kMaxResolution; }

void push_point(MeshData &mesh, Double3 p) {
  for (const double x : p) mesh.positions.push_back(static_cast<float>(x));
}

/// Two triangles for the corners a, b, c, d, counter-clockwise.
void push_cell(MeshData &mesh, std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) {
  mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
}

/// The lattice points on the surface of a cube of n cells a side, numbered: the layer z = 0 row by
/// row, the layer z = n likewise, then the rings of the layers between.
struct CubeSurface {
  int n;

  std::int32_t num_points() const { return 6 * n * n + 2; }

  std::int32_t index(int x, int y, int z) const {
    const int layer = (n + 1) * (n + 1);
    if (z == 0) return y * (n + 1) + x;
    if (z == n) return layer + y * (n + 1) + x;
    const int ring = 2 * layer + (z - 1) * 4 * n;
    if (y == 0) return ring + x;
    if (x == n) return ring + n + y;
    if (y == n) return ring + 3 * n - x;
    return ring + 4 * n - y;
  }

  /// Calls visit(x, y, z) for all points in the order of their numbers.
  template <class Visit>
  void for_each_point(const Visit &visit) const {
    for (int z = 0; z <= n; z += n)
      for (int y = 0; y <= n; ++y)
        for (int x = 0; x <= n; ++x) visit(x, y, z);
    for (int z = 1; z < n; ++z) {
      for (int i = 0; i < n; ++i) visit(i, 0, z);
      for (int i = 0; i < n; ++i) visit(n, i, z);
      for (int i = 0; i < n; ++i) visit(n - i, n, z);
      for (int i = 0; i < n; ++i) visit(0, n - i, z);
    }
  }
};

/// Coordinates of the lattice on the cube [-1,1]^3 whose steps are equal angles from the centre.
std::vector<double> equal_angle_steps(int n) {
  std::vector<double> steps;
  for (int i = 0; i <= n; ++i) {
    const SinCos angle = sin_cos_of_turns((2.0 * i - n) / (8.0 * n));
    steps.push_back(i == 0 ? -1.0 : i == n ? 1.0 : angle.sin / angle.cos);
  }
  return steps;
}

}  // namespace

MeshData generate_displaced_sphere(double radius, double amplitude, double frequency, int octaves,
                                   int seed, int resolution) {
  if (!is_positive(radius) || !(amplitude >= 0 && amplitude < radius) || !is_positive(frequency) ||
      octaves < 1 || octaves > kMaxOctaves || !is_resolution(resolution))
    return {};
  const int n = resolution;
  const CubeSurface surface{n};
  const std::vector<double> step = equal_angle_steps(n);
  MeshData mesh;
  mesh.positions.reserve(static_cast<size_t>(surface.num_points()) * 3);
  mesh.indices.reserve(static_cast<size_t>(n) * static_cast<size_t>(n) * 36);
  surface.for_each_point([&](int x, int y, int z) {
    const Double3 p = {step[static_cast<size_t>(x)], step[static_cast<size_t>(y)],
                       step[static_cast<size_t>(z)]};
    const double to_unit = 1.0 / std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    const double f = frequency * to_unit;
    const double noise = amplitude > 0 ? fractal_noise({p[0] * f, p[1] * f, p[2] * f}, octaves,
                                                       static_cast<std::uint32_t>(seed))
                                       : 0.0;
    const double r = (radius + amplitude * noise) * to_unit;
    push_point(mesh, {p[0] * r, p[1] * r, p[2] * r});
  });
  for (int v = 0; v < n; ++v)
    for (int u = 0; u < n; ++u) {
      // The sides +z, +x, +y (u, v, outward right-handed in turn), and opposite to each, reversed.
      const auto cell = [&](auto point) {
        push_cell(mesh, point(u, v), point(u + 1, v), point(u + 1, v + 1), point(u, v + 1));
      };
      cell([&](int a, int b) { return surface.index(a, b, n); });
      cell([&](int a, int b) { return surface.index(n, a, b); });
      cell([&](int a, int b) { return surface.index(b, n, a); });
      cell([&](int a, int b) { return surface.index(b, a, 0); });
      cell([&](int a, int b) { return surface.index(0, b, a); });
      cell([&](int a, int b) { return surface.index(a, 0, b); });
    }
  smooth_normals(mesh);
  return mesh;
}

MeshData generate_terrain(double size, double height, double frequency, int octaves, int seed,
                          int resolution) {
  if (!is_positive(size) || !std::isfinite(height) || !is_positive(frequency) || octaves < 1 ||
      octaves > kMaxOctaves || !is_resolution(resolution))
    return {};
  const int n = resolution;
  const size_t num_cells = static_cast<size_t>(n) * static_cast<size_t>(n);
  MeshData mesh;
  mesh.positions.reserve((num_cells + 2 * static_cast<size_t>(n) + 1) * 3);
  mesh.indices.reserve(num_cells * 6);
  for (int row = 0; row <= n; ++row)
    for (int column = 0; column <= n; ++column) {
      const double u = static_cast<double>(column) / n, v = static_cast<double>(row) / n;
      const double noise = fractal_noise({u * frequency, v * frequency, 0.0}, octaves,
                                         static_cast<std::uint32_t>(seed));
      push_point(mesh, {(u - 0.5) * size, height * noise, (v - 0.5) * size});
    }
  for (int row = 0; row < n; ++row)
    for (int column = 0; column < n; ++column) {
      const std::int32_t a = row * (n + 1) + column, b = a + n + 1;
      push_cell(mesh, a, b, b + 1, a + 1);  // x right, z towards the viewer: +y faces up
    }
  smooth_normals(mesh);
  return mesh;
}

}  // namespace phalanx
