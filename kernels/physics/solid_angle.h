// Points on rectangles and triangles, uniform in the solid angle under which these are seen.
//
// From near by, a point drawn by area is mostly one at the far end, and the few near ones carry all the
// light; a density per solid angle that is constant has no such spikes.
#pragma once
#include "mathx.h"
#include "vec.h"

PHALANX_BEGIN

/// Below this, in steradians, points are drawn by area: from afar the two are the same, and differences of
/// angles have no digits left.
#define PHALANX_MIN_SOLID_ANGLE 0.01f

// ---- rectangles -----------------------------------------------------------------------------------------

/// A rectangle [x0, x1] x [y0, y1] in a plane at `height` from the point that sees it. With the angles
/// theta(x, y) = asin(sin a sin b), tan a = x / height, tan b = y / height, its part left of x fills
/// theta(x, y1) - theta(x, y0) - left.
struct SphericalRectangle {
  float x0, x1, y0, y1, height;
  float left;         // theta(x0, y1) - theta(x0, y0), radians
  float solid_angle;  // the same at x1, less that at x0
};

PHYS float corner_angle(float x, float y, float height) {
  const float distance = square_root(x * x + y * y + height * height);
  return 2.0f * PHALANX_PI * atan2_turns(x * y, height * distance);
}

/// `corner`: from the point to a corner; edges a and b, orthogonal, n the unit normal of both.
PHYS SphericalRectangle spherical_rectangle(Vec3 corner, Vec3 a, Vec3 b, Vec3 n) {
  SphericalRectangle r;
  const float width = length(a);
  const float depth = length(b);
  r.x0 = dot(corner, a) / width;
  r.y0 = dot(corner, b) / depth;
  r.x1 = r.x0 + width;
  r.y1 = r.y0 + depth;
  r.height = abs_of(dot(corner, n));
  r.left = corner_angle(r.x0, r.y1, r.height) - corner_angle(r.x0, r.y0, r.height);
  r.solid_angle = corner_angle(r.x1, r.y1, r.height) - corner_angle(r.x1, r.y0, r.height) - r.left;
  return r;
}

/// Position on the rectangle in units of its edges. Ureña, Fajardo and King, "An Area-Preserving
/// Parametrization for Spherical Rectangles" (EGSR 2013); here sin a follows from the equation above by the
/// law of cosines, which needs none of the paper's special cases.
PHYS Vec2 sample_spherical_rectangle(SphericalRectangle r, Vec2 u) {
  const SinCos psi = sincos_turns((r.left + u.x * r.solid_angle) * 0.159154943091895f);
  const float b0 = r.y0 / square_root(r.y0 * r.y0 + r.height * r.height);
  const float b1 = r.y1 / square_root(r.y1 * r.y1 + r.height * r.height);
  const float side2 = (b0 * b0 + b1 * b1) - 2.0f * b0 * b1 * psi.cosine;
  const float sin_a = psi.sine / square_root(max_of(side2, 1.0e-14f));
  const float cos_a = square_root(max_of(1.0f - sin_a * sin_a, 1.0e-14f));
  const float x = clamp_to(r.height * sin_a / cos_a, r.x0, r.x1);
  // Along y, uniform in the sine of the elevation over the axis through x.
  const float axis2 = x * x + r.height * r.height;
  const float h0 = r.y0 / square_root(axis2 + r.y0 * r.y0);
  const float h1 = r.y1 / square_root(axis2 + r.y1 * r.y1);
  const float h = h0 + u.y * (h1 - h0);
  const float y = h * square_root(axis2 / max_of(1.0f - h * h, 1.0e-14f));
  return vec2((x - r.x0) / (r.x1 - r.x0), clamp_to((y - r.y0) / (r.y1 - r.y0), 0.0f, 1.0f));
}

// ---- triangles ------------------------------------------------------------------------------------------

/// A triangle as seen from a point. Arcs start at vertex 0 and end between 1 and 2.
struct SphericalTriangle {
  Vec3 v0, v1, v2;                     // unit, to the vertices
  float inverse0, inverse1, inverse2;  // 1 / distance of each vertex
  float d01, d02;                      // dot products of the vertices
  float plus01, plus12;                // 1 + those, also where vertices are opposite
  float volume, closeness;             // |det(v0, v1, v2)|, 1 + all three dot products
  float half_turns;                    // half the solid angle: its tangent is volume / closeness
  float solid_angle;
};

