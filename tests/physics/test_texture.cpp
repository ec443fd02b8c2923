// Textures: what an image gives between its texels and beyond its edges, patterns, noise.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "core/srgb.h"
#include "support/textures.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

bool same_bits(float a, float b) { return std::bit_cast<int32>(a) == std::bit_cast<int32>(b); }
bool same_bits(Vec3 a, Vec3 b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

TexturePoint point_at(float u, float v) { return {{u, v}, {0, 0, 0}, {1, 1, 1}}; }

/// Coordinates that come from broken meshes.
float wild_coordinate(Random &random) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kWild[] = {0.0f,
                             -0.0f,
                             1.0f,
                             -1.0f,
                             1 - 0x1p-24f,
                             -0x1p-149f,
                             1e-9f,
                             -1e-9f,
                             1e9f,
                             -1e9f,
                             2147483648.0f,
                             -2147483904.0f,
                             3e38f,
                             -3e38f,
                             kInfinity,
                             -kInfinity,
                             std::numeric_limits<float>::quiet_NaN(),
                             0.5f};
  if (random.chance(0.5)) return kWild[random.below(static_cast<int>(std::size(kWild)))];
  return random.between(-3, 3) * std::exp2(random.between(-30, 30));
}

/// An image of floats, `value(column, row)` in all channels, alpha 1.
template <typename Value>
int32 add_grey(TextureSet &set, const Texture &t, int32 width, int32 height, const Value &value) {
  std::vector<float> texels;
  for (int32 row = 0; row < height; row++)
    for (int32 column = 0; column < width; column++) {
      const float v = value(column, row);
      texels.insert(texels.end(), {v, v, v, 1.0f});
    }
  return set.add_floats(t, width, height, texels);
}

}  // namespace

TEST_CASE("texture: one texel is its constant, bit for bit, wherever it is looked up") {
  Random random(1);
  for (int i = 0; i < 300; i++) {
    TextureSet set;
    Texture t = plain_texture(kImageTexture);
    t.wrap_u = random.below(3);
    t.wrap_v = random.below(3);
    t.nearest = random.below(2);
    t.srgb = random.below(2);
    const Vec3 colour = {random.unit(), random.unit() * 1e-20f, random.unit() * 1e20f};
    const float alpha = random.unit();
    const int32 floats = set.add_floats(t, 1, 1, {colour.x, colour.y, colour.z, alpha});
    const int32 bytes = set.add_bytes(t, 1, 1, {0x80ff3301u});
    Texture constant = plain_texture(kConstantTexture);
    constant.a = colour;
    const int32 same = set.add(constant);
    const auto byte = [&](std::size_t b) { return set.decode[b + (t.srgb != 0 ? 256 : 0)]; };
    for (int k = 0; k < 100; k++) {
      const TexturePoint at = point_at(wild_coordinate(random), wild_coordinate(random));
      CHECK(same_bits(texture_value(set.view(), floats, at), colour));
      CHECK(same_bits(texture_value(set.view(), same, at), colour));
      CHECK(same_bits(texture_texel(set.view(), floats, at).alpha, alpha));
      CHECK(same_bits(texture_value(set.view(), bytes, at), {byte(1), byte(0x33), byte(0xff)}));
      CHECK(same_bits(texture_texel(set.view(), bytes, at).alpha, set.decode[0x80]));
    }
  }
}

TEST_CASE("texture: any coordinate gives texels that exist and a weight in [0, 1]") {
  Random random(2);
  for (const int32 size : {1, 2, 3, 7, 1000, 1 << 20})
    for (const int32 wrap : {kRepeat, kClamp, kMirrored})
      for (int i = 0; i < 20000; i++) {
        const float x = wild_coordinate(random);
        const TexelPair pair = wrap_texels(x, size, wrap, random.below(2));
        CAPTURE(x);
        CAPTURE(size);
        CAPTURE(wrap);
        REQUIRE((pair.first >= 0 && pair.first < size));
        REQUIRE((pair.second >= 0 && pair.second < size));
        REQUIRE((pair.t >= 0 && pair.t <= 1));
      }
}

