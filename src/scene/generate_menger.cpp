// The Menger sponge and the box: axis-parallel squares.
#include <algorithm>
#include <cstdint>

#include "generate.h"

namespace phalanx {
namespace {

using std::size_t;

constexpr int kMaxMengerLevel = 5;

/// Which base-3 digits of a cell's coordinate are 1, lowest digit in bit 0.
std::vector<std::uint32_t> middle_digits(int num_cells) {
  std::vector<std::uint32_t> masks;
  for (int cell = 0; cell < num_cells; ++cell) {
    std::uint32_t mask = 0;
    for (int rest = cell, bit = 0; rest > 0; rest /= 3, ++bit)
      if (rest % 3 == 1) mask |= 1u << bit;
    masks.push_back(mask);
  }
  return masks;
}

/// A cube of cells; a cell is a hole if at any scale it is in the middle along two axes or more.
struct Sponge {
  int num_cells;
  std::vector<std::uint32_t> middle;

  bool is_solid(const std::array<int, 3> &cell) const {
    std::uint32_t m[3];
    for (size_t axis = 0; axis < 3; ++axis) {
      if (cell[axis] < 0 || cell[axis] >= num_cells) return false;
      m[axis] = middle[static_cast<size_t>(cell[axis])];
    }
    return ((m[0] & m[1]) | (m[1] & m[2]) | (m[2] & m[0])) == 0;
  }
};

/// Numbers the lattice points in the order in which they are first used.
class LatticePoints {
 public:
  LatticePoints(int num_cells, double size, MeshData &mesh)
      : stride_(static_cast<size_t>(num_cells) + 1),
        size_(size),
        index_(stride_ * stride_ * stride_, -1),
        mesh_(mesh) {}

  std::int32_t vertex(const std::array<int, 3> &p) {
    std::int32_t &index =
        index_[(static_cast<size_t>(p[2]) * stride_ + static_cast<size_t>(p[1])) * stride_ +
               static_cast<size_t>(p[0])];
    if (index < 0) {
      index = static_cast<std::int32_t>(mesh_.positions.size() / 3);
      for (const int x : p)
        mesh_.positions.push_back(static_cast<float>(
            (static_cast<double>(x) / static_cast<double>(stride_ - 1) - 0.5) * size_));
    }
    return index;
  }

 private:
  size_t stride_;
  double size_;
  std::vector<std::int32_t> index_;  // -1: not used yet
  MeshData &mesh_;
};

/// The square between `cell` and its neighbour along +axis or -axis, facing the neighbour.
void push_face(LatticePoints &points, MeshData &mesh, std::array<int, 3> cell, size_t axis,
               bool is_upper) {
  const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (is_upper) ++cell[axis];
  std::array<int, 3> b = cell, c = cell, d = cell;
  ++b[u], ++c[u], ++c[v], ++d[v];
  if (!is_upper) std::swap(b, d);
  const std::int32_t i = points.vertex(cell), j = points.vertex(b), k = points.vertex(c),
                     l = points.vertex(d);
  mesh.indices.insert(mesh.indices.end(), {i, j, k, i, k, l});
}

}  // namespace

MeshData generate_menger(double size, int level) {
  if (!(size > 0 && size <= 1e30) || level < 0 || level > kMaxMengerLevel) return {};
  int num_cells = 1;
  size_t power_20 = 1, power_8 = 1;
  for (int i = 0; i < level; ++i) num_cells *= 3, power_20 *= 20, power_8 *= 8;
  const Sponge sponge{num_cells, middle_digits(num_cells)};
  MeshData mesh;
  mesh.indices.reserve((2 * power_20 + 4 * power_8) * 6);
  LatticePoints points(num_cells, size, mesh);
  for (int z = 0; z < num_cells; ++z)
    for (int y = 0; y < num_cells; ++y)
      for (int x = 0; x < num_cells; ++x) {
        const std::array<int, 3> cell = {x, y, z};
        if (!sponge.is_solid(cell)) continue;
        for (size_t axis = 0; axis < 3; ++axis)
          for (const int side : {-1, 1}) {
            std::array<int, 3> neighbour = cell;
            neighbour[axis] += side;
            if (!sponge.is_solid(neighbour)) push_face(points, mesh, cell, axis, side > 0);
          }
      }
  return mesh;
}

MeshData generate_box(Double3 lo, Double3 hi) {
  MeshData mesh = generate_menger(1.0, 0);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const double a = lo[i % 3], b = hi[i % 3];
    mesh.positions[i] = static_cast<float>(mesh.positions[i] < 0 ? std::min(a, b) : std::max(a, b));
  }
  return mesh;
}

}  // namespace phalanx
