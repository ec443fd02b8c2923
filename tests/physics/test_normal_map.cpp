// Normal maps, bump maps, and materials whose parameters come from textures.
#include <doctest/doctest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "../../kernels/physics/material.h"
#include "../../kernels/physics/normal_map.h"
#include "support/materials.h"
#include "support/textures.h"

using namespace phalanx;
using namespace phalanx::test;

namespace {

const Vec3 kNone = {0, 0, 0};
const Frame kFlat = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TexturePoint point_at(float u, float v) { return {{u, v}, {0, 0, 0}, {1, 1, 1}}; }

Material with_normal_map(int32 texture, float scale) {
  Material m = diffuse(0.5f);
  m.normal_texture = texture;
  m.normal_scale = scale;
  return m;
}

Material with_bump_map(int32 texture, float scale) {
  Material m = diffuse(0.5f);
  m.bump_texture = texture;
  m.bump_scale = scale;
  return m;
}

int32 add_constant(TextureSet &set, Vec3 colour) {
  Texture t = plain_texture(kConstantTexture);
  t.a = colour;
  return set.add(t);
}

/// A ramp of heights that grows by `across` from texel to texel and by `up` from row to row, upwards.
int32 add_ramp(TextureSet &set, int32 size, float across, float up) {
  Texture t = plain_texture(kImageTexture);
  t.wrap_u = t.wrap_v = kClamp;
  std::vector<float> texels;
  for (int32 row = 0; row < size; row++)
    for (int32 column = 0; column < size; column++) {
      const float h = across * static_cast<float>(column) - up * static_cast<float>(row);
      texels.insert(texels.end(), {h, h, h, 1.0f});
    }
  return set.add_floats(t, size, size, texels);
}

void check_near(Vec3 a, Vec3 b, float epsilon) {
  CHECK(std::fabs(a.x - b.x) <= epsilon);
  CHECK(std::fabs(a.y - b.y) <= epsilon);
  CHECK(std::fabs(a.z - b.z) <= epsilon);
}

const Tangents kUnitTangents = {{1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}};

}  // namespace

TEST_CASE("normal map: a flat map and no map leave the normal as it is, bit for bit") {
  TextureSet set;
  const int32 flat = add_constant(set, {0.5f, 0.5f, 1});
  const int32 bumps = add_constant(set, {0.7f, 0.7f, 0.7f});
  Material both = with_normal_map(flat, 1);
  both.bump_texture = bumps;
  for (const Material &m :
       {diffuse(0.5f), with_normal_map(flat, 1), with_bump_map(bumps, 100), both}) {
    const Vec3 n = mapped_normal(set.view(), m, kFlat, point_at(0.3f, 0.4f), kUnitTangents);
    CHECK(n.x == 0.0f);
    CHECK(n.y == 0.0f);
    CHECK(n.z == 1.0f);
  }
}

TEST_CASE("normal map: colours are directions, scaled across") {
  TextureSet set;
  // 0.6, 0.48, 0.64 is unit.
  const int32 tilted = add_constant(set, {0.8f, 0.74f, 0.82f});
  const auto normal = [&](float scale) {
    return mapped_normal(set.view(), with_normal_map(tilted, scale), kFlat, point_at(0, 0),
                         {kNone, kNone, kNone, kNone});
  };
  check_near(normal(1), {0.6f, 0.48f, 0.64f}, 1e-6f);
  check_near(normal(0), {0, 0, 1}, 1e-6f);
  check_near(normal(0.5f), normalize(vec3(0.3f, 0.24f, 0.64f)), 1e-6f);
}

