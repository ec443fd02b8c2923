// Matrices and curves.
#include "flip_color.h"

#include <cmath>

namespace phalanx {
namespace {

// Linear sRGB to CIE XYZ, and the XYZ of white (IEC 61966-2-1, more digits).
Vec3 xyz_from_linear(Vec3 c) {
  return vec3(0.41239080f * c.x + 0.35758434f * c.y + 0.18048079f * c.z,
              0.21263901f * c.x + 0.71516868f * c.y + 0.07219232f * c.z,
              0.01933082f * c.x + 0.11919478f * c.y + 0.95053215f * c.z);
}
Vec3 linear_from_xyz(Vec3 c) {
  return vec3(3.24096994f * c.x - 1.53738318f * c.y - 0.49861076f * c.z,
              -0.96924364f * c.x + 1.87596750f * c.y + 0.04155506f * c.z,
              0.05563008f * c.x - 0.20397696f * c.y + 1.05697151f * c.z);
}
const Vec3 kWhite = vec3(0.95045593f, 1.0f, 1.08905775f);

Vec3 relative_to_white(Vec3 xyz) {
  return vec3(xyz.x / kWhite.x, xyz.y / kWhite.y, xyz.z / kWhite.z);
}

float lab_curve(float t) {
  constexpr float delta = 6.0f / 29.0f;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0f / 29.0f;
}

// (k0 x^2 + k1 x) / (k3 x^2 + k4 x + k5)
constexpr double k0 = 0.6 * 0.6 * 2.51, k1 = 0.6 * 0.03;
constexpr double k3 = 0.6 * 0.6 * 2.43, k4 = 0.6 * 0.59, k5 = 0.14;

float aces_curve(float x) {
  const double v = std::fmax(x, 0.0f);
  if (std::isinf(v)) return 1;
  return static_cast<float>(std::fmin((k0 * v * v + k1 * v) / (k3 * v * v + k4 * v + k5), 1.0));
}

}  // namespace

Vec3 ycxcz_from_linear(Vec3 rgb) {
  const Vec3 c = relative_to_white(xyz_from_linear(rgb));
  return vec3(116 * c.y - 16, 500 * (c.x - c.y), 200 * (c.y - c.z));
}

Vec3 linear_from_ycxcz(Vec3 ycxcz) {
  const float y = (ycxcz.x + 16) / 116;
  const float x = y + ycxcz.y / 500, z = y - ycxcz.z / 200;
  return linear_from_xyz(vec3(x * kWhite.x, y * kWhite.y, z * kWhite.z));
}

Vec3 hunt_lab_from_linear(Vec3 rgb) {
  const Vec3 c = relative_to_white(xyz_from_linear(rgb));
  const float fx = lab_curve(c.x), fy = lab_curve(c.y), fz = lab_curve(c.z);
  const float lightness = 116 * fy - 16;
  const float hunt = 0.01f * lightness;
  return vec3(lightness, hunt * 500 * (fx - fy), hunt * 200 * (fy - fz));
}

float hyab(Vec3 a, Vec3 b) { return std::fabs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

Vec3 aces_tone_map(Vec3 rgb) {
  return vec3(aces_curve(rgb.x), aces_curve(rgb.y), aces_curve(rgb.z));
}

double aces_inverse(double t) {
  const double a = t * k3 - k0, b = t * k4 - k1, c = t * k5;
  const double middle = -b / (2 * a);
  return middle + std::sqrt(middle * middle - c / a);
}

}  // namespace phalanx
