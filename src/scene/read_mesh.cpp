// Shapes of type "mesh": triangles in a file of their own, or written into the scene.
#include <cmath>
#include <filesystem>

#include "mesh_io.h"
#include "read_scene.h"

namespace phalanx {

namespace {

constexpr Range kVertexColour = {0, kMaxRadiance};

/// Calls `take(number, node)` for each number of a flat array, or of an array of tuples (triples, for
/// `size` 3), until it returns false. What is neither is reported, the first time only: arrays may
/// have millions.
template <typename Take>
bool for_each_number(const Node &node, std::size_t size, Source &source, const Take &take) {
  const std::string tuples = size == 3 ? "triples" : "pairs";
  if (!check_array(node, "numbers or of " + tuples + " of numbers", source)) return false;
  const std::vector<JsonValue> &items = node.value->items();
  const bool nested = !items.empty() && items[0].kind == JsonKind::kArray;
  for (std::size_t i = 0; i < items.size(); i++) {
    if (!nested) {
      if (!take(items[i], [&] { return node.item(i); })) return false;
      continue;
    }
    if (items[i].kind != JsonKind::kArray || items[i].items().size() != size) {
      source.expected(node.item(i), std::string(size == 3 ? "three" : "two") +
                                        " numbers, as in the items before");
      return false;
    }
    for (std::size_t j = 0; j < size; j++) {
      if (!take(items[i].items()[j], [&] { return node.item(i).item(j); })) return false;
    }
  }
  return true;
}

/// Numbers in `range`, `size` for each vertex.
bool read_vectors(const Node &node, std::size_t size, const Range &range, Source &source,
                  std::vector<float> &out) {
  const bool good =
      for_each_number(node, size, source, [&](const JsonValue &value, const auto &place) {
        double number = value.number;
        const bool fine = (value.kind == JsonKind::kNumber && range.contains(number)) ||
                          check_number(place(), range, source, number);
        out.push_back(static_cast<float>(number));
        return fine;
      });
  if (good && out.size() % size != 0) {
    source.error(node, "expected " + std::string(size == 3 ? "three" : "two") +
                           " numbers for every vertex, found " + std::to_string(out.size()) +
                           " numbers");
    return false;
  }
  return good;
}

bool read_indices(const Node &node, std::size_t num_vertices, Source &source,
                  std::vector<std::int32_t> &out) {
  const double last = static_cast<double>(num_vertices) - 1;
  const bool good =
      for_each_number(node, 3, source, [&](const JsonValue &value, const auto &place) {
        const double index = value.number;
        if (value.kind != JsonKind::kNumber || index != std::floor(index)) {
          source.expected(place(), "a whole number, the index of a vertex");
          return false;
        }
        if (index < 0 || index > last) {
          source.error(place(), "index " + printable(value.spelling) +
                                    " is out of range: the mesh has " +
                                    std::to_string(num_vertices) + " vertices, counted from 0");
          return false;
        }
        out.push_back(static_cast<std::int32_t>(index));
        return true;
      });
  if (good && out.size() % 3 != 0) {
    source.error(node, "expected three indices for every triangle, found " +
                           std::to_string(out.size()) + " indices");
    return false;
  }
  return good;
}

/// One tuple of `size` numbers for each of the vertices, 0 if their number is not known: normals, uvs,
/// colours. `one`: "normal".
void read_per_vertex(const std::optional<Node> &node, std::size_t size, const Range &range,
                     const std::string &one, std::size_t num_vertices, Source &source,
                     std::vector<float> &out) {
  if (!node || !read_vectors(*node, size, range, source, out)) return;
  if (num_vertices == 0 || out.size() == num_vertices * size) return;
  source.error(*node, "expected one " + one + " for each of the " + std::to_string(num_vertices) +
                          " vertices, found " + std::to_string(out.size() / size));
}

MeshData read_inline_mesh(ObjectReader &object, Source &source, MeshNeeds needs) {
  MeshData mesh;
  const auto positions = object.find("positions", kRequired);
  const auto indices = object.find("indices", kRequired);
  const auto normals = object.find("normals");
  const bool known_vertices =
      positions && read_vectors(*positions, 3, kCoordinate, source, mesh.positions);
  const std::size_t num_vertices = known_vertices ? mesh.positions.size() / 3 : 0;
  read_per_vertex(normals, 3, kDirection, "normal", num_vertices, source, mesh.normals);
  read_per_vertex(object.find("uvs"), 2, kDirection, "uv", num_vertices, source, mesh.uvs);
  read_per_vertex(object.find("colours"), 3, kVertexColour, "colour", num_vertices, source,
                  mesh.colours);
  if (!needs.uvs) mesh.uvs = {};
  if (!needs.colours) mesh.colours = {};
  if (!known_vertices || !indices) return mesh;
  const bool known_triangles =
      read_indices(*indices, mesh.positions.size() / 3, source, mesh.indices);
  if (known_triangles && mesh.indices.empty())
    source.error(*indices, "the mesh is empty: it has no triangles");
  return mesh;
}

MeshData read_referenced_mesh(const Node &node, const std::string &file, SceneReader &reader,
                              const std::string &origin, MeshNeeds needs) {
  namespace fs = std::filesystem;
  if (!is_mesh_file(file)) {
    reader.source.expected(node, "the name of an .obj or .ply file");
    return {};
  }
  const fs::path path = fs::path(reader.base_dir) / file;  // an absolute `file` stands for itself
  std::error_code error;
  if (!fs::exists(path, error)) {
    reader.source.error(node, "there is no file '" + printable(path.string()) + "'");
    return {};
  }
  if (fs::is_directory(path, error)) {
    reader.source.error(node,
                        "'" + printable(path.string()) + "' is a folder; expected a mesh file");
    return {};
  }
  return read_mesh_file(path.string(), origin, reader.source.diagnostics(), needs);
}

}  // namespace

MeshData read_mesh(ObjectReader &object, SceneReader &reader, const std::string &origin,
                   MeshNeeds needs) {
  int num_inline = 0;  // asks for every key, which makes all of them known
  for (const char *key : {"positions", "indices", "normals", "uvs", "colours"})
    num_inline += object.has(key);
  const bool is_inline = num_inline > 0;
  if (object.has("file") && is_inline) {
    object.error("give either a file, or positions and indices");
    return {};
  }
  if (is_inline) return read_inline_mesh(object, reader.source, needs);
  std::string file;
  if (!object.text("file", file, kRequired)) return {};
  return read_referenced_mesh(*object.find("file"), file, reader, origin, needs);
}

}  // namespace phalanx