TEST_CASE("normal map: whatever a map holds, the normal is unit and above the horizon") {
  Random random(1);
  for (int i = 0; i < 5000; i++) {
    TextureSet set;
    const float size = std::exp2(random.between(-40, 100));
    const int32 map = set.add_floats(
        plain_texture(kImageTexture), 1, 1,
        {random.between(-size, size), random.between(-size, size), random.between(-size, size), 1});
    const int32 ramp = add_ramp(set, 4, random.between(-size, size), random.between(-size, size));
    Material m = with_normal_map(map, random.between(0, 1000));
    if (random.chance(0.5)) m.bump_texture = ramp;
    if (random.chance(0.2)) m.normal_texture = -1;
    m.bump_scale = random.between(-10, 10);
    Vec3 u = random.direction(), v = random.direction();
    if (random.chance(0.2)) v = u * 3.0f;  // parallel
    if (random.chance(0.1)) u = kNone;
    if (random.chance(0.1)) v = u * std::numeric_limits<float>::infinity();
    const Vec3 n = mapped_normal(set.view(), m, make_frame(random.direction()),
                                 point_at(random.unit(), random.unit()), {u, v, u, v});
    REQUIRE(all_finite(n));
    REQUIRE(std::fabs(length(n) - 1) < 1e-5f);
    REQUIRE(n.z > 0.0099f);
  }
}

TEST_CASE("bump map: a ramp tilts the normal against its slope, whatever uv and frame are") {
  Random random(2);
  for (int i = 0; i < 500; i++) {
    TextureSet set;
    const int32 size = 8 + random.below(20);
    // Slopes per uv.
    const float slope_u = random.between(-1, 1), slope_v = random.between(-1, 1);
    const auto texels = static_cast<float>(size);
    const int32 ramp = add_ramp(set, size, slope_u / texels, slope_v / texels);
    const float bump_scale = random.between(-2, 2);
    // Metres per uv, skewed, in a plane that stands anywhere.
    const Frame frame = make_frame(random.direction());
    const Vec3 dpdu = to_world(frame, {random.between(0.5f, 3), random.between(-0.4f, 0.4f), 0});
    const Vec3 dpdv = to_world(frame, {random.between(-0.4f, 0.4f), random.between(0.5f, 3), 0});
    const Vec3 local = mapped_normal(set.view(), with_bump_map(ramp, bump_scale), frame,
                                     point_at(0.25f + 0.5f * random.unit(), 0.3f), {dpdu, dpdv, kNone, kNone});
    // The displaced surface has the tangents dpdu + n dh/du and dpdv + n dh/dv (Blinn 1978).
    const Vec3 raised_u = dpdu + frame.n * (bump_scale * slope_u);
    const Vec3 raised_v = dpdv + frame.n * (bump_scale * slope_v);
    check_near(to_world(frame, local), normalize(cross(raised_u, raised_v)), 2e-5f);
  }
}

TEST_CASE("bump map: solid textures follow the position, transformed images their uv") {
  Random random(3);
  TextureSet set;
  Texture noise = plain_texture(kNoiseTexture);
  noise.a = {0, 0, 0};
  noise.b = {1, 1, 1};
  noise.scale = 2;
  noise.octaves = 1;
  const int32 solid = set.add(noise);
  const auto height = [&](Vec3 p) {
    return 0.5 + 0.5 * static_cast<double>(gradient_noise(p * 2.0f));
  };
  for (int i = 0; i < 200; i++) {
    const Frame frame = make_frame(random.direction());
    TexturePoint at = point_at(0, 0);
    at.position = random.point(3);
    const double h = 1e-3;
    const auto slope = [&](Vec3 along) {
      const Vec3 step = along * static_cast<float>(h);
      return (height(at.position + step) - height(at.position - step)) / (2 * h);
    };
    // In an instance, a metre along s or t is another step of the texture: turned, scaled, sheared.
    const bool instanced = random.chance(0.5);
    const Vec3 along_s = instanced ? random.direction() * random.between(0.5f, 2) : frame.s;
    const Vec3 along_t = instanced ? random.direction() * random.between(0.5f, 2) : frame.t;
    const Vec3 n = mapped_normal(set.view(), with_bump_map(solid, 0.1f), frame, at,
                                 {kNone, kNone, along_s, along_t});
    const Vec3 expected = {static_cast<float>(-0.1 * slope(along_s)),
                           static_cast<float>(-0.1 * slope(along_t)), 1};
    check_near(n, normalize(expected), 3e-3f);
  }
  // Repeated four times along u, a slope is four times as steep; mirrored, it is reversed.
  const int32 ramp = add_ramp(set, 16, 1.0f / 16, 0);
  for (const float factor : {4.0f, -1.0f}) {
    Texture repeated = set.textures[static_cast<std::size_t>(ramp)];
    repeated.m00 = factor;
    repeated.m02 = factor < 0 ? 1 : 0;
    repeated.wrap_u = kRepeat;
    const Vec3 n = mapped_normal(set.view(), with_bump_map(set.add(repeated), 1), kFlat,
                                 point_at(0.225f, 0.5f), kUnitTangents);
    check_near(n, normalize(vec3(-factor, 0, 1)), 1e-5f);
  }
}

