// Generated meshes: closed, facing outwards, of the stated size, the same bits everywhere.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <unordered_map>

#include "../../src/scene/generate.h"
#include "../../src/scene/noise.h"
#include "../../src/scene/turn.h"

using namespace phalanx;

namespace {

constexpr double kPi = 3.14159265358979323846;

struct MeshFacts {
  std::int64_t num_vertices = 0, num_triangles = 0, num_edges = 0;
  std::int64_t num_open_edges = 0;  // without a partner in the other direction
  double volume = 0, area = 0;
  double smallest = 1e300, largest = 0;  // triangle areas
  double least_cosine = 1;               // between triangles and their vertices' normals
  double normal_error = 0;               // largest | |n| - 1 |
  std::int64_t euler() const { return num_vertices - num_edges + num_triangles; }
};

MeshFacts measure(const MeshData &mesh) {
  MeshFacts facts;
  facts.num_vertices = static_cast<std::int64_t>(mesh.positions.size() / 3);
  facts.num_triangles = static_cast<std::int64_t>(mesh.indices.size() / 3);
  const auto at = [](const std::vector<float> &values, std::int32_t vertex) {
    const std::size_t i = static_cast<std::size_t>(vertex) * 3;
    return Double3{values[i], values[i + 1], values[i + 2]};
  };
  std::unordered_map<std::uint64_t, std::int64_t> directed;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const std::int32_t *const v = &mesh.indices[t];
    const Double3 a = at(mesh.positions, v[0]), b = at(mesh.positions, v[1]),
                  c = at(mesh.positions, v[2]);
    Double3 e, f, n;
    for (std::size_t i = 0; i < 3; ++i) e[i] = b[i] - a[i], f[i] = c[i] - a[i];
    for (std::size_t i = 0; i < 3; ++i)
      n[i] = e[(i + 1) % 3] * f[(i + 2) % 3] - e[(i + 2) % 3] * f[(i + 1) % 3];
    const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    facts.volume += (a[0] * n[0] + a[1] * n[1] + a[2] * n[2]) / 6;
    facts.area += size / 2;
    facts.smallest = std::min(facts.smallest, size / 2);
    facts.largest = std::max(facts.largest, size / 2);
    for (int k = 0; k < 3; ++k) {
      ++directed[static_cast<std::uint64_t>(v[k]) << 32 |
                 static_cast<std::uint32_t>(v[(k + 1) % 3])];
      if (mesh.normals.empty()) continue;
      const Double3 s = at(mesh.normals, v[k]);
      facts.least_cosine =
          std::min(facts.least_cosine, (s[0] * n[0] + s[1] * n[1] + s[2] * n[2]) / size);
      facts.normal_error = std::max(
          facts.normal_error, std::fabs(std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) - 1));
    }
  }
  for (const auto &[edge, count] : directed) {
    const auto other = directed.find(edge << 32 | edge >> 32);
    if (other == directed.end() || other->second != count) ++facts.num_open_edges;
    if (other == directed.end() || edge < other->first) facts.num_edges += 1;
  }
  return facts;
}

/// FNV-1a over the bits of all numbers.
std::uint64_t fingerprint(const MeshData &mesh) {
  std::uint64_t hash = 14695981039346656037ull;
  const auto add = [&](std::uint32_t bits) {
    for (int shift = 0; shift < 32; shift += 8)
      hash = (hash ^ (bits >> shift & 255u)) * 1099511628211ull;
  };
  for (const auto *values : {&mesh.positions, &mesh.normals})
    for (const float x : *values) {
      std::uint32_t bits;
      std::memcpy(&bits, &x, 4);
      add(bits);
    }
  for (const std::int32_t i : mesh.indices) add(static_cast<std::uint32_t>(i));
  return hash;
}

void check_closed(const MeshFacts &facts) {
  CHECK(facts.num_open_edges == 0);
  CHECK(facts.volume > 0);
}

}  // namespace

TEST_CASE("displaced sphere: counts, closed, no slivers") {
  for (const int n : {1, 2, 3, 40}) {
    INFO(n);
    const MeshFacts plain = measure(generate_displaced_sphere(2, 0, 4, 5, 1, n));
    CHECK(plain.num_triangles == 12 * n * n);
    CHECK(plain.num_vertices == 6 * n * n + 2);
    CHECK(plain.euler() == 2);
    CHECK(plain.largest / plain.smallest < 1.7);
    CHECK(plain.normal_error < 1e-6);
    check_closed(plain);
  }
  CHECK(measure(generate_displaced_sphere(2, 0, 4, 5, 1, 40)).volume ==
        doctest::Approx(kPi * 32 / 3).epsilon(0.002));
  const MeshFacts bumpy = measure(generate_displaced_sphere(2, 0.2, 4, 5, 1, 60));
  check_closed(bumpy);
  CHECK(bumpy.least_cosine > 0.5);
  CHECK(bumpy.area > 16 * kPi * 1.02);
  for (const float x : generate_displaced_sphere(2, 0.2, 4, 5, 1, 60).positions)
    CHECK(std::fabs(x) < 2.21);
}