TEST_CASE("texture: texels at their centres, straight lines between, v = 0 at the lower edge") {
  TextureSet set;
  const Texture t = plain_texture(kImageTexture);
  const auto value = [](int32 column, int32 row) {
    return static_cast<float>(3 * column + 64 * row);
  };
  const int32 image = add_grey(set, t, 8, 4, value);
  const SceneView view = set.view();
  const auto at = [&](float column, float row) {  // in texels, from the upper left corner
    return texture_number(view, image, point_at(column / 8, 1 - row / 4));
  };
  for (int32 row = 0; row < 4; row++)
    for (int32 column = 0; column < 8; column++) {
      const float x = static_cast<float>(column) + 0.5f, y = static_cast<float>(row) + 0.5f;
      CHECK(at(x, y) == value(column, row));
      if (column < 7) CHECK(at(x + 0.25f, y) == value(column, row) + 0.75f);
      if (row < 3) CHECK(at(x, y + 0.5f) == value(column, row) + 32);
      if (column < 7 && row < 3) CHECK(at(x + 0.5f, y + 0.75f) == value(column, row) + 1.5f + 48);
    }
  // Between the last texel and the first of the next repetition.
  CHECK(at(0, 0.5f) == 0.5f * (value(0, 0) + value(7, 0)));
  CHECK(at(8, 0.5f) == 0.5f * (value(0, 0) + value(7, 0)));
  CHECK(at(7.75f, 0.5f) == 0.75f * value(7, 0) + 0.25f * value(0, 0));
  CHECK(at(0.5f, 3.75f) == 0.75f * value(0, 3) + 0.25f * value(0, 0));
  CHECK(at(0.5f, 0) == 0.5f * (value(0, 0) + value(0, 3)));
}

TEST_CASE("texture: wrapped, clamped and mirrored coordinates") {
  Random random(3);
  TextureSet set;
  for (const int32 nearest : {0, 1}) {
    int32 images[3];
    std::vector<float> texels;
    for (int i = 0; i < 16 * 8 * 4; i++) texels.push_back(random.unit());
    for (const int32 wrap : {kRepeat, kClamp, kMirrored}) {
      Texture t = plain_texture(kImageTexture);
      t.wrap_u = t.wrap_v = wrap;
      t.nearest = nearest;
      images[wrap] = set.add_floats(t, 16, 8, texels);
    }
    const SceneView view = set.view();
    const auto at = [&](int32 wrap, float u, float v) {
      return texture_value(view, images[wrap], point_at(u, v));
    };
    for (int i = 0; i < 2000; i++) {
      // Multiples of 1/1024: sums with whole numbers are exact. Off the borders of texels by half a step.
      const float u = (static_cast<float>(random.below(1024)) + 0.5f) / 1024;
      const float v = (static_cast<float>(random.below(1024)) + 0.5f) / 1024;
      const auto turns = static_cast<float>(random.below(20) - 10);
      CHECK(same_bits(at(kRepeat, u + turns, v - turns), at(kRepeat, u, v)));
      CHECK(same_bits(at(kMirrored, u + 2 * turns, v), at(kMirrored, u, v)));
      CHECK(same_bits(at(kMirrored, -u, v), at(kMirrored, u, v)));
      CHECK(same_bits(at(kMirrored, u, 2 - v), at(kMirrored, u, v)));
      CHECK(same_bits(at(kClamp, u, 1 + v), at(kClamp, u, 1)));
      CHECK(same_bits(at(kClamp, -u, -v), at(kClamp, 0, 0)));
      const bool inside = u > 1 / 32.0f && u < 1 - 1 / 32.0f && v > 1 / 16.0f && v < 1 - 1 / 16.0f;
      if (inside || nearest != 0) CHECK(same_bits(at(kClamp, u, v), at(kRepeat, u, v)));
      CHECK(same_bits(at(kClamp, u, v), at(kMirrored, u, v)));
    }
  }
  // An image of one value gives that value between all texels.
  Texture t = plain_texture(kImageTexture);
  const int32 flat = add_grey(set, t, 5, 3, [](int32, int32) { return 0.3f; });
  for (int i = 0; i < 1000; i++)
    CHECK(
        same_bits(texture_number(set.view(), flat, point_at(random.unit(), random.unit())), 0.3f));
}

TEST_CASE("texture: bytes are decoded by the curve of sRGB, before they are interpolated") {
  const TextureSet table;
  CHECK(table.decode[0] == 0.0f);
  CHECK(table.decode[255] == 1.0f);
  CHECK(table.decode[256] == 0.0f);
  CHECK(table.decode[511] == 1.0f);
  CHECK(table.decode[256 + 188] == doctest::Approx(0.502886).epsilon(1e-5));
  for (std::size_t i = 0; i < 256; i++) {
    CHECK(table.decode[i] == doctest::Approx(static_cast<double>(i) / 255));
    const double back = srgb_from_linear(static_cast<double>(table.decode[256 + i]));
    CHECK(back * 255 == doctest::Approx(static_cast<double>(i)).epsilon(1e-5));
  }
  TextureSet set;
  Texture t = plain_texture(kImageTexture);
  t.srgb = 1;
  t.wrap_u = kClamp;
  const int32 image = set.add_bytes(t, 2, 1, {0xff000000u, 0xffffffffu});
  CHECK(texture_number(set.view(), image, point_at(0.5f, 0.5f)) == 0.5f);  // not 0.214
}

