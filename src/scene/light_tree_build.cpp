#include "light_tree_build.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "../../kernels/physics/mathx.h"

namespace phalanx {
namespace {

using std::size_t;

constexpr double kPi = 3.14159265358979323846;
constexpr int kMaxDepth = 31;  // bits of Light::path
constexpr int kNumBins = 12;

double d(float x) { return static_cast<double>(x); }

// With the kernels' own polynomials: the same tree on every machine.
SinCos sin_cos(double radians) { return sincos_turns(static_cast<float>(radians / (2 * kPi))); }
double cosine(double radians) { return d(sin_cos(radians).cosine); }
double sine(double radians) { return d(sin_cos(radians).sine); }
double angle_between(Vec3 a, Vec3 b) {
  return 2 * kPi * d(atan2_turns(length(cross(a, b)), dot(a, b)));
}

/// What LightNode holds, with angles. Empty while power is 0.
struct LightBounds {
  Vec3 lo = {PHALANX_FAR, PHALANX_FAR, PHALANX_FAR};
  Vec3 hi = {-PHALANX_FAR, -PHALANX_FAR, -PHALANX_FAR};
  Vec3 axis = {0, 0, 1};
  double theta_o = 0, theta_e = 0;  // radians
  double power = 0;
};

void add_point(LightBounds &bounds, Vec3 p) {
  bounds.lo = {min_of(bounds.lo.x, p.x), min_of(bounds.lo.y, p.y), min_of(bounds.lo.z, p.z)};
  bounds.hi = max3(bounds.hi, p);
}

/// The box; the cone of normals (all of them for spheres, points and what shines on both sides), and how
/// far from a normal light goes.
LightBounds bounds_of(const Light &light, double power) {
  LightBounds bounds;
  bounds.power = power;
  bounds.theta_e = kPi / 2;
  bounds.theta_o = kPi;
  if (light.kind == kSphereLight) {
    const Vec3 reach = {light.radius, light.radius, light.radius};
    add_point(bounds, light.p - reach);
    add_point(bounds, light.p + reach);
    return bounds;
  }
  if (light.kind == kPointLight || light.kind == kSpotLight) {
    add_point(bounds, light.p);
    if (light.kind == kPointLight) return bounds;
    bounds.theta_o = 0;
    bounds.theta_e = d(acos_of(light.cos_outer));
    bounds.axis = light.normal;
    return bounds;
  }
  if (light.kind == kDiskLight) {
    const Vec3 a = light.a, b = light.b;
    const Vec3 reach = {square_root(a.x * a.x + b.x * b.x), square_root(a.y * a.y + b.y * b.y),
                        square_root(a.z * a.z + b.z * b.z)};
    add_point(bounds, light.p - reach);
    add_point(bounds, light.p + reach);
  } else {
    for (const Vec3 p : {light.p, light.p + light.a, light.p + light.b}) add_point(bounds, p);
    if (light.kind == kQuadLight) add_point(bounds, light.p + light.a + light.b);
  }
  bounds.axis = light.normal;
  if (light.two_sided == 0) bounds.theta_o = 0;
  return bounds;
}

/// The least cone around two. Conty Estevez and Kulla 2018, algorithm 1.
void add_cone(LightBounds &bounds, const LightBounds &other) {
  const LightBounds &wide = bounds.theta_o >= other.theta_o ? bounds : other;
  const LightBounds &narrow = bounds.theta_o >= other.theta_o ? other : bounds;
  const double theta_e = std::max(bounds.theta_e, other.theta_e);
  const double between = angle_between(wide.axis, narrow.axis);
  Vec3 axis = wide.axis;
  double theta_o = wide.theta_o;
  if (std::min(between + narrow.theta_o, kPi) > wide.theta_o) {
    theta_o = 0.5 * (wide.theta_o + between + narrow.theta_o);
    const Vec3 across = cross(wide.axis, narrow.axis);
    if (theta_o >= kPi || !(length_squared(across) > 0.0f)) {
      theta_o = kPi;
    } else {
      const double turn = theta_o - wide.theta_o;
      const Vec3 side = cross(normalize(across), wide.axis);
      const SinCos sc = sin_cos(turn);
      axis = normalize(wide.axis * sc.cosine + side * sc.sine);
    }
  }
  bounds.axis = axis;
  bounds.theta_o = theta_o;
  bounds.theta_e = theta_e;
}

void add_bounds(LightBounds &bounds, const LightBounds &other) {
  if (other.power == 0) return;
  if (bounds.power == 0) {
    bounds = other;
    return;
  }
  add_point(bounds, other.lo);
  add_point(bounds, other.hi);
  add_cone(bounds, other);
  bounds.power += other.power;
}

/// How much a node costs: power, times the solid angle into which it shines, times its size. Equation 1 of
/// Conty and Kulla; size by the box's diagonal, because lights of no extent may stand in a row.
double cost(const LightBounds &bounds) {
  if (bounds.power == 0) return 0;
  const double o = bounds.theta_o, w = std::min(o + bounds.theta_e, kPi);
  const double cone =
      2 * kPi * (1 - cosine(o)) + kPi / 2 * (2 * (w - o) * sine(o) - cosine(o - 2 * w) + cosine(o));
  const Vec3 size = bounds.hi - bounds.lo;
  return bounds.power * cone *
         (d(size.x) * d(size.x) + d(size.y) * d(size.y) + d(size.z) * d(size.z));
}

float component(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

struct Leaf {
  LightBounds bounds;
  Vec3 center;
  std::int32_t light;
};

class LightTreeBuilder {
 public:
  LightTreeBuilder(std::vector<Light> &lights, const std::vector<double> &power);
  std::vector<LightNode> build() {
    nodes_.resize(1);
    add(0, 0, leaves_.size(), 0, 0);
    return std::move(nodes_);
  }

 private:
  LightBounds add(size_t node, size_t first, size_t end, int depth, std::uint32_t path);
  size_t split(size_t first, size_t end, int depth);
  size_t split_by_cost(size_t first, size_t end);

  std::vector<Light> &lights_;
  std::vector<Leaf> leaves_;
  std::vector<LightNode> nodes_;
};

LightTreeBuilder::LightTreeBuilder(std::vector<Light> &lights, const std::vector<double> &power)
    : lights_(lights) {
  const double total = std::accumulate(power.begin(), power.end(), 0.0);
  leaves_.reserve(power.size());
  nodes_.reserve(2 * power.size());
  for (size_t i = 0; i < power.size(); ++i) {
    const LightBounds bounds = bounds_of(lights[i], power[i] / total);
    leaves_.push_back({bounds, (bounds.lo + bounds.hi) * 0.5f, static_cast<std::int32_t>(i)});
  }
}

/// Splits where the two parts cost least; returns `first` where all lights stand in one place.
size_t LightTreeBuilder::split_by_cost(size_t first, size_t end) {
  LightBounds centers;
  for (size_t i = first; i < end; ++i) add_point(centers, leaves_[i].center);
  const Vec3 size = centers.hi - centers.lo;
  const double longest = d(max_component(size));
  double least = HUGE_VAL, best_border = 0;
  int best_axis = -1;
  const auto bin_of = [&](const Leaf &leaf, int axis) {
    const double x = d(component(leaf.center, axis)) - d(component(centers.lo, axis));
    return std::min(static_cast<int>(x / d(component(size, axis)) * kNumBins), kNumBins - 1);
  };
  for (int axis = 0; axis < 3; ++axis) {
    const double extent = d(component(size, axis));
    if (!(extent > 1e-6 * longest)) continue;
    std::array<LightBounds, kNumBins> bins = {};
    for (size_t i = first; i < end; ++i)
      add_bounds(bins[static_cast<size_t>(bin_of(leaves_[i], axis))], leaves_[i].bounds);
    std::array<double, kNumBins> above = {};
    LightBounds right, left;
    for (size_t b = kNumBins - 1; b > 0; --b) {
      add_bounds(right, bins[b]);
      above[b] = cost(right);
    }
    for (size_t b = 1; b < kNumBins; ++b) {
      add_bounds(left, bins[b - 1]);
      const double both = (cost(left) + above[b]) * longest / extent;
      if (left.power == 0 || !(both < least)) continue;
      least = both;
      best_axis = axis;
      best_border = static_cast<double>(b);
    }
  }
  if (best_axis < 0) return first;
  const auto middle =
      std::partition(leaves_.begin() + static_cast<std::ptrdiff_t>(first),
                     leaves_.begin() + static_cast<std::ptrdiff_t>(end),
                     [&](const Leaf &leaf) { return bin_of(leaf, best_axis) < best_border; });
  return static_cast<size_t>(middle - leaves_.begin());
}

/// Where to divide [first, end), of two lights or more: in two halves where nothing is better, or where
/// only halves still fit into the depth that is left.
size_t LightTreeBuilder::split(size_t first, size_t end, int depth) {
  const size_t count = end - first;
  if (depth + std::bit_width(count - 1) < kMaxDepth) {
    const size_t middle = split_by_cost(first, end);
    if (middle > first && middle < end) return middle;
  }
  return first + count / 2;
}

LightBounds LightTreeBuilder::add(size_t node, size_t first, size_t end, int depth,
                                  std::uint32_t path) {
  LightBounds bounds;
  std::int32_t child = 0;
  if (end - first == 1) {
    bounds = leaves_[first].bounds;
    child = -1 - leaves_[first].light;
    Light &light = lights_[static_cast<size_t>(leaves_[first].light)];
    light.path = static_cast<std::int32_t>(path);
    light.path_depth = depth;
  } else {
    const size_t middle = split(first, end, depth), children = nodes_.size();
    child = static_cast<std::int32_t>(children);
    nodes_.resize(children + 2);
    add_bounds(bounds, add(children, first, middle, depth + 1, path));
    add_bounds(bounds, add(children + 1, middle, end, depth + 1, path | 1u << depth));
  }
  LightNode &n = nodes_[node];
  n.lo = bounds.lo;
  n.hi = bounds.hi;
  n.axis = bounds.axis;
  n.cos_o = static_cast<float>(cosine(bounds.theta_o));
  n.cos_e = static_cast<float>(cosine(bounds.theta_e));
  n.power = static_cast<float>(bounds.power);
  n.first = child;
  return bounds;
}

}  // namespace

std::vector<LightNode> build_light_tree(std::vector<Light> &lights,
                                        const std::vector<double> &power) {
  return LightTreeBuilder(lights, power).build();
}

}  // namespace phalanx
