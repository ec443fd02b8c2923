// An item of "shapes": a surface, its material and where it stands.
#include <cmath>

#include "read_scene.h"

namespace phalanx {

namespace {

QuadShape read_quad(ObjectReader &object) {
  QuadShape quad = {};
  object.vector("corner", kCoordinate, quad.corner, kRequired);
  object.vector("edge_u", kCoordinate, quad.edge_u, kRequired);
  object.vector("edge_v", kCoordinate, quad.edge_v, kRequired);
  return quad;
}

SpheresShape read_sphere(ObjectReader &object) {
  Double3 center = {0, 0, 0};
  double radius = 1;
  object.vector("center", kCoordinate, center, kRequired);
  object.number("radius", kLength, radius, kRequired);
  return {{{center[0], center[1], center[2], radius}}};
}

DiskShape read_disk(ObjectReader &object) {
  DiskShape disk = {};
  disk.normal = {0, 0, 1};
  object.vector("center", kCoordinate, disk.center, kRequired);
  object.vector("normal", kDirection, disk.normal, kRequired);
  object.number("radius", kLength, disk.radius, kRequired);
  if (std::hypot(disk.normal[0], disk.normal[1], disk.normal[2]) == 0) {
    object.error("the normal is [0, 0, 0]: expected a direction");
  }
  return disk;
}

enum ShapeType { kQuadType, kSphereType, kDiskType, kMeshType, kCurvesType, kFirstGeneratedType };

const std::vector<Choice> &shape_types() {
  static const std::vector<Choice> types = [] {
    std::vector<Choice> all = {
        {"quad", kQuadType}, {"sphere", kSphereType}, {"disk", kDiskType}, {"mesh", kMeshType},
        {"curves", kCurvesType}};
    for (const GeneratedType &type : generated_types())
      all.push_back({type.name, static_cast<int>(all.size())});
    return all;
  }();
  return types;
}

void read_generated(int type, ObjectReader &object, SceneReader &reader, ShapeDescription &shape) {
  const auto index = static_cast<std::size_t>(type - kFirstGeneratedType);
  const Generator generate = generated_types()[index].read(object);
  reader.generators.push_back([&shape, generate] { shape.shape = generate(); });
}

void read_geometry(int type, ObjectReader &object, SceneReader &reader, ShapeDescription &shape) {
  switch (type) {
    case kQuadType:
      shape.shape = read_quad(object);
      break;
    case kSphereType:
      shape.shape = read_sphere(object);
      break;
    case kDiskType:
      shape.shape = read_disk(object);
      break;
    case kMeshType:
      shape.shape = MeshShape{read_mesh(object, reader, shape.origin, reader.needs_of(shape.material))};
      break;
    case kCurvesType:
      shape.shape = read_curves(object);
      break;
    default:
      read_generated(type, object, reader, shape);
      break;
  }
}

}  // namespace

void read_shape(const Node &node, SceneReader &reader, ShapeDescription &shape) {
  shape.origin = reader.source.file() + ": " + node.path;
  ObjectReader object(node, reader.source);
  std::string material;
  if (object.text("material", material, kRequired)) {
    shape.material = reader.materials.find(material, *object.find("material"), reader.source);
  }
  if (const auto member = object.find("transform"))
    shape.transform = read_transform(*member, reader.source);
  int type = 0;
  if (!object.choice("type", shape_types(), type, kRequired)) return object.give_up("a shape");
  read_geometry(type, object, reader, shape);
  const std::string name = shape_types()[static_cast<std::size_t>(type)].name;
  object.finish((name == "icosphere" ? "an " : "a ") + name + " shape");
}

}  // namespace phalanx