/// 1 + dot(a, b) of unit vectors, with digits left where they are nearly opposite.
PHYS float one_plus_dot(Vec3 a, Vec3 b) { return 0.5f * length_squared(a + b); }

/// `p0`: from the point to a vertex; edges a and b from there, n the unit normal of both. Van Oosterom and
/// Strackee 1983, with the volume from the height over the plane: it keeps its digits from afar.
PHYS SphericalTriangle spherical_triangle(Vec3 p0, Vec3 a, Vec3 b, Vec3 n, float area) {
  SphericalTriangle t;
  const Vec3 p1 = p0 + a;
  const Vec3 p2 = p0 + b;
  t.inverse0 = 1.0f / length(p0);
  t.inverse1 = 1.0f / length(p1);
  t.inverse2 = 1.0f / length(p2);
  t.v0 = p0 * t.inverse0;
  t.v1 = p1 * t.inverse1;
  t.v2 = p2 * t.inverse2;
  t.d01 = dot(t.v0, t.v1);
  t.d02 = dot(t.v0, t.v2);
  t.plus01 = one_plus_dot(t.v0, t.v1);
  t.plus12 = one_plus_dot(t.v1, t.v2);
  t.volume = abs_of(dot(t.v0, n)) * (2.0f * area * t.inverse1 * t.inverse2);
  t.closeness = t.plus12 + dot(t.v0, t.v1 + t.v2);
  t.half_turns = atan2_turns(t.volume, t.closeness);
  t.solid_angle = 4.0f * PHALANX_PI * t.half_turns;
  return t;
}

/// Barycentric coordinates of vertices 1 and 2. The triangle is swept by arcs (Arvo, "Stratified Sampling
/// of Spherical Triangles", SIGGRAPH 1995) whose ends are found by half vectors (Peters, "BRDF Importance
/// Sampling for Polygonal Lights", SIGGRAPH 2021); all weights are sums of positive terms here.
PHYS Vec2 sample_spherical_triangle(SphericalTriangle t, Vec2 u) {
  // q = q1 v1 + q2 v2, the end of the arc behind which lies the share u.x of the solid angle: v1 mirrored
  // at the half vector alpha v1 + beta v2. `more` is alpha - beta.
  const SinCos below = sincos_turns(u.x * t.half_turns);
  const SinCos above = sincos_turns((1.0f - u.x) * t.half_turns);
  const float radius = square_root(t.volume * t.volume + t.closeness * t.closeness);
  const float beta = t.plus01 * below.sine;
  const float more = radius * above.sine;
  const float norm = more * more + 2.0f * (more + beta) * beta * t.plus12;
  const float q1 = more * (more + 2.0f * beta) / norm;
  const float q2 = 2.0f * beta * (more + beta * t.plus12) / norm;
  // On the arc from v0 to q, uniform in the cosine: v0 sin(arc - theta) + q sin(theta). The arc's sine from
  // what is across v0: near half a turn, as just below the triangle, q does not tell where the arc goes.
  const Vec3 chord = t.v1 * q1 + t.v2 * q2 - t.v0;
  const float c = 0.5f * dot(chord, chord);  // 1 - cos of the arc
  const float sin_arc = length((t.v1 - t.v0 * t.d01) * q1 + (t.v2 - t.v0 * t.d02) * q2);
  const float h = u.y * c;  // 1 - cos theta
  const float sin_theta = safe_sqrt(h * (2.0f - h));
  // What is a weight of a direction is, over its distance, a weight of a vertex.
  const float f0 = max_of(sin_arc * (1.0f - h) - (1.0f - c) * sin_theta, 0.0f) * t.inverse0;
  const float f1 = sin_theta * q1 * t.inverse1;
  const float f2 = sin_theta * q2 * t.inverse2;
  const float scale = 1.0f / (f0 + f1 + f2);
  return vec2(f1 * scale, f2 * scale);
}

PHALANX_END
