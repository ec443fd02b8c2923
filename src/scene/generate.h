// Meshes, spheres and hair made by a formula: benches reach 10^7 triangles without a file.
//
// Every generator gives the same bits on every machine: double arithmetic of + - * / and sqrt only
// (own sine, own hash-based noise), rounded to float once. Triangles are counter-clockwise seen
// from outside, and neighbours share vertices, so closed meshes are watertight.
// Lengths are metres. Arguments outside the stated ranges give an empty result.
#pragma once
#include <array>
#include <vector>

#include "description.h"

namespace phalanx {

/// The most cells along an edge, and the most segments or sides: indices stay far from 2^31.
constexpr int kMaxResolution = 8192;

/// Sphere of `radius` whose points are moved along the radius by amplitude * noise, noise in about
/// [-1,1]: `octaves` (1..16) of gradient noise, the first with `frequency` cells per radius, each
/// next one twice as fine and half as high. A cube of resolution x resolution cells a side, blown up
/// with equal angles: no poles, undisplaced triangles differ in area by a factor of 1.7 at most.
/// Triangles: 12 * resolution^2 (300: 1.08 million, 913: 10 million). Smooth normals.
/// radius > 0, amplitude in [0, radius), frequency > 0, resolution in [1, kMaxResolution].
MeshData generate_displaced_sphere(double radius, double amplitude, double frequency, int octaves,
                                   int seed, int resolution);

/// Square of side `size` around the origin in the xz plane, y = height * noise, facing +y.
/// `frequency` noise cells along a side, octaves as above. Triangles: 2 * resolution^2.
/// Smooth normals. size > 0, height finite, frequency > 0, resolution in [1, kMaxResolution].
MeshData generate_terrain(double size, double height, double frequency, int octaves, int seed,
                          int resolution);

/// Menger sponge of side `size` around the origin, surface only, as squares of side size / 3^level,
/// two triangles each: 2 * (2 * 20^level + 4 * 8^level) triangles (level 4: 672,768, level 5:
/// 13,062,144). Flat. size > 0, level in 0..5.
MeshData generate_menger(double size, int level);

/// Tube of `tube_radius` around the (p, q) torus knot: p turns about the z axis while it winds q
/// times about a torus of radii `radius` and radius / 2, so it reaches 1.5 * radius + tube_radius
/// from the axis. p and q are divided by their common divisor first. Triangles:
/// 2 * segments * sides. Smooth normals.
/// p, q >= 1, radius > 0, tube_radius > 0, segments and sides in [3, 2^20], with
/// segments * sides at most 2^27.
MeshData generate_torus_knot(int p, int q, double radius, double tube_radius, int segments,
                             int sides);

/// Haines' sphere flake ("A Proposal for Standard Graphics Environments", IEEE CG&A 7:11, 1987):
/// a sphere at the origin with nine children, six around its equator and three above, each `ratio`
/// (1/3 in the original) times as large and touching it, and so on to `level`.
/// Returns x, y, z, radius of (9^(level+1) - 1) / 8 spheres: level 4 has 7,381, level 6 597,871.
/// radius > 0, level in 0..6, ratio in (0, 1).
std::vector<std::array<double, 4>> generate_sphere_flake(double radius, int level, double ratio);

/// Icosahedron whose triangles are split in four `subdivisions` times and put onto the sphere.
/// Triangles: 20 * 4^subdivisions (9: 5,242,880). Smooth normals. radius > 0, subdivisions in 0..9.
MeshData generate_icosphere(double radius, int subdivisions);

/// Hair on the sphere around `center`: strands that start on it, at random places, along its normal.
struct Fur {
  Double3 center = {0, 0, 0};
  double radius = 1;                           // of the sphere, > 0
  int count = 10000;                           // strands
  double length = 0.3;                         // mean of a strand; single ones differ by up to 20 %
  std::array<double, 2> thickness = {1e-3, 1e-4};  // at root and tip, > 0
  double bend = 0.5;                           // 0: straight out, 1: tips along the sphere, downwards (-y)
  double curl = 0;                             // radius of two turns at the tip, as part of the length
  double spread = 0.2;                         // random part of the directions, 0: none
  int segments = 8;                            // of a strand
  int seed = 0;
};
CurvesShape generate_fur(const Fur &fur);

/// Box between two corners (any order), 12 triangles, flat.
MeshData generate_box(Double3 lo, Double3 hi);

}  // namespace phalanx
