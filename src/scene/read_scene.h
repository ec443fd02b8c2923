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

/// What the readers of shapes share.
struct SceneReader {
  SceneReader(Source &the_source, std::string the_base_dir)
      : source(the_source), base_dir(std::move(the_base_dir)) {}

  Source &source;
  std::string base_dir;  // where relative file names start
  NameTable materials{"material"};
  NameTable groups{"group"};
  /// Generators, run only after the whole file was found good: they may take seconds and gigabytes.
  std::vector<std::function<void()>> generators;
};

CameraDescription read_camera(const Node &node, Source &source);           // read_camera.cpp
FilmDescription read_film(const Node &node, Source &source);               // read_film.cpp
SamplerDescription read_sampler(const Node &node, Source &source);         // read_sampler.cpp
IntegratorDescription read_integrator(const Node &node, Source &source);   // read_sampler.cpp
MaterialDescription read_material(const Node &node, SceneReader &reader);  // read_material.cpp
void read_lights(const std::vector<Node> &nodes, Source &source,
                 SceneDescription &scene);  // read_lights.cpp
/// The value of a key "transform": one step, or an array of steps applied in their order.
Transform read_transform(const Node &node, Source &source);  // read_transform.cpp
/// `shape` must stay where it is until the generators ran.
void read_shape(const Node &node, SceneReader &reader, ShapeDescription &shape);  // read_shape.cpp
MeshData read_mesh(ObjectReader &object, SceneReader &reader,
                   const std::string &origin);  // read_mesh.cpp

/// A shape made by a formula: its type's name and what reads its keys. The generator that `read`
/// returns must only run if no error was reported.
using Generator = std::function<std::variant<MeshShape, QuadShape, SpheresShape, DiskShape>()>;
struct GeneratedType {
  const char *name;
  Generator (*read)(ObjectReader &object);
};
const std::vector<GeneratedType> &generated_types();  // read_generated.cpp

}  // namespace phalanx
