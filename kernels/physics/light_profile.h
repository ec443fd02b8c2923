// Light that leaves a point unequally in different directions: spots and measured luminaires.
#pragma once
#include "../scene_view.h"
#include "mathx.h"

PHALANX_BEGIN

/// Part of a spot's intensity at this cosine to its axis: 1 within the inner cone, 0 beyond the outer, between
/// them the smoothstep of the cosine (as in pbrt-v4).
PHYS float spot_falloff(Light light, float cosine) {
  if (cosine >= light.cos_inner) return 1.0f;
  if (!(cosine > light.cos_outer)) return 0.0f;
  const float x = (cosine - light.cos_outer) / (light.cos_inner - light.cos_outer);
  return x * x * (3.0f - 2.0f * x);
}

/// Relative intensity in unit direction w from the light. Both edges of the table are stored: 0 and 180
/// degrees, 0 and 360.
PHYS float profile_intensity(const UNI SceneView &scene, int32 profile, Vec3 w) {
  const LightProfile p = fetch(scene.profiles, profile);
  const float x = dot(w, p.s);
  const float y = dot(w, p.t);
  const float turns = atan2_turns(y, x);
  const float h = (turns < 0.0f ? turns + 1.0f : turns) * to_float(p.num_horizontal - 1);
  const float v =
      2.0f * atan2_turns(square_root(x * x + y * y), dot(w, p.n)) * to_float(p.num_vertical - 1);
  int32 column = to_int(h);
  int32 row = to_int(v);
  column = column < p.num_horizontal - 2 ? column : p.num_horizontal - 2;
  row = row < p.num_vertical - 2 ? row : p.num_vertical - 2;
  const float fh = h - to_float(column);
  const float fv = v - to_float(row);
  const int32 at = p.first + row * p.num_horizontal + column;
  const int32 below = at + p.num_horizontal;
  const float upper = scene.tables[at] * (1.0f - fh) + scene.tables[at + 1] * fh;
  const float lower = scene.tables[below] * (1.0f - fh) + scene.tables[below + 1] * fh;
  return upper * (1.0f - fv) + lower * fv;
}

PHALANX_END