TEST_CASE("material: constants stay, bit for bit, and textures take their place") {
  TextureSet set;
  const int32 colour = add_constant(set, {0.25f, 0.5f, 0.75f});
  const int32 number = add_constant(set, {0.3f, 0.3f, 0.3f});
  const int32 large = add_constant(set, {7, 7, 7});
  Material constants = material(kPrincipled, 0.4f);
  constants.alpha = constants.alpha_x = constants.alpha_y = 0.2f;
  constants.metallic = 0.1f;
  const TexturePoint at = point_at(0.5f, 0.5f);
  const Material same = textured_material(set.view(), constants, at);
  CHECK(std::memcmp(&same, &constants, sizeof same) == 0);
  Material none = constants;
  none.textured = 1;
  const Material still = textured_material(set.view(), none, at);
  CHECK(std::memcmp(&still, &none, sizeof still) == 0);

  Material m = constants;
  m.textured = 1;
  m.reflectance_texture = m.specular_texture = m.transmittance_texture = m.sheen_texture = colour;
  m.metallic_texture = m.transmission_texture = m.roughness_texture = number;
  m.clearcoat_texture = large;
  const Material r = textured_material(set.view(), m, at);
  for (const Vec3 &c : {r.reflectance, r.specular, r.transmittance, r.sheen}) {
    CHECK(c.x == 0.25f);
    CHECK(c.y == 0.5f);
    CHECK(c.z == 0.75f);
  }
  CHECK(r.metallic == 0.3f);
  CHECK(r.transmission == 0.3f);
  CHECK(r.clearcoat == 1.0f);  // a part of light
  CHECK(r.roughness == 0.3f);
  for (const float alpha : {r.alpha, r.alpha_x, r.alpha_y}) CHECK(alpha == 0.3f * 0.3f);
  m.reflectance_texture = large;
  const Vec3 white = textured_material(set.view(), m, at).reflectance;
  CHECK((white.x == 1.0f && white.y == 1.0f && white.z == 1.0f));
}

TEST_CASE("material: roughness from a texture keeps anisotropy and the range of alpha") {
  TextureSet set;
  Material m = glossy_conductor(0.4f, 0.1f);
  m.alpha = 0.2f;
  m.textured = 1;
  m.roughness_texture = add_constant(set, {0.5f, 0.5f, 0.5f});
  const Material r = textured_material(set.view(), m, point_at(0, 0));
  CHECK(r.alpha == 0.25f);
  CHECK(r.alpha_x == doctest::Approx(0.5f));
  CHECK(r.alpha_y == doctest::Approx(0.125f));
  m.roughness_texture = add_constant(set, {0, 0, 0});
  CHECK(textured_material(set.view(), m, point_at(0, 0)).alpha_y == 1e-3f);
  m.roughness_texture = add_constant(set, {1, 1, 1});
  CHECK(textured_material(set.view(), m, point_at(0, 0)).alpha_x == 1.0f);
}
