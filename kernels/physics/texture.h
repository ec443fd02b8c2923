// Textures: colours and numbers as functions of a place on a surface.
#pragma once
#include "../scene_view.h"
#include "mathx.h"
#include "noise.h"

PHALANX_BEGIN

/// What a texture may depend on.
struct TexturePoint {
  Vec2 uv;        // of the surface
  Vec3 position;  // in the space of the shape's group, metres
  Vec3 colour;    // of the mesh's vertices, interpolated; white without
};

struct Texel {
  Vec3 colour;  // linear RGB
  float alpha;
};

PHYS Vec3 mix(Vec3 a, Vec3 b, float t) { return a + (b - a) * t; }

PHYS Texel make_texel(Vec3 colour, float alpha) {
  Texel texel;
  texel.colour = colour;
  texel.alpha = alpha;
  return texel;
}

/// The uv that a texture's own transform makes of a surface's.
PHYS Vec2 texture_uv(Texture t, Vec2 uv) {
  return vec2(t.m00 * uv.x + t.m01 * uv.y + t.m02, t.m10 * uv.x + t.m11 * uv.y + t.m12);
}

// ---- images -----------------------------------------------------------------------------------

/// Two neighbouring texels of a row or column, and how far from the first to the second.
struct TexelPair {
  int32 first, second;
  float t;
};

/// The texels around x, where 0 and 1 are the edges of the image. Any x, also one that is not finite,
/// gives texels in [0, size).
PHYS TexelPair wrap_texels(float x, int32 size, int32 wrap, int32 nearest) {
  float unit = x;
  if (wrap == kRepeat) unit = x - round_down(x);
  if (wrap == kMirrored) {
    unit = x - 2.0f * round_down(0.5f * x);
    if (unit > 1.0f) unit = 2.0f - unit;
  }
  unit = clamp_to(unit, 0.0f, 1.0f);  // 0 for NaN
  const float scaled = unit * to_float(size);
  const float below = round_down(nearest != 0 ? scaled : scaled - 0.5f);
  const int32 cell = to_int(below);
  const int32 last = size - 1;
  TexelPair pair;
  if (nearest != 0) {
    pair.first = cell > last ? last : cell;
    pair.second = pair.first;
    pair.t = 0.0f;
    return pair;
  }
  const bool cyclic = wrap == kRepeat;
  pair.first = cell < 0 ? (cyclic ? last : 0) : cell;
  pair.second = cell >= last ? (cyclic ? 0 : last) : cell + 1;
  pair.t = (scaled - 0.5f) - below;
  return pair;
}

PHYS Texel load_texel(const UNI SceneView &scene, Texture t, int32 column, int32 row) {
  const int32 i = row * t.width + column;
  if (t.format == kByteTexels) {
    const int32 rgba = (int32)scene.byte_texels[t.first + i];
    const int32 table = t.srgb != 0 ? 256 : 0;
    return make_texel(
        vec3(scene.decode[table + (rgba & 255)], scene.decode[table + ((rgba >> 8) & 255)],
             scene.decode[table + ((rgba >> 16) & 255)]),
        scene.decode[(rgba >> 24) & 255]);
  }
  const int32 k = t.first + 4 * i;
  return make_texel(
      vec3(scene.float_texels[k], scene.float_texels[k + 1], scene.float_texels[k + 2]),
      scene.float_texels[k + 3]);
}

PHYS Texel mix(Texel a, Texel b, float t) {
  return make_texel(mix(a.colour, b.colour, t), mix(a.alpha, b.alpha, t));
}

/// Bilinear, in the form a + (b - a) t: where neighbours are equal, nothing is rounded.
PHYS Texel image_texel(const UNI SceneView &scene, Texture t, Vec2 uv) {
  const TexelPair column = wrap_texels(uv.x, t.width, t.wrap_u, t.nearest);
  const TexelPair row = wrap_texels(1.0f - uv.y, t.height, t.wrap_v, t.nearest);
  const Texel corner = load_texel(scene, t, column.first, row.first);
  if (t.nearest != 0) return corner;
  const Texel upper = mix(corner, load_texel(scene, t, column.second, row.first), column.t);
  const Texel lower = mix(load_texel(scene, t, column.first, row.second),
                          load_texel(scene, t, column.second, row.second), column.t);
  return mix(upper, lower, row.t);
}

// ---- patterns ---------------------------------------------------------------------------------

/// True for odd whole numbers. Beyond 2^24 all are even.
PHYS bool is_odd(float whole) { return whole - 2.0f * round_down(0.5f * whole) == 1.0f; }

/// 1 in every other cell: squares of uv, or with scale > 0 cubes in space.
PHYS float checker_pattern(Texture t, Vec2 uv, Vec3 position) {
  float sum = round_down(uv.x) + round_down(uv.y);
  if (t.scale > 0.0f) {
    const Vec3 p = position * t.scale;
    sum = round_down(p.x) + round_down(p.y) + round_down(p.z);
  }
  return is_odd(sum) ? 1.0f : 0.0f;
}

/// Stripes across x, shifted by turbulence. K. Perlin, "An Image Synthesizer" (SIGGRAPH 1985).
PHYS float marble_pattern(Texture t, Vec3 position) {
  const Vec3 p = position * t.scale;
  const float phase = p.x + t.turbulence * fractal_noise(p, t.octaves, true);
  const SinCos wave = sincos_turns(clamp_to(phase - round_down(phase), 0.0f, 1.0f));
  return clamp_to(0.5f + 0.5f * wave.sine, 0.0f, 1.0f);
}

PHYS float noise_pattern(Texture t, Vec3 position) {
  return clamp_to(0.5f + 0.5f * fractal_noise(position * t.scale, t.octaves, false), 0.0f, 1.0f);
}

// ---- any texture ------------------------------------------------------------------------------

PHYS_CALL Texel texture_texel(const UNI SceneView &scene, int32 texture, TexturePoint at) {
  const Texture t = fetch(scene.textures, texture);
  const Vec2 uv = texture_uv(t, at.uv);
  if (t.kind == kImageTexture) {
    const Texel texel = image_texel(scene, t, uv);
    return make_texel(t.a * texel.colour, texel.alpha);
  }
  if (t.kind == kVertexColourTexture) return make_texel(t.a * at.colour, 1.0f);
  float weight = 0.0f;
  if (t.kind == kCheckerTexture) weight = checker_pattern(t, uv, at.position);
  if (t.kind == kMarbleTexture) weight = marble_pattern(t, at.position);
  if (t.kind == kNoiseTexture) weight = noise_pattern(t, at.position);
  return make_texel(mix(t.a, t.b, weight), 1.0f);
}

/// The colour of texture number `texture` (>= 0), linear RGB; no component is negative.
PHYS Vec3 texture_value(const UNI SceneView &scene, int32 texture, TexturePoint at) {
  const Texel texel = texture_texel(scene, texture, at);
  return max3(texel.colour, vec3(0.0f, 0.0f, 0.0f));
}

/// The channel of a texture that a parameter of one number reads. Heights may be negative.
PHYS float texture_number(const UNI SceneView &scene, int32 texture, TexturePoint at) {
  const Texel texel = texture_texel(scene, texture, at);
  const Vec3 c = texel.colour;
  const Texture t = fetch(scene.textures, texture);
  if (t.channel == 0) return c.x;
  if (t.channel == 1) return c.y;
  if (t.channel == 2) return c.z;
  if (t.channel == 3) return texel.alpha;
  return c.x == c.y && c.y == c.z ? c.x : luminance(c);  // grey stays exact
}

PHALANX_END
