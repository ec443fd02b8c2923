// The hair part of the geometry builder.
#include <algorithm>
#include <cmath>

#include "build_context.h"
#include "build_materials.h"
#include "build_report.h"

namespace phalanx {

using std::size_t;

void CurvesShape::add(const std::vector<std::array<double, 4>> &strand) {
  points.insert(points.end(), strand.begin(), strand.end());
  sizes.push_back(static_cast<std::int32_t>(strand.size()));
}

namespace {

/// Points of a whole scene: kernels address arrays with 32-bit byte offsets.
constexpr size_t kMaxPoints = INT32_MAX / 16;

/// Longer pieces, in radii, are cut: from about 300 on, rays that start on a piece hit it again by
/// rounding (22 % of them at 530, half at 1600).
constexpr double kMaxPieceRadii = 150;
constexpr int kMaxPieces = 1000;  // that one piece is cut into

/// A strand as the scene holds it. Points that coincide with the one before are left out.
struct Strand {
  std::vector<float> points;  // x, y, z, radius
  size_t size() const { return points.size() / 4; }

  /// Adds a point, and between it and the last one as many as it takes.
  void extend(const Double3 &p, double radius) {
    if (!points.empty()) {
      const float *const end = &points[points.size() - 4];
      const Double3 from = {end[0], end[1], end[2]};
      const double from_radius = end[3];
      const Double3 step = {p[0] - from[0], p[1] - from[1], p[2] - from[2]};
      // The next point, where the radius is r + dt * growth, follows at dt * length = limit * radius there.
      const double growth = std::min(radius - from_radius, 0.0);
      const double pace = kMaxPieceRadii / (length(step) - kMaxPieceRadii * growth);
      double t = 0;
      for (int i = 1; i < kMaxPieces; ++i) {
        t += std::max(pace * (from_radius + (radius - from_radius) * t), 1.0 / kMaxPieces);
        if (!(t < 1)) break;
        add({static_cast<float>(from[0] + step[0] * t), static_cast<float>(from[1] + step[1] * t),
             static_cast<float>(from[2] + step[2] * t)},
            from_radius + (radius - from_radius) * t);
      }
    }
    add(to_vec3(p), radius);
  }

  void add(Vec3 p, double radius) {
    const size_t n = points.size();
    if (n > 0 && points[n - 4] == p.x && points[n - 3] == p.y && points[n - 2] == p.z) return;
    points.insert(points.end(), {p.x, p.y, p.z, static_cast<float>(radius)});
  }
};

/// Distance from the root along the polyline, as part of its length; strictly ascending.
std::vector<float> places_along(const Strand &strand) {
  std::vector<double> along = {0};
  for (size_t i = 1; i < strand.size(); ++i) {
    const float *const a = &strand.points[4 * i - 4], *const b = &strand.points[4 * i];
    const Double3 step = {static_cast<double>(b[0]) - static_cast<double>(a[0]),
                          static_cast<double>(b[1]) - static_cast<double>(a[1]),
                          static_cast<double>(b[2]) - static_cast<double>(a[2])};
    along.push_back(along.back() + length(step));
  }
  std::vector<float> result = {0};
  for (size_t i = 1; i < along.size(); ++i) {
    const auto place = static_cast<float>(along[i] / along.back());
    result.push_back(std::max(place, std::nextafter(result.back(), 2.0f)));
  }
  return result;
}

}  // namespace

void GeometryBuilder::add_curves(const CurvesShape &shape, const Context &context) {
  const double scale = similarity_scale(context.transform);
  if (!(scale > 0))
    return error(context,
                 "curves can be moved, turned, mirrored and scaled equally in all directions only");
  if (emitted_luminance(scene_.materials[static_cast<size_t>(context.material)]) > 0)
    return error(context, "curves cannot emit: give them a material without emission");
  const size_t first = scene_.curve_segments.size();
  Bounds bounds;
  std::int64_t num_dropped = 0;
  auto point = shape.points.begin();
  for (const std::int32_t size : shape.sizes) {
    Strand strand;
    bool thick = true;
    for (std::int32_t i = 0; i < size; ++i, ++point) {
      const Double3 p = transform_point(context.transform, {(*point)[0], (*point)[1], (*point)[2]});
      const double radius = (*point)[3] * scale;
      if (!(radius > 0) || !is_valid_point({std::fabs(p[0]) + radius, std::fabs(p[1]) + radius,
                                            std::fabs(p[2]) + radius}))
        return error(context, "a point at " + point_text(p) + " has radius " +
                                  std::to_string(radius) +
                                  ": radii must be above 0, coordinates finite and at most 1.8e18");
      thick &= radius >= kMinRadius;
      if (thick) strand.extend(p, radius);
    }
    if (!thick || strand.size() < 2) {
      ++num_dropped;
      continue;
    }
    if (scene_.curve_points.size() / 4 + strand.size() > kMaxPoints)
      return error(context, "with these curves the scene has more than " +
                                std::to_string(kMaxPoints) + " points of curves");
    const auto start = static_cast<std::int32_t>(scene_.curve_points.size() / 4);
    for (size_t i = 0; i < strand.size(); ++i) {
      const float *const p = &strand.points[4 * i];
      bounds.add(Vec3{p[0] - p[3], p[1] - p[3], p[2] - p[3]});
      bounds.add(Vec3{p[0] + p[3], p[1] + p[3], p[2] + p[3]});
      if (i + 1 < strand.size())
        scene_.curve_segments.push_back(start + static_cast<std::int32_t>(i));
    }
    const std::vector<float> along = places_along(strand);
    scene_.curve_points.insert(scene_.curve_points.end(), strand.points.begin(),
                               strand.points.end());
    scene_.curve_along.insert(scene_.curve_along.end(), along.begin(), along.end());
  }
  drop(context, num_dropped, "strands without length or of radius below 1e-18");
  finish(context, kCurves, first, scene_.curve_segments.size(), bounds);
}

}  // namespace phalanx
