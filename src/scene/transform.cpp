#include "transform.h"

#include <cmath>

namespace phalanx {
namespace {

using std::size_t;

/// Largest absolute entry of the linear part.
double largest_entry(const Transform &transform) {
  double largest = 0;
  for (const auto &row : transform.m)
    for (int column = 0; column < 3; ++column) largest = std::fmax(largest, std::fabs(row[column]));
  return largest;
}

Double3 column(const Transform &transform, int i) {
  return {transform.m[0][i], transform.m[1][i], transform.m[2][i]};
}

/// The transform with its linear part scaled to entries of at most 1, so that products neither
/// overflow nor vanish.
Transform scaled(const Transform &transform, double factor) {
  Transform result = transform;
  for (auto &row : result.m)
    for (int i = 0; i < 3; ++i) row[i] *= factor;
  return result;
}

}  // namespace

Double3 cross(const Double3 &a, const Double3 &b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Double3 &a, const Double3 &b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double length(const Double3 &a) { return std::sqrt(dot(a, a)); }

Double3 transform_vector(const Transform &transform, const Double3 &v) {
  Double3 result;
  for (size_t i = 0; i < 3; ++i) {
    const double *const row = transform.m[i];
    result[i] = row[0] * v[0] + row[1] * v[1] + row[2] * v[2];
  }
  return result;
}

Double3 transform_point(const Transform &transform, const Double3 &point) {
  Double3 result = transform_vector(transform, point);
  for (size_t i = 0; i < 3; ++i) result[i] += transform.m[i][3];
  return result;
}

Transform normal_transform(const Transform &transform) {
  const double largest = largest_entry(transform);
  const Transform unit = scaled(transform, largest > 0 ? 1.0 / largest : 1.0);
  const Double3 a = column(unit, 0), b = column(unit, 1), c = column(unit, 2);
  const Double3 columns[3] = {cross(b, c), cross(c, a), cross(a, b)};
  const double sign = dot(a, columns[0]) < 0 ? -1.0 : 1.0;
  Transform result;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) result.m[i][j] = sign * columns[j][i];
  return result;
}

Transform compose(const Transform &outer, const Transform &inner) {
  Transform result;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) {
      double sum = j == 3 ? outer.m[i][3] : 0.0;
      for (int k = 0; k < 3; ++k) sum += outer.m[i][k] * inner.m[k][j];
      result.m[i][j] = sum;
    }
  return result;
}

bool is_finite(const Transform &transform) {
  for (const auto &row : transform.m)
    for (const double entry : row)
      if (!std::isfinite(entry)) return false;
  return true;
}

bool is_identity(const Transform &transform) {
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j)
      if (transform.m[i][j] != (i == j ? 1.0 : 0.0)) return false;
  return true;
}

double relative_determinant(const Transform &transform) {
  const double largest = largest_entry(transform);
  if (!(largest > 0) || !std::isfinite(largest)) return 0;
  const Transform unit = scaled(transform, 1.0 / largest);
  const Double3 a = column(unit, 0), b = column(unit, 1), c = column(unit, 2);
  const double norm = std::sqrt(dot(a, a) + dot(b, b) + dot(c, c));
  return dot(a, cross(b, c)) / (norm * norm * norm);
}

double similarity_scale(const Transform &transform) {
  const double largest = largest_entry(transform);
  if (!(largest > 0) || !std::isfinite(largest)) return 0;
  const Transform unit = scaled(transform, 1.0 / largest);
  const Double3 axes[3] = {column(unit, 0), column(unit, 1), column(unit, 2)};
  const double square =
      (dot(axes[0], axes[0]) + dot(axes[1], axes[1]) + dot(axes[2], axes[2])) / 3.0;
  constexpr double kSlack = 1e-4;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j)
      if (!(std::fabs(dot(axes[i], axes[j]) - (i == j ? square : 0.0)) <= 2.0 * kSlack * square))
        return 0;
  return std::sqrt(square) * largest;
}

Transform inverse(const Transform &transform) {
  const double largest = largest_entry(transform);
  const Transform unit = scaled(transform, 1.0 / largest);
  const Double3 a = column(unit, 0), b = column(unit, 1), c = column(unit, 2);
  const Double3 rows[3] = {cross(b, c), cross(c, a), cross(a, b)};
  const double determinant = dot(a, rows[0]);
  Transform result;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 0; j < 3; ++j) result.m[i][j] = rows[i][j] / determinant / largest;
  const Double3 moved = transform_vector(result, column(transform, 3));
  for (size_t i = 0; i < 3; ++i) result.m[i][3] = -moved[i];
  return result;
}

Affine to_affine(const Transform &transform) {
  const auto entry = [&](int i, int j) { return static_cast<float>(transform.m[i][j]); };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(0, 3), entry(1, 0), entry(1, 1),
          entry(1, 2), entry(1, 3), entry(2, 0), entry(2, 1), entry(2, 2), entry(2, 3)};
}

}  // namespace phalanx
