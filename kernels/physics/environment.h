// The environment map: radiance from all directions as a picture in latitude and longitude.
//
// Row 0 surrounds +y of the map's frame, the middle of a row looks along -z, columns run towards +x: a
// picture of the equirectangular camera is a map. Radiance is bilinear between the middles of texels;
// directions are drawn uniformly within a texel's exact solid angle, so the poles are nothing special.
#pragma once
#include "../scene_view.h"
#include "mathx.h"

PHALANX_BEGIN

/// Where a direction of the map's frame lies: u, v in [0, 1], v = 0 at +y.
PHYS Vec2 environment_uv(Vec3 w) {
  return vec2(0.5f + atan2_turns(w.x, -w.z),
              2.0f * atan2_turns(square_root(w.x * w.x + w.z * w.z), w.y));
}

/// The map's frame; unit directions in both.
PHYS Frame environment_frame(const UNI SceneView &scene) {
  Frame f;
  f.s = scene.environment_x;
  f.t = scene.environment_y;
  f.n = scene.environment_z;
  return f;
}

/// Columns -1 and width are their neighbours around the sphere; rows beyond a pole are the last ones.
PHYS Vec3 environment_texel(const UNI SceneView &scene, int32 column, int32 row) {
  const int32 last = scene.environment_width - 1;
  const int32 x = column < 0 ? last : (column > last ? 0 : column);
  const int32 y =
      row < 0 ? 0 : (row < scene.environment_height ? row : scene.environment_height - 1);
  const int32 at = 3 * (y * scene.environment_width + x);
  return vec3(scene.environment_texels[at], scene.environment_texels[at + 1],
              scene.environment_texels[at + 2]);
}

PHYS Vec3 environment_radiance(const UNI SceneView &scene, Vec2 uv) {
  const float x = uv.x * to_float(scene.environment_width) - 0.5f;
  const float y = uv.y * to_float(scene.environment_height) - 0.5f;
  const float left = round_down(x);
  const float above = round_down(y);
  const int32 i = to_int(left);
  const int32 j = to_int(above);
  const float fx = x - left;
  const float fy = y - above;
  const Vec3 upper =
      environment_texel(scene, i, j) * (1.0f - fx) + environment_texel(scene, i + 1, j) * fx;
  const Vec3 lower = environment_texel(scene, i, j + 1) * (1.0f - fx) +
                     environment_texel(scene, i + 1, j + 1) * fx;
  return upper * (1.0f - fy) + lower * fy;
}

/// Solid angle of each texel of a row: 2 pi / width (cos upper edge - cos lower edge).
PHYS float texel_solid_angle(const UNI SceneView &scene, int32 row) {
  const float turns = 0.5f / to_float(scene.environment_height);  // of a row
  const SinCos middle = sincos_turns((to_float(row) + 0.5f) * turns);
  const SinCos half = sincos_turns(0.5f * turns);
  return 4.0f * PHALANX_PI / to_float(scene.environment_width) * middle.sine * half.sine;
}

/// Probability of a texel over its solid angle.
PHYS float texel_pdf(const UNI SceneView &scene, int32 column, int32 row) {
  const int32 first = row * (scene.environment_width + 1) + column;
  const double p = (scene.environment_rows[row + 1] - scene.environment_rows[row]) *
                   (scene.environment_columns[first + 1] - scene.environment_columns[first]);
  return (float)p / texel_solid_angle(scene, row);
}

/// Density of sample_environment() per solid angle.
PHYS float environment_pdf(const UNI SceneView &scene, Vec2 uv) {
  const int32 column = to_int(uv.x * to_float(scene.environment_width));
  const int32 row = to_int(uv.y * to_float(scene.environment_height));
  const int32 last_column = scene.environment_width - 1;
  const int32 last_row = scene.environment_height - 1;
  return texel_pdf(scene, column < last_column ? column : last_column,
                   row < last_row ? row : last_row);
}

/// An interval of a distribution function, and how far into it, in [0, 1).
struct Interval {
  int32 index;
  float offset;
};

/// Finds i with cdf[first + i] <= u < cdf[first + i + 1] among `count` intervals: one that is not empty.
PHYS Interval find_interval(const UNI double *UNI cdf, int32 first, int32 count, float u) {
  const double x = (double)u;
  int32 lo = 0;
  int32 hi = count;
  while (hi - lo > 1) {
    const int32 middle = (lo + hi) >> 1;
    if (cdf[first + middle] <= x)
      lo = middle;
    else
      hi = middle;
  }
  Interval r;
  r.index = lo;
  const double from = cdf[first + lo];
  r.offset = min_of((float)((x - from) / (cdf[first + lo + 1] - from)), 0.99999994f);
  return r;
}

struct EnvironmentSample {
  Vec3 direction;  // unit, in the world
  Vec2 uv;
  float pdf;  // per solid angle
};

/// Draws a texel by its brightness and size, and a direction uniformly within.
PHYS EnvironmentSample sample_environment(const UNI SceneView &scene, Vec2 u) {
  const Interval row = find_interval(scene.environment_rows, 0, scene.environment_height, u.y);
  const Interval column =
      find_interval(scene.environment_columns, row.index * (scene.environment_width + 1),
                    scene.environment_width, u.x);
  // From the nearer pole: there 1 - cos keeps the digits that cos has lost.
  const bool south = 2 * row.index >= scene.environment_height;
  const float edge = to_float(south ? scene.environment_height - 1 - row.index : row.index);
  const float down = south ? 1.0f - row.offset : row.offset;
  const float half_turns = 0.25f / to_float(scene.environment_height);
  const SinCos upper = sincos_turns(edge * half_turns);
  const SinCos lower = sincos_turns((edge + 1.0f) * half_turns);
  const float h0 = 2.0f * upper.sine * upper.sine;
  const float h = h0 + down * (2.0f * lower.sine * lower.sine - h0);  // 1 - cos
  const float ring = safe_sqrt(h * (2.0f - h));
  const float height = south ? h - 1.0f : 1.0f - h;
  const float x = (to_float(column.index) + column.offset) / to_float(scene.environment_width);
  const SinCos around = sincos_turns(x - 0.5f);
  EnvironmentSample s;
  s.uv = vec2(x, 2.0f * atan2_turns(ring, height));
  s.direction =
      to_world(environment_frame(scene), vec3(ring * around.sine, height, -ring * around.cosine));
  s.pdf = texel_pdf(scene, column.index, row.index);
  return s;
}

PHALANX_END
