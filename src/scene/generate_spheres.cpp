// The icosphere, and the sphere flake made of analytic spheres.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "generate.h"

namespace phalanx {
namespace {

using std::size_t;

constexpr int kMaxSubdivisions = 9;
constexpr int kMaxFlakeLevel = 6;

Double3 unit(Double3 v) {
  const double scale = 1.0 / std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  return {v[0] * scale, v[1] * scale, v[2] * scale};
}

Double3 middle(const Double3 &a, const Double3 &b) {
  return unit({a[0] + b[0], a[1] + b[1], a[2] + b[2]});
}

// ---- icosphere --------------------------------------------------------------------------------

constexpr int kFaces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                               {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                               {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                               {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};

/// The points of an icosahedron whose edges are cut in n parts, numbered: 12 corners, n - 1 points
/// on each of 30 edges, the inner points of 20 faces. So faces share what lies on their edges.
class IcosahedronPoints {
 public:
  explicit IcosahedronPoints(int n) : n_(n) {
    int num_edges = 0;
    for (auto &row : edge_)
      for (int &edge : row) edge = -1;
    for (const auto &face : kFaces)
      for (int side = 0; side < 3; ++side) {
        const int a = std::min(face[side], face[(side + 1) % 3]);
        const int b = std::max(face[side], face[(side + 1) % 3]);
        if (edge_[a][b] < 0) edge_[a][b] = num_edges++;
      }
  }

  std::int32_t count() const { return 10 * n_ * n_ + 2; }

  /// Point i of n steps from corner 0 to corner 1 and j steps towards corner 2 of the face.
  std::int32_t index(int face, int i, int j) const {
    const int k = n_ - i - j;
    const int *const corner = kFaces[face];
    if (j == 0) return on_edge(corner[0], corner[1], i);
    if (i == 0) return on_edge(corner[0], corner[2], j);
    if (k == 0) return on_edge(corner[1], corner[2], j);
    // Row j has n - j - 1 inner points; the rows before it have those of a trapezium.
    const int before = (j - 1) * (n_ - 1) - j * (j - 1) / 2;
    return 12 + 30 * (n_ - 1) + face * ((n_ - 1) * (n_ - 2) / 2) + before + i - 1;
  }

 private:
  std::int32_t on_edge(int from, int to, int step) const {
    if (step == 0) return from;
    if (step == n_) return to;
    if (from > to) return 12 + edge_[to][from] * (n_ - 1) + (n_ - step) - 1;
    return 12 + edge_[from][to] * (n_ - 1) + step - 1;
  }

  int n_;
  int edge_[12][12];
};

std::vector<Double3> icosahedron_corners() {
  const double g = (1.0 + std::sqrt(5.0)) / 2.0;
  std::vector<Double3> corners = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                  {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                  {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  for (Double3 &corner : corners) corner = unit(corner);
  return corners;
}

/// Unit directions: each round puts the midpoints of all edges of the last one onto the sphere.
/// Points on edges are computed by both faces, to the same bits: a + b is b + a.
std::vector<Double3> icosphere_directions(const IcosahedronPoints &points, int n) {
  std::vector<Double3> directions = icosahedron_corners();
  directions.resize(static_cast<size_t>(points.count()));
  const auto at = [&](int face, int i, int j) -> Double3 & {
    return directions[static_cast<size_t>(points.index(face, i, j))];
  };
  for (int half = n / 2; half >= 1; half /= 2)
    for (int face = 0; face < 20; ++face)
      for (int j = 0; j <= n; j += half)
        for (int i = 0; i + j <= n; i += half) {
          const bool odd_i = (i / half) % 2 != 0, odd_j = (j / half) % 2 != 0;
          if (odd_i && !odd_j)
            at(face, i, j) = middle(at(face, i - half, j), at(face, i + half, j));
          if (!odd_i && odd_j)
            at(face, i, j) = middle(at(face, i, j - half), at(face, i, j + half));
          if (odd_i && odd_j)
            at(face, i, j) = middle(at(face, i - half, j + half), at(face, i + half, j - half));
        }
  return directions;
}

// ---- sphere flake -----------------------------------------------------------------------------

struct FlakeSphere {
  Double3 center;
  Double3 axis[3];  // orthonormal; the third points away from the parent
  double radius;
};

/// Nine of the twelve places around a sphere in a closest packing of equal spheres: six around the
/// equator, three above it.
std::array<Double3, 9> flake_directions() {
  const double h = std::sqrt(3.0) / 2.0;  // sin 60 degrees
  const double up = std::sqrt(2.0 / 3.0), out = std::sqrt(1.0 / 3.0);
  return {{{1, 0, 0},
           {0.5, h, 0},
           {-0.5, h, 0},
           {-1, 0, 0},
           {-0.5, -h, 0},
           {0.5, -h, 0},
           {out * h, out * 0.5, up},
           {-out * h, out * 0.5, up},
           {0, -out, up}}};
}

FlakeSphere flake_child(const FlakeSphere &parent, const Double3 &direction, double ratio) {
  FlakeSphere child;
  child.radius = parent.radius * ratio;
  Double3 &up = child.axis[2];
  for (size_t i = 0; i < 3; ++i)
    up[i] = parent.axis[0][i] * direction[0] + parent.axis[1][i] * direction[1] +
            parent.axis[2][i] * direction[2];
  up = unit(up);
  for (size_t i = 0; i < 3; ++i)
    child.center[i] = parent.center[i] + up[i] * (parent.radius + child.radius);
  // Of the parent's axes, the one least along `up` keeps its direction best.
  size_t keep = 0;
  double least = 2;
  for (size_t k = 0; k < 3; ++k) {
    const double along = std::fabs(direction[k]);
    if (along < least) least = along, keep = k;
  }
  const Double3 &old = parent.axis[keep];
  const double along = old[0] * up[0] + old[1] * up[1] + old[2] * up[2];
  child.axis[0] = unit({old[0] - along * up[0], old[1] - along * up[1], old[2] - along * up[2]});
  const Double3 &a = up, &b = child.axis[0];
  child.axis[1] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  return child;
}

}  // namespace

MeshData generate_icosphere(double radius, int subdivisions) {
  if (!(radius > 0 && radius <= 1e30) || subdivisions < 0 || subdivisions > kMaxSubdivisions)
    return {};
  const int n = 1 << subdivisions;
  const IcosahedronPoints points(n);
  const std::vector<Double3> directions = icosphere_directions(points, n);
  MeshData mesh;
  mesh.positions.reserve(directions.size() * 3);
  mesh.normals.reserve(directions.size() * 3);
  mesh.indices.reserve(static_cast<size_t>(n) * static_cast<size_t>(n) * 60);
  for (const Double3 &direction : directions)
    for (const double x : direction) {
      mesh.positions.push_back(static_cast<float>(radius * x));
      mesh.normals.push_back(static_cast<float>(x));
    }
  for (int face = 0; face < 20; ++face)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i) {
        const std::int32_t a = points.index(face, i, j), b = points.index(face, i + 1, j),
                           c = points.index(face, i, j + 1);
        mesh.indices.insert(mesh.indices.end(), {a, b, c});
        if (i + j + 1 < n)
          mesh.indices.insert(mesh.indices.end(), {b, points.index(face, i + 1, j + 1), c});
      }
  return mesh;
}

std::vector<std::array<double, 4>> generate_sphere_flake(double radius, int level, double ratio) {
  if (!(radius > 0 && radius <= 1e30) || level < 0 || level > kMaxFlakeLevel ||
      !(ratio > 0 && ratio < 1))
    return {};
  const std::array<Double3, 9> directions = flake_directions();
  std::vector<FlakeSphere> generation = {{{0, 0, 0}, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, radius}};
  std::vector<std::array<double, 4>> spheres;
  for (int i = 0;; ++i) {
    for (const FlakeSphere &s : generation)
      spheres.push_back({s.center[0], s.center[1], s.center[2], s.radius});
    if (i == level) return spheres;
    std::vector<FlakeSphere> children;
    children.reserve(generation.size() * 9);
    for (const FlakeSphere &parent : generation)
      for (const Double3 &direction : directions)
        children.push_back(flake_child(parent, direction, ratio));
    generation.swap(children);
  }
}

}  // namespace phalanx
