// Shapes of type "curves": strands of hair, given by points on them or by the control points of B-splines.
#include "read_scene.h"

namespace phalanx {

namespace {

using Strand = std::vector<std::array<double, 4>>;  // x, y, z, radius

enum Basis { kLinear, kBSpline };

struct StrandFormat {
  Basis basis = kLinear;
  int segments = 4;  // of each span of a B-spline
  std::array<double, 2> radius = {0, 0};
};

/// `part`: place along the strand in [0, 1].
double radius_at(const StrandFormat &format, double part) {
  return format.radius[0] + (format.radius[1] - format.radius[0]) * part;
}

Strand linear_strand(const std::vector<Double3> &points, const StrandFormat &format) {
  Strand strand;
  const double last = static_cast<double>(points.size()) - 1;
  for (const Double3 &p : points) {
    const double part = static_cast<double>(strand.size()) / last;
    strand.push_back({p[0], p[1], p[2], radius_at(format, part)});
  }
  return strand;
}

/// A point of a span of the uniform cubic B-spline, t in [0, 1].
Double3 spline_point(const Double3 *p, double t) {
  const double s = 1 - t;
  const double weights[] = {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6,
                            (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6};
  Double3 sum = {0, 0, 0};
  for (std::size_t k = 0; k < 4; k++)
    for (std::size_t axis = 0; axis < 3; axis++) sum[axis] += weights[k] * p[k][axis];
  return sum;
}

/// The spline from the first control point to the last: both count three times.
Strand spline_strand(const std::vector<Double3> &control, const StrandFormat &format) {
  std::vector<Double3> points(2, control.front());
  points.insert(points.end(), control.begin(), control.end());
  points.insert(points.end(), 2, control.back());
  const std::size_t num_spans = points.size() - 3;
  const double total = static_cast<double>(num_spans) * format.segments;
  Strand strand;
  const auto add = [&](const Double3 &p) {
    const double part = static_cast<double>(strand.size()) / total;
    strand.push_back({p[0], p[1], p[2], radius_at(format, part)});
  };
  add(control.front());
  for (std::size_t span = 0; span < num_spans; span++)
    for (int i = 1; i <= format.segments; i++)
      add(spline_point(&points[span], static_cast<double>(i) / format.segments));
  return strand;
}

bool read_points(const Node &node, Source &source, std::vector<Double3> &points) {
  if (!check_array(node, "points", source)) return false;
  const std::size_t size = node.value->items().size();
  if (size < 2) {
    source.error(node, "a strand needs at least two points");
    return false;
  }
  points.resize(size);
  for (std::size_t i = 0; i < size; i++)
    if (!check_vector(node.item(i), kCoordinate, source, points[i])) return false;
  return true;
}

}  // namespace

void read_root_and_tip(const char *key, ObjectReader &object, std::array<double, 2> &out,
                       Presence presence) {
  const auto node = object.find(key, presence);
  if (!node) return;
  if (node->value->kind == JsonKind::kNumber) {
    double both = out[0];
    if (check_number(*node, kLength, object.source(), both)) out = {both, both};
    return;
  }
  if (node->value->kind != JsonKind::kArray || node->value->items().size() != 2)
    return object.source().expected(*node, "a number or [root, tip] " + kLength.text());
  for (std::size_t i = 0; i < 2; i++)
    check_number(node->item(i), kLength, object.source(), out[i]);
}

CurvesShape read_curves(ObjectReader &object) {
  StrandFormat format;
  read_root_and_tip("radius", object, format.radius, kRequired);
  int basis = kLinear;
  object.choice("basis", {{"linear", kLinear}, {"bspline", kBSpline}}, basis);
  format.basis = static_cast<Basis>(basis);
  if (format.basis == kBSpline) object.integer("segments", 1, 1000, format.segments);
  CurvesShape curves;
  for (const Node &node : object.array("strands", "strands", kRequired)) {
    std::vector<Double3> points;
    if (!read_points(node, object.source(), points)) break;  // the first only: there may be millions
    curves.add(format.basis == kLinear ? linear_strand(points, format)
                                       : spline_strand(points, format));
  }
  return curves;
}

}  // namespace phalanx
