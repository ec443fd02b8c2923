// Torus knots: a tube around a curve that winds about a torus.
#include <cmath>
#include <cstdint>
#include <numeric>

#include "generate.h"
#include "turn.h"

namespace phalanx {
namespace {

using std::size_t;

/// A point of the curve with two unit vectors across it.
struct KnotFrame {
  Double3 point, normal, binormal;
};

/// t in turns. The normal of the torus itself is always across the curve and never turns around
/// suddenly, unlike the curve's own normal.
KnotFrame knot_frame(int p, int q, double radius, double t) {
  const SinCos around = sin_cos_of_turns(p * t), winding = sin_cos_of_turns(q * t);
  const double minor = radius / 2;
  const double distance = radius + minor * winding.cos;
  const Double3 tangent = {
      -p * distance * around.sin - q * minor * winding.sin * around.cos,
      p * distance * around.cos - q * minor * winding.sin * around.sin,
      q * minor * winding.cos,
  };
  KnotFrame frame;
  frame.point = {distance * around.cos, distance * around.sin, minor * winding.sin};
  frame.normal = {winding.cos * around.cos, winding.cos * around.sin, winding.sin};
  const Double3 &n = frame.normal;
  const double speed =
      std::sqrt(tangent[0] * tangent[0] + tangent[1] * tangent[1] + tangent[2] * tangent[2]);
  for (size_t i = 0; i < 3; ++i) {
    const size_t u = (i + 1) % 3, v = (i + 2) % 3;
    frame.binormal[i] = (n[u] * tangent[v] - n[v] * tangent[u]) / speed;
  }
  return frame;
}

bool is_count(int n) { return n >= 3 && n <= (1 << 20); }

}  // namespace

MeshData generate_torus_knot(int p, int q, double radius, double tube_radius, int segments,
                             int sides) {
  if (p < 1 || q < 1 || !(radius > 0 && radius <= 1e30) ||
      !(tube_radius > 0 && tube_radius <= 1e30) || !is_count(segments) || !is_count(sides) ||
      static_cast<std::int64_t>(segments) * sides > (1 << 27))
    return {};
  const int divisor = std::gcd(p, q);
  p /= divisor;
  q /= divisor;
  const size_t num_vertices = static_cast<size_t>(segments) * static_cast<size_t>(sides);
  MeshData mesh;
  mesh.positions.reserve(num_vertices * 3);
  mesh.normals.reserve(num_vertices * 3);
  mesh.indices.reserve(num_vertices * 6);
  std::vector<SinCos> circle;
  for (int j = 0; j < sides; ++j)
    circle.push_back(sin_cos_of_turns(static_cast<double>(j) / sides));
  for (int i = 0; i < segments; ++i) {
    const KnotFrame frame = knot_frame(p, q, radius, static_cast<double>(i) / segments);
    for (const SinCos &side : circle)
      for (size_t axis = 0; axis < 3; ++axis) {
        const double n = side.cos * frame.normal[axis] + side.sin * frame.binormal[axis];
        mesh.normals.push_back(static_cast<float>(n));
        mesh.positions.push_back(static_cast<float>(frame.point[axis] + tube_radius * n));
      }
  }
  for (int i = 0; i < segments; ++i)
    for (int j = 0; j < sides; ++j) {
      const std::int32_t ring = i * sides, next = (i + 1) % segments * sides, k = (j + 1) % sides;
      const std::int32_t a = ring + j, b = next + j, c = next + k, d = ring + k;
      mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
    }
  return mesh;
}

}  // namespace phalanx
