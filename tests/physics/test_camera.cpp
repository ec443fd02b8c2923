// Camera rays: pixels, filters, lens. STABILITY C1, C3.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../../kernels/physics/camera.h"
#include "../../src/plan/filter.h"
#include "support/random.h"
#include "support/statistics.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

/// A camera that looks in no special direction.
FrameView make_frame_view(const std::vector<float> &offsets) {
  const Frame f = make_frame(normalize(vec3(0.3f, -0.5f, 0.7f)));
  FrameView frame = {};
  frame.camera.position = {1, 2, 3};
  frame.camera.right = f.s;
  frame.camera.up = f.t;
  frame.camera.forward = f.n;
  frame.camera.tan_half_fov_y = 0.4f;
  frame.camera.focus_distance = 5;
  frame.width = 64;
  frame.height = 48;
  frame.filter_offsets = offsets.data();
  frame.sampler = kSobolSampler;
  return frame;
}

const std::vector<float> kCentre(PHALANX_FILTER_CELLS + 1, 0.0f);

double weight_of(FilterKind kind, double radius, double sigma, double x) {
  if (kind == kGaussianFilter) return std::exp(-x * x / (2 * sigma * sigma));
  if (kind == kBoxFilter) return 1;
  const double t = kPi * (x / radius + 1);  // 0 and 2 pi at the ends
  return 0.35875 - 0.48829 * std::cos(t) + 0.14128 * std::cos(2 * t) - 0.01168 * std::cos(3 * t);
}

}  // namespace

TEST_CASE("camera: filter offsets are distributed like the filter's weight") {
  for (const FilterKind kind : {kBoxFilter, kGaussianFilter, kBlackmanHarrisFilter})
    for (const double radius : {0.5, 1.5, 2.0}) {
      FilmDescription film;
      film.filter = kind;
      film.filter_radius = radius;
      const std::vector<float> offsets = filter_offsets(film);
      REQUIRE(offsets.size() == PHALANX_FILTER_CELLS + 1);
      CHECK(static_cast<double>(offsets.front()) == -radius);
      CHECK(static_cast<double>(offsets.back()) == doctest::Approx(radius).epsilon(1e-6));
      CHECK(std::is_sorted(offsets.begin(), offsets.end()));
      const FrameView frame = make_frame_view(offsets);

      const auto weight = [&](double x) { return weight_of(kind, radius, film.filter_sigma, x); };
      const double total = integrate(weight, -radius, radius, 1e-9, 14);
      const auto second = [&](double x) { return x * x * weight(x) / total; };
      const double variance = integrate(second, -radius, radius, 1e-9, 14);
      // Offsets are linear within cells of mass 1/256: tails are flat over the outermost one, which
      // moves up to 1.5e-3 of the mass and adds up to 2 % to the variance.
      Histogram histogram({32, 1, -radius, radius, 0, 1});
      Random random(3);
      Mean mean, squares;
      for (int i = 0; i < num_samples() / 4; ++i) {
        const double x = static_cast<double>(filter_offset(frame, random.unit()));
        histogram.add(x, 0.5);
        mean.add(x);
        squares.add(x * x);
      }
      CAPTURE(kind);
      CAPTURE(radius);
      CHECK(mean.p(0) > test::alpha());
      CHECK(squares.p(variance, 2e-2 * variance) > test::alpha());
      for (int bin = 0; bin < 32; ++bin) {
        const double x0 = -radius + bin * radius / 16, x1 = x0 + radius / 16;
        const double mass = integrate(weight, x0, x1, 1e-10, 10) / total;
        const double n = static_cast<double>(histogram.total());
        const double off = std::fabs(
            static_cast<double>(histogram.counts()[static_cast<std::size_t>(bin)]) / n - mass);
        CAPTURE(bin);
        CHECK(off < 1.5e-3 + 5 * std::sqrt(mass / n));
      }
      CHECK(histogram.outside() == 0);
    }
}

TEST_CASE("camera: filter offsets at the table's nodes and ends") {
  std::vector<float> offsets;
  for (int i = 0; i <= PHALANX_FILTER_CELLS; ++i)
    offsets.push_back(static_cast<float>(i * i) / (PHALANX_FILTER_CELLS * PHALANX_FILTER_CELLS) -
                      0.5f);
  const FrameView frame = make_frame_view(offsets);
  CHECK(filter_offset(frame, 0.0f) == -0.5f);
  CHECK(filter_offset(frame, 0.5f) == -0.25f);
  CHECK(filter_offset(frame, 1 - 0x1p-24f) == doctest::Approx(0.5).epsilon(1e-5));
}

