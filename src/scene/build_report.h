// How the builder says what is wrong with a shape.
#pragma once
#include <cstdio>
#include <string>

#include "../core/error.h"
#include "description.h"

namespace phalanx {

/// Largest coordinate, metres: Embree ignores primitives beyond 1.844e18 without a word.
constexpr double kMaxBuildCoordinate = 1.8e18;

/// True for what may enter the scene; false for NaN.
inline bool is_valid_coordinate(double x) {
  return x >= -kMaxBuildCoordinate && x <= kMaxBuildCoordinate;
}
inline bool is_valid_point(const Double3 &p) {
  return is_valid_coordinate(p[0]) && is_valid_coordinate(p[1]) && is_valid_coordinate(p[2]);
}

/// "(1, 2.5, nan)".
inline std::string point_text(const Double3 &p) {
  char text[128];
  std::snprintf(text, sizeof text, "(%.9g, %.9g, %.9g)", p[0], p[1], p[2]);
  return text;
}

/// A problem at an origin such as "scene.json: /shapes/3".
inline Problem problem_at(const std::string &origin, std::string message) {
  Problem problem;
  const std::size_t colon = origin.find(": /");
  problem.file = origin.substr(0, colon);
  if (colon != std::string::npos) problem.json_path = origin.substr(colon + 2);
  problem.message = std::move(message);
  return problem;
}

}  // namespace phalanx