TEST_CASE("terrain: counts, facing up, one boundary") {
  const MeshFacts facts = measure(generate_terrain(10, 1, 4, 6, 7, 50));
  CHECK(facts.num_triangles == 2 * 50 * 50);
  CHECK(facts.num_vertices == 51 * 51);
  CHECK(facts.num_open_edges == 4 * 50);
  CHECK(facts.euler() == 1);
  CHECK(facts.least_cosine > 0.3);
  const MeshData mesh = generate_terrain(10, 1, 4, 6, 7, 50);
  for (std::size_t i = 0; i < mesh.normals.size(); i += 3) CHECK(mesh.normals[i + 1] > 0);
  CHECK(measure(generate_terrain(10, 0, 4, 6, 7, 3)).area == doctest::Approx(100));
}

TEST_CASE("Menger sponge: faces and volume by the formula, all edges paired") {
  double volume = 8, faces_20 = 1, faces_8 = 1;
  for (int level = 0; level <= 3; ++level) {
    const MeshFacts facts = measure(generate_menger(2, level));
    INFO(level);
    CHECK(facts.num_triangles == static_cast<std::int64_t>(2 * (2 * faces_20 + 4 * faces_8)));
    CHECK(facts.volume == doctest::Approx(volume).epsilon(1e-5));
    CHECK(facts.num_open_edges == 0);
    CHECK(facts.largest / facts.smallest < 1.0001);
    volume *= 20.0 / 27;
    faces_20 *= 20;
    faces_8 *= 8;
  }
}

TEST_CASE("torus knot: a torus in topology, of the tube's volume") {
  const MeshFacts facts = measure(generate_torus_knot(2, 3, 1, 0.1, 600, 24));
  CHECK(facts.num_triangles == 2 * 600 * 24);
  CHECK(facts.euler() == 0);
  check_closed(facts);
  CHECK(facts.least_cosine > 0.95);
  CHECK(facts.normal_error < 1e-6);
  // Length of the curve times the area of the tube.
  double length = 0;
  for (int i = 0; i < 10000; ++i) {
    const double t = 2 * kPi * i / 10000, r = 1 + 0.5 * std::cos(3 * t);
    length += 2 * kPi / 10000 * std::sqrt(4 * r * r + 9 * 0.25);
  }
  CHECK(facts.volume == doctest::Approx(length * kPi * 0.01).epsilon(0.02));
  // Common divisors do not trace the curve twice.
  CHECK(fingerprint(generate_torus_knot(4, 6, 1, 0.1, 30, 8)) ==
        fingerprint(generate_torus_knot(2, 3, 1, 0.1, 30, 8)));
  check_closed(measure(generate_torus_knot(1, 1, 1, 0.1, 3, 3)));
}

TEST_CASE("icosphere: counts, closed, on the sphere") {
  for (int n = 0; n <= 5; ++n) {
    INFO(n);
    const MeshData mesh = generate_icosphere(3, n);
    const MeshFacts facts = measure(mesh);
    CHECK(facts.num_triangles == 20ll << (2 * n));
    CHECK(facts.euler() == 2);
    CHECK(facts.largest / facts.smallest < 1.35);
    CHECK(facts.normal_error < 1e-6);
    check_closed(facts);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      CHECK(mesh.positions[i] == doctest::Approx(3 * mesh.normals[i]).epsilon(1e-5));
  }
  CHECK(measure(generate_icosphere(3, 5)).volume == doctest::Approx(36 * kPi).epsilon(0.002));
}

TEST_CASE("sphere flake: nine children a sphere, each touching its parent") {
  std::size_t expected = 0, power = 1;
  for (int level = 0; level <= 4; ++level, power *= 9) {
    expected += power;
    CHECK(generate_sphere_flake(1, level, 1.0 / 3).size() == expected);
  }
  const auto spheres = generate_sphere_flake(2, 3, 1.0 / 3);
  const auto distance = [&](std::size_t i, std::size_t j) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += (spheres[i][k] - spheres[j][k]) * (spheres[i][k] - spheres[j][k]);
    return std::sqrt(sum);
  };
  CHECK(spheres[0] == std::array<double, 4>{0, 0, 0, 2});
  for (std::size_t i = 1; i < spheres.size(); ++i) {
    const std::size_t parent = (i - 1) / 9;  // generation after generation, nine by nine
    CHECK(spheres[i][3] == doctest::Approx(spheres[parent][3] / 3));
    CHECK(distance(i, parent) == doctest::Approx(spheres[i][3] + spheres[parent][3]));
    for (std::size_t j = parent * 9 + 1; j < i; ++j)
      CHECK(distance(i, j) > spheres[i][3] + spheres[j][3]);  // siblings stay apart
  }
}

TEST_CASE("box: six sides, corners in any order") {
  const MeshFacts facts = measure(generate_box({1, 2, 3}, {-1, 5, 4}));
  CHECK(facts.num_triangles == 12);
  CHECK(facts.num_vertices == 8);
  CHECK(facts.volume == doctest::Approx(6));
  CHECK(facts.area == doctest::Approx(2 * (6 + 2 + 3)));
  check_closed(facts);
}

