#include "build_textures.h"

#include <map>
#include <tuple>

#include "../core/srgb.h"
#include "texture_image.h"

namespace phalanx {
namespace {

/// Texels of a whole scene: kernels address arrays with 32-bit byte offsets.
constexpr std::int64_t kMaxTexels = INT32_MAX / 4;

Vec3 to_vec3(const Double3 &v) {
  return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

template <typename T>
std::int64_t size_of(const std::vector<T> &values) {
  return static_cast<std::int64_t>(values.size());
}

/// Reads image files into the scene's texels.
class TexelStore {
 public:
  TexelStore(Scene &scene, Diagnostics &diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

  /// Sets format, first, width and height. After an error they are those of an image of no texels.
  void place(const TextureDescription &from, Texture &texture) {
    const auto key = std::make_pair(from.file, from.srgb);
    if (const auto known = placed_.find(key); known != placed_.end()) {
      std::tie(texture.format, texture.first, texture.width, texture.height) = known->second;
      return;
    }
    try {
      read(from, texture);
    } catch (const InputError &error) {
      Problem problem = from.file_place;
      problem.message = error.what();
      diagnostics_.error(problem);
    }
    placed_[key] = {texture.format, texture.first, texture.width, texture.height};
  }

 private:
  void read(const TextureDescription &from, Texture &texture) {
    const TextureImage image =
        read_texture_image(from.file, from.srgb, kMaxTexels - size_of(scene_.byte_texels),
                           kMaxTexels - size_of(scene_.float_texels));
    const bool is_bytes = !image.bytes.empty();
    texture.format = is_bytes ? kByteTexels : kFloatTexels;
    texture.width = image.width;
    texture.height = image.height;
    texture.first = static_cast<std::int32_t>(is_bytes ? scene_.byte_texels.size()
                                                       : scene_.float_texels.size());
    scene_.byte_texels.insert(scene_.byte_texels.end(), image.bytes.begin(), image.bytes.end());
    scene_.float_texels.insert(scene_.float_texels.end(), image.floats.begin(), image.floats.end());
  }

  Scene &scene_;
  Diagnostics &diagnostics_;
  std::map<std::pair<std::string, bool>, std::tuple<int32, int32, int32, int32>> placed_;
};

Texture build_texture(const TextureDescription &from, TexelStore &texels) {
  Texture texture = {};
  texture.kind = from.kind;
  texture.channel = from.channel;
  texture.a = to_vec3(from.a);
  texture.b = to_vec3(from.b);
  const auto &m = from.to_texture;
  texture.m00 = static_cast<float>(m[0][0]);
  texture.m01 = static_cast<float>(m[0][1]);
  texture.m02 = static_cast<float>(m[0][2]);
  texture.m10 = static_cast<float>(m[1][0]);
  texture.m11 = static_cast<float>(m[1][1]);
  texture.m12 = static_cast<float>(m[1][2]);
  texture.wrap_u = from.wrap_u;
  texture.wrap_v = from.wrap_v;
  texture.nearest = from.nearest ? 1 : 0;
  texture.srgb = from.srgb ? 1 : 0;
  texture.scale = static_cast<float>(from.scale);
  texture.turbulence = static_cast<float>(from.turbulence);
  texture.octaves = from.octaves;
  if (from.kind == kImageTexture) texels.place(from, texture);
  return texture;
}

/// Bytes to floats: linear, then sRGB.
std::vector<float> decode_table() {
  std::vector<float> table(512);
  for (int i = 0; i < 256; i++) {
    table[static_cast<std::size_t>(i)] = static_cast<float>(i / 255.0);
    table[static_cast<std::size_t>(i) + 256] = static_cast<float>(linear_from_srgb(i / 255.0));
  }
  return table;
}

}  // namespace

void build_textures(const SceneDescription &description, Scene &scene, Diagnostics &diagnostics) {
  if (description.textures.empty()) return;
  scene.decode = decode_table();
  TexelStore texels(scene, diagnostics);
  for (const TextureDescription &from : description.textures)
    scene.textures.push_back(build_texture(from, texels));
}

void set_textures(const MaterialDescription &from, Material &material) {
  const MaterialTextures &t = from.textures;
  material.reflectance_texture = t.reflectance;
  material.specular_texture = t.specular;
  material.transmittance_texture = t.transmittance;
  material.roughness_texture = t.roughness;
  material.metallic_texture = t.metallic;
  material.transmission_texture = t.transmission;
  material.clearcoat_texture = t.clearcoat;
  material.sheen_texture = t.sheen;
  material.emission_texture = t.emission;
  material.weight_texture = t.weight;
  material.opacity_texture = t.opacity;
  material.normal_texture = t.normal;
  material.bump_texture = t.bump;
  material.textured = 0;
  for (const std::int32_t texture : {t.reflectance, t.specular, t.transmittance, t.roughness,
                                     t.metallic, t.transmission, t.clearcoat, t.sheen})
    if (texture >= 0) material.textured = 1;
  material.opacity = static_cast<float>(from.opacity);
  material.normal_scale = static_cast<float>(from.normal_scale);
  material.bump_scale = static_cast<float>(from.bump_scale);
}

}  // namespace phalanx
