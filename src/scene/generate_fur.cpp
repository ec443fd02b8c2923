// Hair on a sphere.
#include <cmath>

#include "../../kernels/physics/hash.h"
#include "generate.h"
#include "transform.h"
#include "turn.h"

namespace phalanx {

namespace {

/// A stream of numbers in [0, 1).
struct Stream {
  uint32 state;
  double next() {
    state = hash32(state + 0x9e3779b9u);
    return static_cast<double>(state) * 0x1p-32;
  }
};

Double3 plus(const Double3 &a, const Double3 &b, double factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

Double3 unit(const Double3 &a) {
  const double size = length(a);
  if (!(size > 0)) return {0, 1, 0};
  return {a[0] / size, a[1] / size, a[2] / size};
}

Double3 random_direction(Stream &random) {
  const double z = 1 - 2 * random.next();
  const double ring = std::sqrt(1 - z * z);
  const auto turn = sin_cos_of_turns(random.next());
  return {ring * turn.cos, ring * turn.sin, z};
}

std::vector<std::array<double, 4>> fur_strand(const Fur &fur, Stream random) {
  const Double3 normal = random_direction(random);
  const double size = fur.length * (0.8 + 0.4 * random.next());
  const Double3 start = unit(plus(normal, random_direction(random), fur.spread));
  const Double3 down = plus({0, -1, 0}, normal, normal[1]);  // along the sphere
  const Double3 side = unit(cross(start, plus(down, {1, 0, 0}, 1e-3)));
  const Double3 other = cross(start, side);
  const double phase = random.next();

  std::vector<std::array<double, 4>> strand;
  Double3 middle = plus(fur.center, normal, fur.radius);  // of the curl
  for (int i = 0; i <= fur.segments; ++i) {
    const double part = static_cast<double>(i) / fur.segments;
    const auto turn = sin_cos_of_turns(phase + 2 * part);
    const double reach = fur.curl * size * part;
    const Double3 p = plus(plus(middle, side, reach * turn.cos), other, reach * turn.sin);
    const double thickness = fur.thickness[0] + (fur.thickness[1] - fur.thickness[0]) * part;
    strand.push_back({p[0], p[1], p[2], thickness / 2});
    const double bend = fur.bend * (part + 0.5 / fur.segments);
    const Double3 direction = unit(plus(plus({0, 0, 0}, start, 1 - bend), down, 2 * bend));
    middle = plus(middle, direction, size / fur.segments);
  }
  return strand;
}

}  // namespace

CurvesShape generate_fur(const Fur &fur) {
  CurvesShape curves;
  curves.points.reserve(static_cast<std::size_t>(fur.count) *
                        static_cast<std::size_t>(fur.segments + 1));
  for (int i = 0; i < fur.count; ++i) {
    const uint32 seed = hash32(static_cast<uint32>(i) + hash32(static_cast<uint32>(fur.seed)));
    curves.add(fur_strand(fur, {seed}));
  }
  return curves;
}

}  // namespace phalanx