TEST_CASE("camera: a pinhole ray goes through its pixel") {
  FrameView frame = make_frame_view(kCentre);
  const Camera c = frame.camera;
  for (const int x : {0, 1, 31, 32, 63})
    for (const int y : {0, 23, 24, 47}) {
      const Ray r = camera_ray(frame, x, y, pixel_scramble(x, y, 0), 5);
      CHECK(
          (r.origin.x == c.position.x && r.origin.y == c.position.y && r.origin.z == c.position.z));
      CHECK(std::fabs(length(r.direction) - 1) < 1e-6f);
      const double depth = static_cast<double>(dot(r.direction, c.forward));
      const double sx = static_cast<double>(dot(r.direction, c.right)) / depth;
      const double sy = static_cast<double>(dot(r.direction, c.up)) / depth;
      // Half the picture's height is tan(fov / 2); y grows downwards; pixels are square.
      CHECK(std::fabs(sx - (x + 0.5 - 32) / 24 * 0.4) < 1e-6);
      CHECK(std::fabs(sy - (24 - y - 0.5) / 24 * 0.4) < 1e-6);
    }
}

TEST_CASE("camera: samples of a pixel cover it and nothing else with a box filter") {
  FilmDescription film;
  film.filter = kBoxFilter;
  film.filter_radius = 0.5;
  const std::vector<float> offsets = filter_offsets(film);
  const FrameView frame = make_frame_view(offsets);
  const Camera c = frame.camera;
  Histogram histogram({16, 16, 20, 21, 30, 31});
  for (int i = 0; i < 1 << 16; ++i) {
    const Ray r = camera_ray(frame, 20, 30, pixel_scramble(20, 30, 0), i);
    const double depth = static_cast<double>(dot(r.direction, c.forward));
    histogram.add(32 + static_cast<double>(dot(r.direction, c.right)) / depth * 60,
                  24 - static_cast<double>(dot(r.direction, c.up)) / depth * 60);
  }
  CHECK(histogram.outside() == 0);
  // 2^16 points of a net: 256 in each of 16 x 16 cells, but for rounding on the way.
  for (const std::int64_t count : histogram.counts()) CHECK(std::abs(count - 256) < 32);
}

TEST_CASE("camera: all rays of one film point meet in the plane of focus") {
  FrameView frame = make_frame_view(kCentre);
  const Camera pinhole = frame.camera;
  for (const float radius : {0.01f, 0.3f, 2.0f})
    for (const float focus : {0.5f, 5.0f, 1000.0f}) {
      frame.camera.lens_radius = radius;
      frame.camera.focus_distance = focus;
      frame.camera.position = pinhole.position;
      const Vec3 right = frame.camera.right, up = frame.camera.up, forward = frame.camera.forward;
      const float scale = 0.4f / 24;
      const Vec3 aim =
          frame.camera.position +
          (forward + right * ((10.5f - 32) * scale) + up * ((24 - 40.5f) * scale)) * focus;
      Histogram lens({8, 8, 0, 1, 0, 2 * kPi});
      double worst = 0;
      for (int i = 0; i < 4096; ++i) {
        const Ray r = camera_ray(frame, 10, 40, pixel_scramble(10, 40, 1), i);
        REQUIRE(std::fabs(length(r.direction) - 1) < 1e-6f);
        const Vec3 shift = r.origin - frame.camera.position;
        REQUIRE(std::fabs(dot(shift, forward)) < 1e-6f);
        const double x = static_cast<double>(dot(shift, right) / radius);
        const double y = static_cast<double>(dot(shift, up) / radius);
        lens.add(x * x + y * y, azimuth(x, y));
        const float t = (focus - dot(shift, forward)) / dot(r.direction, forward);
        worst = std::max(worst, static_cast<double>(length(r.origin + r.direction * t - aim)));
      }
      CAPTURE(radius);
      CAPTURE(focus);
      CHECK(worst < 1e-6 * static_cast<double>(5 + 2 * focus));
      CHECK(lens.outside() == 0);
      for (const std::int64_t count : lens.counts()) CHECK(std::abs(count - 64) < 32);
    }
}

TEST_CASE("camera: a lens of radius 0 is the pinhole, bit for bit (C3)") {
  FrameView frame = make_frame_view(kCentre);
  FrameView other = frame;
  other.camera.focus_distance = 123;
  for (int i = 0; i < 100; ++i) {
    const Ray a = camera_ray(frame, i % 64, i % 48, 7, i),
              b = camera_ray(other, i % 64, i % 48, 7, i);
    CHECK((a.direction.x == b.direction.x && a.direction.y == b.direction.y &&
           a.direction.z == b.direction.z && a.origin.x == b.origin.x));
  }
}

