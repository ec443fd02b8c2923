// The parts of the scene reader, one file a family. Each takes an object of the JSON tree, reports
// what is wrong with it, and returns what it describes; wrong fields keep their defaults.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "description.h"
#include "name_table.h"
#include "object_reader.h"

namespace phalanx {

/// What a blend is made of, as its file says: strings that name materials, unless they are unreadable.
struct BlendParts {
  Node self, a, b;
};

/// What the readers of shapes share.
struct SceneReader {
  SceneReader(Source &the_source, std::string the_base_dir)
      : source(the_source), base_dir(std::move(the_base_dir)) {}

  Source &source;
  std::string base_dir;  // where relative file names start
  NameTable textures{"texture"};
  NameTable materials{"material"};
  NameTable groups{"group"};
  std::vector<TextureDescription> texture_list;  // in the order of their names
  std::vector<BlendParts> blends;                // one for each blend among the materials
  std::vector<MeshNeeds> mesh_needs;             // per material (texture_keys.h)
  MeshNeeds needs_of(std::int32_t material) const {
    const auto i = static_cast<std::size_t>(material);
    return i < mesh_needs.size() ? mesh_needs[i] : MeshNeeds();
  }
  /// Generators, run only after the whole file was found good: they may take seconds and gigabytes.
  std::vector<std::function<void()>> generators;
};

CameraDescription read_camera(const Node &node, Source &source);           // read_camera.cpp
FilmDescription read_film(const Node &node, Source &source);               // read_film.cpp
SamplerDescription read_sampler(const Node &node, Source &source);         // read_sampler.cpp
IntegratorDescription read_integrator(const Node &node, Source &source);   // read_sampler.cpp
TextureDescription read_texture(const Node &node, SceneReader &reader);    // read_texture.cpp
MaterialDescription read_material(const Node &node, SceneReader &reader);  // read_material.cpp
/// Once all materials are read: fills in what blends are made of.
void find_blended_materials(SceneReader &reader,
                            std::vector<MaterialDescription> &materials);  // read_blend.cpp
void read_lights(const std::vector<Node> &nodes, SceneReader &reader,
                 SceneDescription &scene);  // read_lights.cpp
/// The value of a key "transform": one step, or an array of steps applied in their order.
Transform read_transform(const Node &node, Source &source);  // read_transform.cpp
/// `shape` must stay where it is until the generators ran.
void read_shape(const Node &node, SceneReader &reader, ShapeDescription &shape);  // read_shape.cpp
MeshData read_mesh(ObjectReader &object, SceneReader &reader, const std::string &origin,
                   MeshNeeds needs);  // read_mesh.cpp

CurvesShape read_curves(ObjectReader &object);  // read_curves.cpp
/// A length, or two: [at the root, at the tip].
void read_root_and_tip(const char *key, ObjectReader &object, std::array<double, 2> &out,
                       Presence presence = kOptional);  // read_curves.cpp

/// A shape made by a formula: its type's name and what reads its keys. The generator that `read`
/// returns must only run if no error was reported.
using Generator = std::function<ShapeGeometry()>;
struct GeneratedType {
  const char *name;
  Generator (*read)(ObjectReader &object);
};
const std::vector<GeneratedType> &generated_types();  // read_generated.cpp

}  // namespace phalanx
