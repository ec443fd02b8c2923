// "transform": steps that move, turn and scale a shape or an instance.
#include <cmath>
#include <numbers>

#include "read_scene.h"

namespace phalanx {

namespace {

constexpr Range kEntry = {-kMaxCoordinate, kMaxCoordinate};
constexpr Range kAngle = {-1e6, 1e6, "degrees"};

/// after * before: `before` is applied first.
Transform compose(const Transform &after, const Transform &before) {
  Transform product;
  for (int row = 0; row < 3; row++) {
    for (int column = 0; column < 4; column++) {
      double sum = column == 3 ? after.m[row][3] : 0;
      for (int i = 0; i < 3; i++) sum += after.m[row][i] * before.m[i][column];
      product.m[row][column] = sum;
    }
  }
  return product;
}

bool all_finite(const Transform &transform) {
  for (const auto &row : transform.m) {
    for (const double entry : row) {
      if (!std::isfinite(entry)) return false;
    }
  }
  return true;
}

Transform translation(const Double3 &offset) {
  Transform result;
  for (std::size_t i = 0; i < 3; i++) result.m[i][3] = offset[i];
  return result;
}

Transform scaling(const Double3 &factors) {
  Transform result;
  for (std::size_t i = 0; i < 3; i++) result.m[i][i] = factors[i];
  return result;
}

/// Sine and cosine of an angle in degrees, exact for multiples of 90.
void sine_cosine(double degrees, double &sine, double &cosine) {
  const double quarter_turns = std::round(degrees / 90);
  const double rest = (degrees - quarter_turns * 90) * std::numbers::pi / 180;
  const double s = std::sin(rest), c = std::cos(rest);
  switch (static_cast<long long>(quarter_turns) & 3) {
    case 0:
      sine = s, cosine = c;
      break;
    case 1:
      sine = c, cosine = -s;
      break;
    case 2:
      sine = -s, cosine = -c;
      break;
    default:
      sine = -c, cosine = s;
      break;
  }
}

/// Right-handed rotation about `axis`, which is not zero (Rodrigues' formula).
Transform rotation(const Double3 &axis, double degrees) {
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  const double x = axis[0] / length, y = axis[1] / length, z = axis[2] / length;
  double s, c;
  sine_cosine(degrees, s, c);
  const double d = 1 - c;
  return {{{c + x * x * d, x * y * d - z * s, x * z * d + y * s, 0},
           {y * x * d + z * s, c + y * y * d, y * z * d - x * s, 0},
           {z * x * d - y * s, z * y * d + x * s, c + z * z * d, 0}}};
}

Transform read_rotation(const Node &node, Source &source) {
  ObjectReader object(node, source);
  Double3 axis = {0, 0, 1};
  double angle = 0;
  object.vector("axis", kDirection, axis, kRequired);
  object.number("angle", kAngle, angle, kRequired);
  object.finish("a rotation");
  if (std::hypot(axis[0], axis[1], axis[2]) == 0) {
    object.error("the axis is [0, 0, 0]: expected a direction");
    return {};
  }
  return rotation(axis, angle);
}

/// 16 numbers, row by row, the last row 0 0 0 1.
Transform read_matrix(const Node &node, Source &source) {
  Transform result;
  if (node.value->kind != JsonKind::kArray || node.value->items().size() != 16) {
    source.expected(node, "16 numbers, the rows of a 4 x 4 matrix");
    return result;
  }
  for (std::size_t i = 0; i < 16; i++) {
    double entry = 0;
    if (!check_number(node.item(i), kEntry, source, entry)) continue;
    if (i < 12) {
      result.m[i / 4][i % 4] = entry;
    } else if (entry != (i == 15 ? 1 : 0)) {
      source.error(node.item(i), "the last row of the matrix must be 0, 0, 0, 1, found " +
                                     describe(*node.item(i).value));
    }
  }
  return result;
}

/// One step: an object with one key that says what it does.
Transform read_step(const Node &node, Source &source) {
  ObjectReader object(node, source);
  Transform step;
  Double3 vector = {0, 0, 0};
  if (object.vector("translate", kCoordinate, vector)) step = translation(vector);
  if (object.colour("scale", kEntry, vector)) step = scaling(vector);
  if (const auto member = object.find("rotate")) step = read_rotation(*member, source);
  if (const auto member = object.find("matrix")) step = read_matrix(*member, source);
  object.finish("a transform");
  if (object.ok() && node.value->members().size() != 1) {
    source.expected(node, "one of translate, rotate, scale, matrix (put several into an array)");
  }
  return step;
}

}  // namespace

Transform read_transform(const Node &node, Source &source) {
  if (node.value->kind == JsonKind::kObject) return read_step(node, source);
  Transform transform;
  if (node.value->kind != JsonKind::kArray) {
    source.expected(node, "a transform {...} or an array of them");
    return transform;
  }
  for (std::size_t i = 0; i < node.value->items().size(); i++) {
    transform = compose(read_step(node.item(i), source), transform);
  }
  if (!all_finite(transform)) {
    source.error(node, "the steps multiply to numbers that are too large");
    return {};
  }
  return transform;
}

}  // namespace phalanx