TEST_CASE("camera: extreme fields of view give unit rays (C1)") {
  FrameView frame = make_frame_view(kCentre);
  for (const double fov : {1e-6, 1e-4, 1.0, 179.99}) {
    frame.camera.tan_half_fov_y = static_cast<float>(std::tan(fov * kPi / 360));
    for (const int y : {0, 24, 47}) {
      const Ray r = camera_ray(frame, 0, y, 1, 0);
      CAPTURE(fov);
      CHECK(all_finite(r.direction));
      CHECK(std::fabs(length(r.direction) - 1) < 1e-6f);
    }
  }
}

// ---- iris -----------------------------------------------------------------------------------------

TEST_CASE("square_to_polygon: uniform in area, corners where they should be") {
  for (const int blades : {3, 4, 5, 6, 9, 64})
    for (const double turns : {0.0, 0.13, 0.99}) {
      // Coordinates of a triangle of the polygon: which one, distance of the chord from the centre squared,
      // place along the chord. Uniform in each.
      Random random(static_cast<std::uint64_t>(blades));
      Histogram sectors({blades, 1, 0, 1, 0, 1}), within({16, 16, 0, 1, 0, 1});
      const double half = kPi / blades;
      for (int i = 0; i < num_samples() / 4; ++i) {
        const Vec2 p = square_to_polygon(random.square(), blades, static_cast<float>(turns));
        const double x = static_cast<double>(p.x), y = static_cast<double>(p.y);
        double sector = (azimuth(x, y) / (2 * kPi) - turns) * blades;
        sector -= std::floor(sector / blades) * blades;
        sectors.add(sector / blades, 0.5);
        const double angle = (sector - std::floor(sector) - 0.5) * 2 * half, r = std::hypot(x, y);
        const double depth = r * std::cos(angle) / std::cos(half);  // 1 on the edge
        within.add(depth * depth, 0.5 + 0.5 * std::tan(angle) / std::tan(half));
      }
      CAPTURE(blades);
      CAPTURE(turns);
      CHECK(sectors.outside() == 0);
      CHECK(within.outside() == 0);
      const std::vector<double> even(static_cast<std::size_t>(blades), 1.0 / blades);
      CHECK(chi_square_fit(sectors, even).p > test::alpha());
      CHECK(chi_square_fit(within, std::vector<double>(256, 1.0 / 256)).p > test::alpha());
    }
}

TEST_CASE("camera: the iris is a polygon of the lens's radius, and its rays meet in the plane of focus") {
  FrameView frame = make_frame_view(kCentre);
  frame.camera.lens_radius = 0.25f;
  frame.camera.blades = 6;
  frame.camera.blade_turns = 0.2f;
  const Camera c = frame.camera;
  const float scale = 0.4f / 24;
  const Vec3 aim = c.position + (c.forward + c.right * ((10.5f - 32) * scale) +
                                 c.up * ((24 - 40.5f) * scale)) * c.focus_distance;
  double sum = 0, widest = 0;
  const int n = 1 << 14;
  for (int i = 0; i < n; ++i) {
    const Ray r = camera_ray(frame, 10, 40, pixel_scramble(10, 40, 1), i);
    const Vec3 shift = r.origin - c.position;
    const double x = static_cast<double>(dot(shift, c.right)) / 0.25;
    const double y = static_cast<double>(dot(shift, c.up)) / 0.25;
    sum += x * x + y * y;
    widest = std::max(widest, std::hypot(x, y));
    const float t = (c.focus_distance - dot(shift, c.forward)) / dot(r.direction, c.forward);
    REQUIRE(static_cast<double>(length(r.origin + r.direction * t - aim)) < 1e-5);
    REQUIRE(r.weight == 1.0f);
  }
  // Mean squared radius of a regular polygon of circumradius 1: (2 + cos(2 pi / n)) / 6.
  CHECK(std::fabs(sum / n - (2 + std::cos(2 * kPi / 6)) / 6) < 1e-3);
  CHECK(widest <= 1 + 1e-5);
  CHECK(widest > 0.99);
}

// ---- cameras without perspective --------------------------------------------------------------------

namespace {

/// Components of a vector along the camera's axes.
struct Local {
  double right, up, forward;
};
Local to_camera(const Camera &c, Vec3 v) {
  return {static_cast<double>(dot(v, c.right)), static_cast<double>(dot(v, c.up)),
          static_cast<double>(dot(v, c.forward))};
}
double distance(Local a, Local b) {
  return std::hypot(a.right - b.right, a.up - b.up, a.forward - b.forward);
}

FrameView wide_view(CameraKind kind) {
  FrameView frame = make_frame_view(kCentre);
  frame.camera.kind = kind;
  frame.camera.half_height = 3;
  frame.camera.half_angle_turns = 0.25f;
  return frame;
}

Ray centre_ray(const FrameView &frame, int x, int y) { return camera_ray(frame, x, y, 1, 0); }

}  // namespace

