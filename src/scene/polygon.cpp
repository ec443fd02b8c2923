#include "polygon.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace phalanx {
namespace {

using std::size_t;
using Point = std::array<double, 2>;

double cross(Point a, Point b, Point c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The polygon seen from the tip of its Newell normal, so that it turns counter-clockwise.
std::vector<Point> flatten(const std::vector<float> &positions,
                           const std::vector<std::int32_t> &corners) {
  const auto at = [&](size_t corner, int axis) {
    return static_cast<double>(positions[static_cast<size_t>(corners[corner]) * 3 + axis]);
  };
  const size_t n = corners.size();
  double normal[3] = {0, 0, 0};
  for (size_t i = 0; i < n; ++i) {
    const size_t j = (i + 1) % n;
    for (int axis = 0; axis < 3; ++axis) {
      const int u = (axis + 1) % 3, v = (axis + 2) % 3;
      // Relative to corner 0: far from the origin the products would cancel.
      normal[axis] += ((at(i, u) - at(0, u)) - (at(j, u) - at(0, u))) *
                      ((at(i, v) - at(0, v)) + (at(j, v) - at(0, v)));
    }
  }
  int axis = 0;
  for (int i = 1; i < 3; ++i)
    if (std::fabs(normal[i]) > std::fabs(normal[axis])) axis = i;
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  std::vector<Point> points(n);
  for (size_t i = 0; i < n; ++i) points[i] = {at(i, u) - at(0, u), at(i, v) - at(0, v)};
  return points;
}

/// Every corner turns left, and once around only: a pentagram turns left twice.
bool is_convex(const std::vector<Point> &points) {
  const size_t n = points.size();
  int sign_changes = 0;
  double last_dx = 0;
  for (size_t i = 0; i < n; ++i) {
    const Point a = points[i], b = points[(i + 1) % n], c = points[(i + 2) % n];
    if (cross(a, b, c) < 0) return false;
  }
  for (size_t i = 0; i <= n; ++i) {
    const double dx = points[(i + 1) % n][0] - points[i % n][0];
    if (dx == 0) continue;
    if (dx * last_dx < 0) ++sign_changes;
    last_dx = dx;
  }
  return sign_changes <= 2;
}

double squared_distance(const std::vector<float> &positions, std::int32_t a, std::int32_t b) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double d = static_cast<double>(positions[static_cast<size_t>(a) * 3 + axis]) -
                     static_cast<double>(positions[static_cast<size_t>(b) * 3 + axis]);
    sum += d * d;
  }
  return sum;
}

/// Is the triangle at `ear` free of all other corners? Corners at one of its own places are.
bool is_ear(const std::vector<Point> &points, const std::vector<std::int32_t> &left, size_t ear) {
  const size_t n = left.size();
  const size_t before = (ear + n - 1) % n, after = (ear + 1) % n;
  const Point a = points[static_cast<size_t>(left[before])];
  const Point b = points[static_cast<size_t>(left[ear])];
  const Point c = points[static_cast<size_t>(left[after])];
  if (cross(a, b, c) <= 0) return false;
  for (size_t i = 0; i < n; ++i) {
    if (i == before || i == ear || i == after) continue;
    const Point p = points[static_cast<size_t>(left[i])];
    if (p == a || p == b || p == c) continue;
    if (cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0) return false;
  }
  return true;
}

void clip_ears(const std::vector<Point> &points, std::vector<std::int32_t> &triangles) {
  std::vector<std::int32_t> left(points.size());
  for (size_t i = 0; i < left.size(); ++i) left[i] = static_cast<std::int32_t>(i);
  while (left.size() >= 3) {
    const size_t n = left.size();
    size_t ear = 0;
    while (ear < n && !is_ear(points, left, ear)) ++ear;
    if (ear == n) ear = 0;  // crosses itself or has no area: any corner will do
    triangles.insert(triangles.end(), {left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
}

}  // namespace

bool triangulate_polygon(const std::vector<float> &positions,
                         const std::vector<std::int32_t> &corners,
                         std::vector<std::int32_t> &triangles) {
  const auto n = static_cast<std::int32_t>(corners.size());
  if (n < 3) return true;
  if (n == 3) {
    triangles.insert(triangles.end(), {0, 1, 2});
    return true;
  }
  const std::vector<Point> points = flatten(positions, corners);
  const bool convex = is_convex(points);
  if (!convex && corners.size() <= kMaxClippedCorners) {
    clip_ears(points, triangles);
    return true;
  }
  if (n == 4 && squared_distance(positions, corners[1], corners[3]) <
                    squared_distance(positions, corners[0], corners[2])) {
    triangles.insert(triangles.end(), {0, 1, 3, 1, 2, 3});
    return true;
  }
  for (std::int32_t i = 1; i + 1 < n; ++i) triangles.insert(triangles.end(), {0, i, i + 1});
  return convex;
}

}  // namespace phalanx
