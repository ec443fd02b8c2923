// Keys of materials that take a value, or a texture by its name.
#pragma once
#include "read_scene.h"

namespace phalanx {

/// The key holds a grey value or [r, g, b] in `range`, which goes to `value`; or the name of a texture,
/// whose index goes to `texture`. False if it is absent or wrong.
bool colour_or_texture(ObjectReader &object, std::string_view key, const Range &range,
                       SceneReader &reader, Double3 &value, std::int32_t &texture);
/// The same with one number, which a texture gives by its channel.
bool number_or_texture(ObjectReader &object, std::string_view key, const Range &range,
                       SceneReader &reader, double &value, std::int32_t &texture);
/// Only a texture.
bool texture_name(ObjectReader &object, std::string_view key, SceneReader &reader,
                  std::int32_t &texture);

/// "emission", "emission_scale", "two_sided".
void read_emission(ObjectReader &object, SceneReader &reader, MaterialDescription &material);
/// "opacity".
void read_opacity(ObjectReader &object, SceneReader &reader, MaterialDescription &material);
/// "normal_map", "normal_scale", "bump_map", "bump_scale".
void read_relief(ObjectReader &object, SceneReader &reader, MaterialDescription &material);

/// What the meshes of each material need, given all textures and materials.
std::vector<MeshNeeds> find_mesh_needs(const std::vector<TextureDescription> &textures,
                                       const std::vector<MaterialDescription> &materials);

}  // namespace phalanx
