// Splits polygons into triangles.
#pragma once
#include <cstdint>
#include <vector>

namespace phalanx {

/// Polygons with more corners than this and a notch are split as fans: ear clipping takes up to
/// n^3 steps.
constexpr std::size_t kMaxClippedCorners = 1024;

/// Appends n - 2 triangles for the polygon with the given corners, as indices 0..n-1 into it, three
/// a triangle, in the polygon's own sense of rotation.
///   convex: along the shorter diagonal for four corners, else a fan from corner 0
///   not convex: ear clipping (Meisters 1975) in the plane of the polygon's Newell normal
/// positions: x, y, z per vertex; corners: vertex indices, all valid; fewer than 3: nothing.
/// Polygons that cross themselves give some triangulation. Corners without area are kept: what has
/// no area is dropped by build_scene().
/// Returns false if the polygon has a notch and more than kMaxClippedCorners corners.
bool triangulate_polygon(const std::vector<float> &positions,
                         const std::vector<std::int32_t> &corners,
                         std::vector<std::int32_t> &triangles);

}  // namespace phalanx
