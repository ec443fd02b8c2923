#include "texture_keys.h"

namespace phalanx {

namespace {

constexpr Range kNormalScale = {0, 1000};
constexpr Range kBumpScale = {-kMaxCoordinate, kMaxCoordinate, "metres"};

/// The index of the texture that a string names.
bool find_texture(const Node &node, SceneReader &reader, std::int32_t &texture) {
  std::string name;
  if (!check_text(node, reader.source, name)) return false;
  const int errors_before = reader.source.num_errors();
  const std::int32_t index = reader.textures.find(name, node, reader.source);
  if (reader.source.num_errors() != errors_before) return false;
  texture = index;
  return true;
}

/// The texture `index`, or null if the file's textures cannot be read.
const TextureDescription *texture_at(const SceneReader &reader, std::int32_t index) {
  const auto i = static_cast<std::size_t>(index);
  return i < reader.texture_list.size() ? &reader.texture_list[i] : nullptr;
}

void warn_of_srgb(const Node &node, SceneReader &reader, std::int32_t texture) {
  const TextureDescription *const read = texture_at(reader, texture);
  if (read == nullptr || !read->srgb || read->channel == 3) return;
  reader.source.warn(node, "texture '" + printable(read->name) +
                               "' is decoded from sRGB; pictures of numbers mostly are \"linear\"");
}

/// A blend needs what its parts need, which may be blends.
void add_needs_of_parts(const std::vector<MaterialDescription> &materials,
                        std::vector<MeshNeeds> &needs) {
  for (bool has_grown = true; has_grown;) {
    has_grown = false;
    for (std::size_t i = 0; i < materials.size(); i++) {
      if (!is_blend(materials[i])) continue;
      const MeshNeeds before = needs[i];
      for (const std::int32_t index : {materials[i].blend_a, materials[i].blend_b}) {
        const auto part = static_cast<std::size_t>(index);
        if (part >= needs.size()) continue;
        needs[i].uvs |= needs[part].uvs;
        needs[i].colours |= needs[part].colours;
      }
      has_grown |= needs[i].uvs != before.uvs || needs[i].colours != before.colours;
    }
  }
}

}  // namespace

bool colour_or_texture(ObjectReader &object, std::string_view key, const Range &range,
                       SceneReader &reader, Double3 &value, std::int32_t &texture) {
  const auto member = object.find(key);
  if (!member) return false;
  if (member->value->kind == JsonKind::kString) return find_texture(*member, reader, texture);
  return check_colour(*member, range, reader.source, value);
}

bool number_or_texture(ObjectReader &object, std::string_view key, const Range &range,
                       SceneReader &reader, double &value, std::int32_t &texture) {
  const auto member = object.find(key);
  if (!member) return false;
  if (member->value->kind != JsonKind::kString)
    return check_number(*member, range, reader.source, value);
  if (!find_texture(*member, reader, texture)) return false;
  warn_of_srgb(*member, reader, texture);
  return true;
}

bool texture_name(ObjectReader &object, std::string_view key, SceneReader &reader,
                  std::int32_t &texture) {
  const auto member = object.find(key);
  return member && find_texture(*member, reader, texture);
}

void read_emission(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  colour_or_texture(object, "emission", kRadiance, reader, material.emission,
                    material.textures.emission);
  if (material.textures.emission >= 0) material.emission = {1, 1, 1};
  Double3 scale = {1, 1, 1};
  if (object.colour("emission_scale", kRadiance, scale) && object.ok()) {
    if (material.textures.emission < 0)
      object.error("emission_scale is for emission from a texture");
    material.emission = scale;
  }
  object.boolean("two_sided", material.two_sided);
  if (object.ok() && material.two_sided && material.emission == Double3{0, 0, 0})
    reader.source.warn(object.node(), "two_sided does nothing without emission");
}

void read_opacity(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  number_or_texture(object, "opacity", kUnitInterval, reader, material.opacity,
                    material.textures.opacity);
}

void read_relief(ObjectReader &object, SceneReader &reader, MaterialDescription &material) {
  MaterialTextures &textures = material.textures;
  if (texture_name(object, "normal_map", reader, textures.normal)) {
    const TextureDescription *const map = texture_at(reader, textures.normal);
    if (map != nullptr && map->srgb)
      object.error("a normal map is not sRGB: give texture '" + printable(map->name) +
                   "' \"colour_space\": \"linear\"");
  }
  if (object.number("normal_scale", kNormalScale, material.normal_scale) &&
      !object.has("normal_map"))
    object.error("normal_scale is for a normal_map");
  if (texture_name(object, "bump_map", reader, textures.bump))
    warn_of_srgb(*object.find("bump_map"), reader, textures.bump);
  if (object.number("bump_scale", kBumpScale, material.bump_scale) && !object.has("bump_map"))
    object.error("bump_scale is for a bump_map");
}

std::vector<MeshNeeds> find_mesh_needs(const std::vector<TextureDescription> &textures,
                                       const std::vector<MaterialDescription> &materials) {
  std::vector<MeshNeeds> needs(materials.size());
  for (std::size_t i = 0; i < materials.size(); i++) {
    const MaterialDescription &material = materials[i];
    const MaterialTextures &t = material.textures;
    needs[i].uvs = material.anisotropic;  // the tangent follows u
    for (const std::int32_t texture :
         {t.reflectance, t.specular, t.transmittance, t.roughness, t.metallic, t.transmission,
          t.clearcoat, t.sheen, t.emission, t.weight, t.opacity, t.normal, t.bump}) {
      if (texture < 0) continue;
      needs[i].uvs = true;
      needs[i].colours |= static_cast<std::size_t>(texture) < textures.size() &&
                          textures[static_cast<std::size_t>(texture)].kind == kVertexColourTexture;
    }
  }
  add_needs_of_parts(materials, needs);
  return needs;
}

}  // namespace phalanx