TEST_CASE("arguments out of range give nothing") {
  const double nan = std::nan("");
  for (const double bad : {0.0, -1.0, nan, 1e300}) {
    CHECK(generate_displaced_sphere(bad, 0, 1, 1, 0, 4).indices.empty());
    CHECK(generate_displaced_sphere(1, 0, bad, 1, 0, 4).indices.empty());
    CHECK(generate_terrain(bad, 1, 1, 1, 0, 4).indices.empty());
    CHECK(generate_menger(bad, 1).indices.empty());
    CHECK(generate_torus_knot(2, 3, bad, 1, 8, 8).indices.empty());
    CHECK(generate_torus_knot(2, 3, 1, bad, 8, 8).indices.empty());
    CHECK(generate_sphere_flake(bad, 1, 0.3).empty());
    CHECK(generate_icosphere(bad, 1).indices.empty());
  }
  for (const int bad : {0, -1, kMaxResolution + 1, INT32_MAX, INT32_MIN}) {
    CHECK(generate_displaced_sphere(1, 0, 1, 1, 0, bad).indices.empty());
    CHECK(generate_terrain(1, 1, 1, 1, 0, bad).indices.empty());
    CHECK(generate_displaced_sphere(1, 0, 1, bad, 0, 4).indices.empty());
  }
  CHECK(generate_displaced_sphere(1, 1, 1, 1, 0, 4).indices.empty());
  CHECK(generate_menger(1, 6).indices.empty());
  CHECK(generate_menger(1, -1).indices.empty());
  CHECK(generate_torus_knot(0, 3, 1, 1, 8, 8).indices.empty());
  CHECK(generate_torus_knot(2, 3, 1, 1, 2, 8).indices.empty());
  CHECK(generate_torus_knot(2, 3, 1, 1, 1 << 20, 1 << 20).indices.empty());
  CHECK(generate_sphere_flake(1, 7, 0.3).empty());
  CHECK(generate_sphere_flake(1, 1, 1.0).empty());
  CHECK(generate_icosphere(1, 10).indices.empty());
  CHECK(generate_displaced_sphere(1, 0.1, 1e30, 16, INT32_MIN, 4).indices.size() == 576);
}

// Holds for builds without FMA contraction, as the default build is.
TEST_CASE("the same bits on every machine") {
  CHECK(fingerprint(generate_displaced_sphere(1, 0.1, 4, 5, 1, 20)) == 1244699992870678286ull);
  CHECK(fingerprint(generate_terrain(10, 1, 4, 6, 2, 20)) == 12168242134291833784ull);
  CHECK(fingerprint(generate_menger(1, 2)) == 12507403880350936473ull);
  CHECK(fingerprint(generate_torus_knot(2, 3, 1, 0.25, 64, 16)) == 13666556872144102278ull);
  CHECK(fingerprint(generate_icosphere(1, 3)) == 3094278162109103377ull);
  CHECK(fingerprint(generate_displaced_sphere(1, 0.1, 4, 5, 1, 20)) !=
        fingerprint(generate_displaced_sphere(1, 0.1, 4, 5, 2, 20)));
}

TEST_CASE("noise stays in its range, is continuous, and averages to nothing") {
  double sum = 0, lowest = 0, highest = 0, largest_step = 0,
         before = gradient_noise({0, 0.3, 0.7}, 5);
  const int n = 200000;
  for (int i = 1; i <= n; ++i) {
    const double now = gradient_noise({i * 1e-3, 0.3 + i * 0.7e-3, 0.7 - i * 0.3e-3}, 5);
    largest_step = std::max(largest_step, std::fabs(now - before));
    lowest = std::min(lowest, now);
    highest = std::max(highest, now);
    sum += now;
    before = now;
  }
  CHECK(lowest > -1.04);
  CHECK(highest < 1.04);
  CHECK(lowest < -0.5);
  CHECK(highest > 0.5);
  CHECK(largest_step < 0.01);
  CHECK(std::fabs(sum / n) < 0.1);
  CHECK(gradient_noise({3, -4, 5}, 1) == 0);
  CHECK(gradient_noise({1e300, 0, 0}, 1) == 0);
  CHECK(gradient_noise({std::nan(""), 0, 0}, 1) == 0);
  CHECK(gradient_noise({-1e14 - 0.5, 0.5, 0.5}, 1) == gradient_noise({-1e14 - 0.5, 0.5, 0.5}, 1));
}

TEST_CASE("sine and cosine of turns") {
  for (int i = -4000; i <= 4000; ++i) {
    const double turns = i * 0.00123;
    const SinCos value = sin_cos_of_turns(turns);
    CHECK(std::fabs(value.sin - std::sin(2 * kPi * turns)) < 1e-14);
    CHECK(std::fabs(value.cos - std::cos(2 * kPi * turns)) < 1e-14);
  }
  for (int i = -8; i <= 8; ++i) {
    const SinCos value = sin_cos_of_turns(i * 0.25);
    CHECK(std::fabs(value.sin) + std::fabs(value.cos) == 1.0);
  }
}
