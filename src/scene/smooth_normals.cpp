#include "smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace phalanx {

using std::size_t;

void smooth_normals(MeshData &mesh) {
  mesh.normals.assign(mesh.positions.size(), 0.0f);
  float largest = 0;
  for (const float x : mesh.positions) largest = std::max(largest, std::fabs(x));
  if (!(largest > 0) || !(largest <= std::numeric_limits<float>::max())) return;
  // Products of lengths fit a float whatever the size of the mesh.
  const double scale = 1.0 / static_cast<double>(largest);
  const auto at = [&](size_t vertex, size_t axis) {
    return static_cast<double>(mesh.positions[vertex * 3 + axis]) * scale;
  };
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const auto a = static_cast<size_t>(mesh.indices[i]),
               b = static_cast<size_t>(mesh.indices[i + 1]),
               c = static_cast<size_t>(mesh.indices[i + 2]);
    double e[3], f[3];
    for (size_t axis = 0; axis < 3; ++axis) {
      e[axis] = at(b, axis) - at(a, axis);
      f[axis] = at(c, axis) - at(a, axis);
    }
    for (size_t axis = 0; axis < 3; ++axis) {
      const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      const auto n = static_cast<float>(e[u] * f[v] - e[v] * f[u]);
      mesh.normals[a * 3 + axis] += n;
      mesh.normals[b * 3 + axis] += n;
      mesh.normals[c * 3 + axis] += n;
    }
  }
  for (size_t i = 0; i < mesh.normals.size(); i += 3) {
    float *const n = &mesh.normals[i];
    const double x = n[0], y = n[1], z = n[2];
    const double length = std::sqrt(x * x + y * y + z * z);
    if (!(length > 0)) continue;
    n[0] = static_cast<float>(x / length);
    n[1] = static_cast<float>(y / length);
    n[2] = static_cast<float>(z / length);
  }
}

}  // namespace phalanx