TEST_CASE("texture: a number is one channel, or luminance, which leaves grey exact") {
  TextureSet set;
  for (const int32 channel : {0, 1, 2, 3, 4}) {
    Texture t = plain_texture(kImageTexture);
    t.channel = channel;
    t.a = {2, 2, 2};  // the tint leaves alpha alone
    set.add_floats(t, 1, 1, {0.1f, -0.2f, 0.3f, 0.4f});
  }
  const SceneView view = set.view();
  const TexturePoint at = point_at(0, 0);
  CHECK(texture_number(view, 0, at) == 0.2f);
  CHECK(texture_number(view, 1, at) == -0.4f);  // a height may be negative
  CHECK(texture_number(view, 2, at) == 0.6f);
  CHECK(texture_number(view, 3, at) == 0.4f);
  CHECK(texture_number(view, 4, at) == luminance(vec3(0.2f, -0.4f, 0.6f)));
  CHECK(same_bits(texture_value(view, 0, at), {0.2f, 0, 0.6f}));  // a colour may not
  Texture grey = plain_texture(kConstantTexture);
  for (const float value : {0.1f, 0.3f, 1e-7f}) {
    grey.a = {value, value, value};
    CHECK(same_bits(texture_number(set.view(), set.add(grey), at), value));
  }
}

TEST_CASE("texture: uv are transformed before anything else") {
  TextureSet set;
  Texture t = plain_texture(kImageTexture);
  const auto value = [](int32 column, int32 row) { return static_cast<float>(column + 10 * row); };
  const int32 plain = add_grey(set, t, 4, 4, value);
  t.m00 = 0;  // a quarter turn, then a shift
  t.m01 = -1;
  t.m02 = 0.25f;
  t.m10 = 1;
  t.m11 = 0;
  t.m12 = 0.5f;
  const int32 turned = add_grey(set, t, 4, 4, value);
  const SceneView view = set.view();
  for (float u = 0; u < 1; u += 0.125f)
    for (float v = 0; v < 1; v += 0.125f)
      CHECK(texture_number(view, turned, point_at(u, v)) ==
            texture_number(view, plain, point_at(0.25f - v, 0.5f + u)));
}

TEST_CASE("texture: checkers alternate, in uv or in space") {
  TextureSet set;
  const int32 flat = set.add(plain_texture(kCheckerTexture));
  Texture cubes = plain_texture(kCheckerTexture);
  cubes.scale = 2;
  const int32 solid = set.add(cubes);
  const SceneView view = set.view();
  for (int x = -4; x < 4; x++)
    for (int y = -4; y < 4; y++)
      for (int z = -2; z < 2; z++) {
        const Vec3 middle = {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f,
                             static_cast<float>(z) + 0.5f};
        TexturePoint at = point_at(middle.x, middle.y);
        CHECK(texture_number(view, flat, at) == ((x + y) % 2 == 0 ? 1.0f : 0.0f));
        at.position = middle * 0.5f;
        CHECK(texture_number(view, solid, at) == ((x + y + z) % 2 == 0 ? 1.0f : 0.0f));
      }
  Random random(4);
  for (int i = 0; i < 1000; i++) {
    const float value =
        texture_number(view, flat, point_at(wild_coordinate(random), wild_coordinate(random)));
    CHECK((value == 0.0f || value == 1.0f));
  }
}

TEST_CASE("texture: vertex colours, tinted") {
  TextureSet set;
  Texture t = plain_texture(kVertexColourTexture);
  t.a = {0.5f, 1, 2};
  const int32 texture = set.add(t);
  TexturePoint at = point_at(0, 0);
  at.colour = {0.25f, 0.5f, 0.75f};
  CHECK(same_bits(texture_value(set.view(), texture, at), {0.125f, 0.5f, 1.5f}));
}