TEST_CASE("orthographic: parallel rays, pixels of equal size") {
  const FrameView frame = wide_view(kOrthographic);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const Ray r = centre_ray(frame, x, y);
      const Local from = to_camera(frame.camera, r.origin - frame.camera.position);
      REQUIRE(distance(from, {(x + 0.5 - 32) / 8, (24 - y - 0.5) / 8, 0}) < 2e-6);
      REQUIRE(length(r.direction - frame.camera.forward) == 0.0f);
      REQUIRE(r.weight == 1.0f);
    }
}

TEST_CASE("equirectangular: longitude and latitude grow evenly, the whole sphere once") {
  const FrameView frame = wide_view(kEquirectangular);
  double solid_angle = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const Ray r = centre_ray(frame, x, y);
      const double longitude = ((x + 0.5) / 64 - 0.5) * 2 * kPi;
      const double latitude = (0.5 - (y + 0.5) / 48) * kPi;
      const Local wanted = {std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                            std::cos(latitude) * std::cos(longitude)};
      REQUIRE(distance(to_camera(frame.camera, r.direction), wanted) < 1e-6);
      REQUIRE(std::fabs(length(r.direction) - 1) < 1e-6f);
      REQUIRE(length(r.origin - frame.camera.position) == 0.0f);
      solid_angle += std::cos(latitude) * (2 * kPi / 64) * (kPi / 48);
    }
  CHECK(solid_angle == doctest::Approx(4 * kPi).epsilon(1e-3));
}

TEST_CASE("equirectangular: filters reach round the seam and over the poles") {
  // Every sample three pixels off: pixel (x, y) sees what pixel (x + 3, y + 3) sees without.
  const std::vector<float> three(PHALANX_FILTER_CELLS + 1, 3.0f);
  FrameView frame = wide_view(kEquirectangular), off = frame;
  off.filter_offsets = three.data();
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      int to_x = x + 3, to_y = y + 3;
      if (to_y >= 48) to_y = 95 - to_y, to_x += 32;  // the other side of the pole
      const Ray r = centre_ray(off, x, y), expected = centre_ray(frame, to_x % 64, to_y);
      REQUIRE(length(r.direction - expected.direction) < 1e-6f);
    }
  // However small the picture and wide the filter.
  frame.width = 1;
  frame.height = 1;
  for (const float offset : {-16.0f, -3.7f, 0.0f, 5.2f, 16.0f}) {
    const std::vector<float> wide(PHALANX_FILTER_CELLS + 1, offset);
    frame.filter_offsets = wide.data();
    CHECK(std::fabs(length(centre_ray(frame, 0, 0).direction) - 1) < 1e-6f);
  }
}

TEST_CASE("fisheye: angles grow with the distance from the centre; nothing is seen outside the disc") {
  for (const double angle : {10.0, 90.0, 180.0, 250.0, 360.0}) {
    FrameView frame = wide_view(kFisheye);
    frame.camera.half_angle_turns = static_cast<float>(angle / 720);
    int seen = 0;
    for (int y = 0; y < 48; ++y)
      for (int x = 0; x < 64; ++x) {
        const Ray r = centre_ray(frame, x, y);
        const double right = (x + 0.5 - 32) / 24, up = (24 - y - 0.5) / 24;
        const double radius = std::hypot(right, up), theta = radius * angle * kPi / 360;
        REQUIRE(std::fabs(length(r.direction) - 1) < 1e-6f);
        if (radius > 1) {
          REQUIRE(r.weight == 0.0f);
          REQUIRE(all_finite(r.origin));
          REQUIRE(dot(r.origin, r.direction) > 1e17f);  // far away, and on its way further
          continue;
        }
        ++seen;
        REQUIRE(r.weight == 1.0f);
        const Local wanted = {std::sin(theta) * right / radius, std::sin(theta) * up / radius,
                              std::cos(theta)};
        REQUIRE(distance(to_camera(frame.camera, r.direction), wanted) < 1e-6);
        REQUIRE(length(r.origin - frame.camera.position) == 0.0f);
      }
    CHECK(seen == doctest::Approx(kPi * 24 * 24).epsilon(0.01));
  }
  FrameView middle = wide_view(kFisheye);
  middle.width = 63;
  middle.height = 47;
  CHECK(length(centre_ray(middle, 31, 23).direction - middle.camera.forward) == 0.0f);
}
