#include "scene_file.h"

#include <filesystem>
#include <fstream>
#include <iostream>

#include "json_text.h"
#include "recentre.h"
#include "texture_keys.h"

namespace phalanx {

namespace {

/// Reads all of `stream`, or one byte more than is allowed.
std::string read_bounded(std::istream &stream) {
  std::string text;
  char buffer[1 << 16];
  while (text.size() <= kMaxSceneBytes) {
    stream.read(buffer, sizeof buffer);
    text.append(buffer, static_cast<std::size_t>(stream.gcount()));
    if (!stream) break;
  }
  return text;
}

/// False if the file's format is not the one that this program knows: nothing else means anything then.
bool check_version(ObjectReader &object, Source &source) {
  const auto version = object.find("version", kRequired);
  if (!version) return true;  // reported with the other missing keys
  const JsonValue &value = *version->value;
  const std::string known = std::to_string(kSceneVersion);
  if (value.kind == JsonKind::kNumber && value.number == kSceneVersion) return true;
  if (value.kind == JsonKind::kNumber && value.number > kSceneVersion) {
    source.error(*version, "version " + printable(value.spelling) +
                               " is newer than this program, which reads version " + known);
  } else {
    source.expected(*version, "the version of the scene format, " + known);
  }
  return false;
}

void read_shapes(const std::vector<Node> &nodes, SceneReader &reader,
                 std::vector<ShapeDescription> &shapes) {
  shapes.resize(nodes.size());  // once: generators remember where each shape stands
  for (std::size_t i = 0; i < nodes.size(); i++) read_shape(nodes[i], reader, shapes[i]);
}

void read_group(const Node &node, SceneReader &reader, GroupDescription &group) {
  ObjectReader object(node, reader.source);
  if (object.text("name", group.name, kRequired)) {
    reader.groups.add(group.name, *object.find("name"), reader.source);
  } else {
    reader.groups.add_nameless();
  }
  read_shapes(object.array("shapes", "shapes", kRequired), reader, group.shapes);
  object.finish("a group");
}

InstanceDescription read_instance(const Node &node, SceneReader &reader) {
  InstanceDescription instance;
  instance.origin = reader.source.file() + ": " + node.path;
  ObjectReader object(node, reader.source);
  std::string group;
  if (object.text("group", group, kRequired)) {
    instance.group = reader.groups.find(group, *object.find("group"), reader.source);
  }
  if (const auto member = object.find("transform"))
    instance.transform = read_transform(*member, reader.source);
  if (const auto member = object.find("transform_end"))
    instance.transform_end = read_transform(*member, reader.source);
  object.finish("an instance");
  return instance;
}

void read_settings(ObjectReader &object, Source &source, SceneDescription &scene) {
  std::string description;
  object.text("description", description);
  if (const auto member = object.find("camera")) scene.camera = read_camera(*member, source);
  if (const auto member = object.find("film")) scene.film = read_film(*member, source);
  if (const auto member = object.find("sampler")) scene.sampler = read_sampler(*member, source);
  if (const auto member = object.find("integrator"))
    scene.integrator = read_integrator(*member, source);
}

void read_world(ObjectReader &object, SceneReader &reader, SceneDescription &scene) {
  if (object.is_unreadable("textures")) reader.textures.add_nameless();
  for (const Node &node : object.array("textures", "textures")) {
    reader.texture_list.push_back(read_texture(node, reader));
  }
  scene.textures = reader.texture_list;
  if (object.is_unreadable("materials")) reader.materials.add_nameless();
  for (const Node &node : object.array("materials", "materials")) {
    scene.materials.push_back(read_material(node, reader));
  }
  find_blended_materials(reader, scene.materials);
  reader.mesh_needs = find_mesh_needs(scene.textures, scene.materials);
  if (scene.integrator.kind == kViewUv)
    for (MeshNeeds &needs : reader.mesh_needs) needs.uvs = true;

  read_lights(object.array("lights", "lights"), reader, scene);
  read_shapes(object.array("shapes", "shapes"), reader, scene.shapes);

  if (object.is_unreadable("groups")) reader.groups.add_nameless();
  const std::vector<Node> groups = object.array("groups", "groups");
  scene.groups.resize(groups.size());
  for (std::size_t i = 0; i < groups.size(); i++) read_group(groups[i], reader, scene.groups[i]);
  for (const Node &node : object.array("instances", "instances")) {
    scene.instances.push_back(read_instance(node, reader));
  }
}

}  // namespace

SceneDescription parse_scene_text(const std::string &text, const std::string &name,
                                  const std::string &base_dir, Diagnostics &diagnostics) {
  SceneDescription scene;
  scene.file = name;
  Source source(name, diagnostics);
  JsonValue root;
  if (!parse_json(text, source, root)) return scene;
  ObjectReader object({&root, ""}, source);
  if (!object.is_object() || !check_version(object, source)) return scene;

  SceneReader reader(source, base_dir);
  read_settings(object, source, scene);
  read_world(object, reader, scene);
  object.finish("a scene");
  if (diagnostics.has_errors()) return scene;
  for (const auto &generate : reader.generators) generate();
  recentre(scene);
  return scene;
}

SceneDescription load_scene_file(const std::string &path, Diagnostics &diagnostics) {
  namespace fs = std::filesystem;
  const bool is_stdin = path == "-";
  const std::string name = is_stdin ? "standard input" : path;
  std::error_code error;
  const auto fail = [&](const std::string &message) {
    diagnostics.error({name, 0, 0, "", message});
    SceneDescription scene;
    scene.file = name;
    return scene;
  };

  std::ifstream file;
  if (!is_stdin) {
    if (fs::is_directory(path, error)) return fail("this is a folder; expected a scene file");
    file.open(path, std::ios::binary);
    if (!file)
      return fail(fs::exists(path, error) ? "the file cannot be read" : "there is no such file");
  }
  std::istream &stream = is_stdin ? std::cin : file;
  const std::string text = read_bounded(stream);
  if (stream.bad()) return fail("reading the file failed");
  if (text.size() > kMaxSceneBytes) {
    return fail("the file is larger than 64 MiB; put big meshes into .obj or .ply files");
  }
  return parse_scene_text(text, name, is_stdin ? "." : fs::path(path).parent_path().string(),
                          diagnostics);
}

}  // namespace phalanx
