// What a single JSON value may be: each function checks one kind and reports what is wrong.
//
// All return whether `out` was set; on failure it keeps its value and the problem is in `source`.
#pragma once
#include <string>
#include <vector>

#include "description.h"
#include "source.h"

namespace phalanx {

/// Which numbers a field takes, and in what unit ("metres", "" if none).
struct Range {
  double lo, hi;
  const char *unit = "";
  bool open_hi = false;  // hi itself is not allowed

  bool contains(double x) const { return x >= lo && (open_hi ? x < hi : x <= hi); }
  std::string text() const;  // "in [0, 1]", "in [0.01, 180) degrees"
};

/// Embree drops whatever lies beyond 1.844e18.
constexpr double kMaxCoordinate = 1.8e18;
/// The least length that is not mistaken for 0 in single precision.
constexpr double kMinLength = 1e-30;
/// Leaves room for sums of radiance in single precision.
constexpr double kMaxRadiance = 1e36;

constexpr Range kCoordinate = {-kMaxCoordinate, kMaxCoordinate, "metres"};
constexpr Range kLength = {kMinLength, kMaxCoordinate, "metres"};
constexpr Range kDirection = {-kMaxCoordinate, kMaxCoordinate};
constexpr Range kUnitInterval = {0, 1};
constexpr Range kRadiance = {0, kMaxRadiance, "W sr^-1 m^-2"};

/// A name with the value that it stands for.
struct Choice {
  const char *name;
  int value;
};

bool check_number(const Node &node, const Range &range, Source &source, double &out);
/// Whole numbers; 64.0 and 1e3 are whole.
bool check_integer(const Node &node, int lo, int hi, Source &source, int &out);
bool check_boolean(const Node &node, Source &source, bool &out);
/// A string of at least one byte, without NUL.
bool check_text(const Node &node, Source &source, std::string &out);
/// [x, y, z], each in `range`.
bool check_vector(const Node &node, const Range &range, Source &source, Double3 &out);
/// A grey value or [r, g, b], each in `range`.
bool check_colour(const Node &node, const Range &range, Source &source, Double3 &out);
bool check_choice(const Node &node, const std::vector<Choice> &choices, Source &source, int &out);
bool check_array(const Node &node, const std::string &of_what, Source &source);

}  // namespace phalanx