TEST_CASE("noise: zero on the lattice, bounded, smooth, without direction") {
  Random random(5);
  for (int x = -3; x <= 3; x++)
    for (int y = -3; y <= 3; y++)
      CHECK(gradient_noise({static_cast<float>(x), static_cast<float>(y), 2}) == 0.0f);
  double sum = 0, squares = 0;
  constexpr int kPoints = 200000;
  for (int i = 0; i < kPoints; i++) {
    const Vec3 p = random.point(40);
    const float n = gradient_noise(p);
    REQUIRE(std::fabs(n) <= 1.04f);
    sum += static_cast<double>(n);
    squares += static_cast<double>(n) * static_cast<double>(n);
    if (i % 10 != 0) continue;
    // A gradient, the same from both sides of a cell's face.
    const float h = 1.0f / 512;
    Vec3 q = p, step = {0, 0, 0};
    const int axis = random.below(3);
    (&step.x)[axis] = h;
    if (random.chance(0.5)) (&q.x)[axis] = std::floor((&q.x)[axis]);
    const float left = (gradient_noise(q) - gradient_noise(q - step)) / h;
    const float right = (gradient_noise(q + step) - gradient_noise(q)) / h;
    REQUIRE(std::fabs(right) < 3.0f);
    REQUIRE(std::fabs(right - left) < 0.1f);  // the second derivative is below 40
  }
  CHECK(std::fabs(sum / kPoints) < 0.01);
  CHECK(squares / kPoints > 0.04);
  CHECK(squares / kPoints < 0.12);
}

TEST_CASE("noise: neighbouring cells, axes and negative coordinates do not repeat each other") {
  int num_equal = 0;
  const auto at = [](float x, float y, float z) { return gradient_noise({x, y, z}); };
  for (int i = -50; i < 50; i++) {
    const float x = static_cast<float>(i) + 0.3f;
    num_equal += at(x, 0.4f, 0.7f) == at(x + 1, 0.4f, 0.7f);
    num_equal += at(x, 0.3f, 7.7f) == at(0.3f, x, 7.7f) && i != 0;
    num_equal += at(x, 0.4f, 0.7f) == at(-x, 0.4f, 0.7f);
    num_equal += at(5.3f, x, 0.7f) == at(5.3f, 0.7f, x);
  }
  CHECK(num_equal < 20);  // gradients are one of twelve: some neighbours do agree
}

TEST_CASE("noise: sums of octaves keep their range; wild points give numbers") {
  Random random(6);
  for (int i = 0; i < 20000; i++) {
    const Vec3 p = random.chance(0.2) ? Vec3{wild_coordinate(random), wild_coordinate(random),
                                             wild_coordinate(random)}
                                      : random.point(20);
    const int octaves = 1 + random.below(16);
    const float n = fractal_noise(p, octaves, false), folded = fractal_noise(p, octaves, true);
    CAPTURE(p.x);
    REQUIRE(std::fabs(n) <= 1.04f);
    REQUIRE((folded >= 0 && folded <= 1.04f));
    REQUIRE(folded >= std::fabs(n));
  }
  CHECK(fractal_noise({0.3f, 0.4f, 0.5f}, 1, false) == gradient_noise({0.3f, 0.4f, 0.5f}));
  CHECK(fractal_noise({0.3f, 0.4f, 0.5f}, 0, false) == 0.0f);
}

TEST_CASE("texture: marble and noise stay between their colours") {
  TextureSet set;
  for (const TextureKind kind : {kMarbleTexture, kNoiseTexture}) {
    Texture t = plain_texture(kind);
    t.a = {0.2f, 0.5f, 0.1f};
    t.b = {0.8f, 0.5f, 0.4f};
    t.scale = 3;
    t.turbulence = 2;
    t.octaves = 4;
    set.add(t);
  }
  Texture stripes = plain_texture(kMarbleTexture);
  stripes.scale = 2;  // one stripe in half a metre
  const int32 marble = set.add(stripes);
  const SceneView view = set.view();
  Random random(7);
  for (const int32 texture : {0, 1}) {
    float least = 1, most = 0;
    for (int i = 0; i < 5000; i++) {
      TexturePoint at = point_at(0, 0);
      at.position = random.chance(0.1) ? Vec3{wild_coordinate(random), 0, 0} : random.point(5);
      const Vec3 c = texture_value(view, texture, at);
      REQUIRE(
          (c.x >= 0.2f && c.x <= 0.8000001f && c.y == 0.5f && c.z >= 0.1f && c.z <= 0.4000001f));
      least = std::fmin(least, c.x);
      most = std::fmax(most, c.x);
    }
    CHECK(least < 0.4f);
    CHECK(most > 0.6f);
  }
  TexturePoint at = point_at(0, 0);
  for (const float x :
       {-1.0f, -0.5f, 0.0f, 0.5f}) {  // white to black as the sine goes from -1 to 1
    at.position = {x, 7, 8};
    CHECK(texture_number(view, marble, at) == 0.5f);
    at.position.x = x + 0.125f;
    CHECK(texture_number(view, marble, at) == 0.0f);
    at.position.x = x + 0.375f;
    CHECK(texture_number(view, marble, at) == 1.0f);
  }
}
