#include "textures.h"

#include "core/srgb.h"

namespace phalanx::test {

Texture plain_texture(TextureKind kind) {
  Texture t = {};
  t.kind = kind;
  t.channel = 4;
  t.a = {1, 1, 1};
  t.m00 = t.m11 = 1;
  return t;
}

TextureSet::TextureSet() : decode(512) {
  for (std::size_t i = 0; i < 256; i++) {
    decode[i] = static_cast<float>(static_cast<double>(i) / 255);
    decode[i + 256] = static_cast<float>(linear_from_srgb(static_cast<double>(i) / 255));
  }
}

int32 TextureSet::add(const Texture &texture) {
  textures.push_back(texture);
  return static_cast<int32>(textures.size()) - 1;
}

int32 TextureSet::add_bytes(Texture texture, int32 width, int32 height,
                            const std::vector<uint32> &texels) {
  texture.format = kByteTexels;
  texture.first = static_cast<int32>(byte_texels.size());
  texture.width = width;
  texture.height = height;
  byte_texels.insert(byte_texels.end(), texels.begin(), texels.end());
  return add(texture);
}

int32 TextureSet::add_floats(Texture texture, int32 width, int32 height,
                             const std::vector<float> &texels) {
  texture.format = kFloatTexels;
  texture.first = static_cast<int32>(float_texels.size());
  texture.width = width;
  texture.height = height;
  float_texels.insert(float_texels.end(), texels.begin(), texels.end());
  return add(texture);
}

void TextureSet::put_into(SceneView &view) const {
  view.textures = textures.data();
  view.byte_texels = byte_texels.data();
  view.float_texels = float_texels.data();
  view.decode = decode.data();
  view.num_textures = static_cast<int32>(textures.size());
}

SceneView TextureSet::view() const {
  SceneView view = {};
  put_into(view);
  return view;
}

TextureSet random_textures(Random &random) {
  TextureSet set;
  const auto some_texture = [&](TextureKind kind) {
    Texture t = plain_texture(kind);
    t.a = {random.unit(), random.unit(), random.unit()};
    t.b = {random.unit(), random.unit(), random.unit()};
    t.m00 = random.between(-3, 3);
    t.m01 = random.between(-3, 3);
    t.m02 = random.between(-1, 1);
    t.m10 = random.between(-3, 3);
    t.m11 = random.between(-3, 3);
    t.m12 = random.between(-1, 1);
    t.channel = random.below(5);
    t.wrap_u = random.below(3);
    t.wrap_v = random.below(3);
    t.nearest = random.chance(0.3) ? 1 : 0;
    t.srgb = random.below(2);
    t.scale = kind == kCheckerTexture && random.chance(0.5) ? 0.0f : random.between(0.5f, 3);
    t.turbulence = random.between(0, 2);
    t.octaves = 1 + random.below(6);
    return t;
  };
  for (int i = 0; i < 12; i++) {
    const int32 width = 1 + random.below(i < 4 ? 3 : 33), height = 1 + random.below(i < 4 ? 3 : 33);
    const Texture t = some_texture(kImageTexture);
    std::vector<uint32> bytes;
    std::vector<float> floats;
    for (int k = 0; k < width * height; k++) {
      bytes.push_back(static_cast<uint32>(random.bits()));
      for (int c = 0; c < 4; c++) floats.push_back(random.between(-0.2f, 2));
    }
    if (i % 2 == 0)
      set.add_bytes(t, width, height, bytes);
    else
      set.add_floats(t, width, height, floats);
  }
  for (const TextureKind kind : {kConstantTexture, kCheckerTexture, kCheckerTexture, kMarbleTexture,
                                 kNoiseTexture, kVertexColourTexture})
    set.add(some_texture(kind));
  return set;
}

}  // namespace phalanx::test
