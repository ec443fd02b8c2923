// An item of "textures": an image or a pattern that parameters of materials can name.
#include <algorithm>
#include <cctype>
#include <filesystem>

#include "read_scene.h"
#include "turn.h"

namespace phalanx {

namespace {

constexpr Range kColour = {0, kMaxRadiance};
constexpr Range kFactor = {-1e6, 1e6};
constexpr Range kDegrees = {-1e6, 1e6, "degrees"};
constexpr Range kCells = {1e-9, 1e9, "cells per metre"};
constexpr Range kTurbulence = {0, 1000};

const std::vector<Choice> kTextureTypes = {
    {"constant", kConstantTexture}, {"image", kImageTexture},
    {"checker", kCheckerTexture},   {"marble", kMarbleTexture},
    {"noise", kNoiseTexture},       {"vertex_colour", kVertexColourTexture}};
const std::vector<Choice> kWraps = {
    {"repeat", kRepeat}, {"clamp", kClamp}, {"mirrored", kMirrored}};
const std::vector<Choice> kFilters = {{"bilinear", 0}, {"nearest", 1}};
const std::vector<Choice> kColourSpaces = {{"linear", 0}, {"srgb", 1}};
const std::vector<Choice> kChannels = {{"r", 0}, {"g", 1}, {"b", 2}, {"a", 3}, {"luminance", 4}};

/// Two numbers of a key, or one that stands for both.
void read_pair(ObjectReader &object, const char *key, const Range &range, bool one_for_both,
               double (&out)[2]) {
  const auto member = object.find(key);
  if (!member) return;
  double pair[2] = {};
  if (one_for_both && member->value->kind == JsonKind::kNumber) {
    if (check_number(*member, range, object.source(), pair[0])) out[0] = out[1] = pair[0];
    return;
  }
  if (member->value->kind != JsonKind::kArray || member->value->items().size() != 2) {
    object.source().expected(
        *member,
        (one_for_both ? "a number, or two numbers [u, v] " : "two numbers [u, v] ") + range.text());
    return;
  }
  bool good = true;
  for (std::size_t i = 0; i < 2; i++)
    good &= check_number(member->item(i), range, object.source(), pair[i]);
  if (good) std::copy(pair, pair + 2, out);
}

/// "transform": scales uv, then turns it, then moves it.
void read_uv_transform(ObjectReader &object, TextureDescription &texture) {
  const auto member = object.find("transform");
  if (!member) return;
  ObjectReader transform(*member, object.source());
  double scale[2] = {1, 1}, offset[2] = {0, 0}, angle = 0;
  read_pair(transform, "scale", kFactor, true, scale);
  transform.number("rotate", kDegrees, angle);
  read_pair(transform, "offset", kFactor, false, offset);
  transform.finish("a texture transform");
  const SinCos turn = sin_cos_of_turns(angle / 360);
  const double rotation[2][2] = {{turn.cos, -turn.sin}, {turn.sin, turn.cos}};
  for (int row = 0; row < 2; row++) {
    for (int column = 0; column < 2; column++)
      texture.to_texture[row][column] = rotation[row][column] * scale[column];
    texture.to_texture[row][2] = offset[row];
  }
}

std::string lower_extension(const std::string &file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// "file" and "colour_space". Whether the file is an image is seen when it is read.
void read_file_name(ObjectReader &object, SceneReader &reader, TextureDescription &texture) {
  namespace fs = std::filesystem;
  std::string file;
  int space = 0;
  const bool has_space = object.choice("colour_space", kColourSpaces, space);
  if (!object.text("file", file, kRequired)) return;
  const Node node = *object.find("file");
  const std::string extension = lower_extension(file);
  const bool is_stored = extension == ".png" || extension == ".jpg" || extension == ".jpeg";
  if (!is_stored && extension != ".hdr" && extension != ".exr")
    return reader.source.error(node, "expected the name of a .png, .jpg, .hdr or .exr file");
  texture.srgb = has_space ? space != 0 : is_stored;
  if (texture.srgb && !is_stored)
    return object.error("the numbers of " + extension +
                        " files are linear: leave out colour_space");
  texture.file =
      (fs::path(reader.base_dir) / file).string();  // an absolute `file` stands for itself
  texture.file_place = {reader.source.file(), node.value->line, node.value->column, node.path, ""};
  std::error_code error;
  if (!fs::exists(texture.file, error))
    reader.source.error(node, "there is no file '" + printable(texture.file) + "'");
  else if (!fs::is_regular_file(texture.file, error))
    reader.source.error(node, "'" + printable(texture.file) + "' is no regular file");
}

void read_wrap(ObjectReader &object, TextureDescription &texture) {
  int wrap = kRepeat;
  object.choice("wrap", kWraps, wrap);
  int wrap_u = wrap, wrap_v = wrap;
  object.choice("wrap_u", kWraps, wrap_u);
  object.choice("wrap_v", kWraps, wrap_v);
  texture.wrap_u = static_cast<WrapMode>(wrap_u);
  texture.wrap_v = static_cast<WrapMode>(wrap_v);
}

void read_tint_and_channel(ObjectReader &object, TextureDescription &texture) {
  object.colour("tint", kColour, texture.a);
  object.choice("channel", kChannels, texture.channel);
}

void read_image(ObjectReader &object, SceneReader &reader, TextureDescription &texture) {
  read_file_name(object, reader, texture);
  read_tint_and_channel(object, texture);
  read_wrap(object, texture);
  int nearest = 0;
  object.choice("filter", kFilters, nearest);
  texture.nearest = nearest != 0;
  read_uv_transform(object, texture);
}

void read_two_colours(ObjectReader &object, TextureDescription &texture) {
  object.colour("a", kColour, texture.a);
  object.colour("b", kColour, texture.b);
}

/// Cells per metre and the layers of the noise in them.
void read_solid(ObjectReader &object, TextureDescription &texture) {
  texture.scale = 1;
  object.number("scale", kCells, texture.scale);
  object.integer("octaves", 1, 16, texture.octaves);
}

void read_keys(ObjectReader &object, SceneReader &reader, TextureDescription &texture) {
  switch (texture.kind) {
    case kConstantTexture:
      object.colour("colour", kColour, texture.a, kRequired);
      break;
    case kImageTexture:
      read_image(object, reader, texture);
      break;
    case kCheckerTexture:
      read_two_colours(object, texture);
      read_uv_transform(object, texture);
      if (object.number("scale", kCells, texture.scale) && object.has("transform"))
        object.error("scale makes cubes in space, which take no transform of uv");
      break;
    case kMarbleTexture:
      read_two_colours(object, texture);
      read_solid(object, texture);
      object.number("turbulence", kTurbulence, texture.turbulence);
      break;
    case kNoiseTexture:
      read_two_colours(object, texture);
      read_solid(object, texture);
      break;
    case kVertexColourTexture:
      read_tint_and_channel(object, texture);
      break;
  }
}

}  // namespace

TextureDescription read_texture(const Node &node, SceneReader &reader) {
  TextureDescription texture;
  ObjectReader object(node, reader.source);
  if (object.text("name", texture.name, kRequired)) {
    reader.textures.add(texture.name, *object.find("name"), reader.source);
  } else {
    reader.textures.add_nameless();
  }
  int kind = kConstantTexture;
  if (!object.choice("type", kTextureTypes, kind, kRequired)) {
    object.give_up("a texture");
    return texture;
  }
  texture.kind = static_cast<TextureKind>(kind);
  read_keys(object, reader, texture);
  const std::string name = kTextureTypes[static_cast<std::size_t>(kind)].name;
  object.finish((name == "image" ? "an " : "a ") + name + " texture");
  return texture;
}

}  // namespace phalanx
