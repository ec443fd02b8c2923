// Wavefront OBJ through tinyobjloader, by its callbacks: they hand over raw indices, where its
// other interface drops faces and trusts indices. obj_text.h says what is checked beforehand.
#include <algorithm>
#include <cmath>
#include <istream>
#include <streambuf>

#include <tiny_obj_loader.h>

#include "mesh_readers.h"
#include "obj_text.h"
#include "polygon.h"

namespace phalanx {
namespace {

using std::size_t;

/// Reads a string without copying it.
struct TextBuffer : std::streambuf {
  explicit TextBuffer(std::string &text) {
    setg(text.data(), text.data(), text.data() + text.size());
  }
};

/// Index 0 is the first vertex or normal; kNone: the corner has none.
constexpr std::int64_t kNone = INT64_MIN;
struct Corner {
  std::int64_t vertex, normal;
};

/// What the callbacks collect.
struct ObjContent {
  std::vector<float> positions, normals;
  std::vector<Corner> corners;           // face after face
  std::vector<std::int32_t> face_sizes;  // corners of each face
};

std::int64_t from_obj_index(int index, size_t num_floats_so_far) {
  if (index == 0) return kNone;
  return index > 0 ? index - 1LL : static_cast<std::int64_t>(num_floats_so_far / 3) + index;
}

void on_vertex(void *data, float x, float y, float z, float) {
  auto &positions = static_cast<ObjContent *>(data)->positions;
  positions.insert(positions.end(), {x, y, z});
}

void on_normal(void *data, float x, float y, float z) {
  auto &normals = static_cast<ObjContent *>(data)->normals;
  normals.insert(normals.end(), {x, y, z});
}

void on_face(void *data, tinyobj::index_t *indices, int count) {
  auto &content = *static_cast<ObjContent *>(data);
  content.face_sizes.push_back(count);
  for (int i = 0; i < count; ++i)
    content.corners.push_back({from_obj_index(indices[i].vertex_index, content.positions.size()),
                               from_obj_index(indices[i].normal_index, content.normals.size())});
}

/// The name of a face for messages: its number among all `f` lines, those left out included.
std::string face_name(const ObjText &checked, size_t face) {
  const auto &small = checked.small_face_lines;
  const auto before = std::lower_bound(small.begin(), small.end(), checked.face_lines[face]);
  return "face " + std::to_string(face + 1 + static_cast<size_t>(before - small.begin()));
}

/// Empty, or which face refers to what does not exist; `face` counts from 0.
std::string check_ranges(const ObjContent &content, size_t &face) {
  const auto num_vertices = static_cast<std::int64_t>(content.positions.size() / 3);
  const auto num_normals = static_cast<std::int64_t>(content.normals.size() / 3);
  size_t corner = 0;
  for (face = 0; face < content.face_sizes.size(); ++face) {
    for (std::int32_t i = 0; i < content.face_sizes[face]; ++i, ++corner) {
      const auto [vertex, normal] = content.corners[corner];
      if (vertex < 0 || vertex >= num_vertices)
        return "vertex " + std::to_string(vertex + 1) + " does not exist, the file has " +
               std::to_string(num_vertices);
      if (normal != kNone && (normal < 0 || normal >= num_normals))
        return "normal " + std::to_string(normal + 1) + " does not exist, the file has " +
               std::to_string(num_normals);
    }
  }
  return {};
}

/// Vertices of the mesh by (vertex, normal) of the file: one normal per vertex.
class VertexSplitter {
 public:
  explicit VertexSplitter(const ObjContent &content)
      : content_(content), first_(content.positions.size() / 3, -1) {}

  std::int32_t vertex(Corner corner, MeshData &mesh) {
    std::int32_t *link = &first_[static_cast<size_t>(corner.vertex)];
    while (*link >= 0) {
      Copy &copy = copies_[static_cast<size_t>(*link)];
      if (copy.normal == corner.normal) return *link;
      link = &copy.next;
    }
    const auto added = static_cast<std::int32_t>(copies_.size());
    *link = added;
    copies_.push_back({corner.normal, -1});
    for (size_t axis = 0; axis < 3; ++axis) {
      mesh.positions.push_back(content_.positions[static_cast<size_t>(corner.vertex) * 3 + axis]);
      mesh.normals.push_back(content_.normals[static_cast<size_t>(corner.normal) * 3 + axis]);
    }
    return added;
  }

 private:
  struct Copy {
    std::int64_t normal;
    std::int32_t next;  // the next copy of the same vertex, -1: the last
  };
  const ObjContent &content_;
  std::vector<std::int32_t> first_;
  std::vector<Copy> copies_;
};

/// Splits the faces into triangles over the vertices of the file. Returns how many polygons were
/// too large to be split exactly; fills triangle_corners with positions in content.corners.
std::int64_t triangulate_faces(const ObjContent &content, std::vector<size_t> &triangle_corners) {
  std::int64_t num_inexact = 0;
  std::vector<std::int32_t> polygon, triangles;
  size_t first = 0;
  triangle_corners.reserve(content.corners.size());
  for (const std::int32_t size : content.face_sizes) {
    polygon.clear();
    triangles.clear();
    for (size_t i = 0; i < static_cast<size_t>(size); ++i)
      polygon.push_back(static_cast<std::int32_t>(content.corners[first + i].vertex));
    if (!triangulate_polygon(content.positions, polygon, triangles)) ++num_inexact;
    for (const std::int32_t corner : triangles)
      triangle_corners.push_back(first + static_cast<size_t>(corner));
    first += static_cast<size_t>(size);
  }
  return num_inexact;
}

MeshData assemble(ObjContent &content, const std::vector<size_t> &triangle_corners,
                  bool has_normals) {
  MeshData mesh;
  mesh.indices.reserve(triangle_corners.size());
  if (has_normals) {
    VertexSplitter splitter(content);
    for (const size_t corner : triangle_corners)
      mesh.indices.push_back(splitter.vertex(content.corners[corner], mesh));
  } else {
    for (const size_t corner : triangle_corners)
      mesh.indices.push_back(static_cast<std::int32_t>(content.corners[corner].vertex));
    mesh.positions = std::move(content.positions);
  }
  return mesh;
}

}  // namespace

MeshData read_obj(std::string text, const MeshSource &source) {
  const ObjText checked = check_obj_text(text);
  if (!checked.error.empty()) return source.fail(checked.error_line, checked.error);

  if (checked.num_vertices > kMaxMeshElements)
    return source.fail(0, "more than " + std::to_string(kMaxMeshElements) + " vertices");

  ObjContent content;
  content.positions.reserve(static_cast<size_t>(checked.num_vertices) * 3);
  content.normals.reserve(static_cast<size_t>(checked.num_normals) * 3);
  content.face_sizes.reserve(checked.face_lines.size());
  TextBuffer buffer(text);
  std::istream stream(&buffer);
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = on_vertex;
  callbacks.normal_cb = on_normal;
  callbacks.index_cb = on_face;
  tinyobj::LoadObjWithCallback(stream, callbacks, &content);
  text = {};

  const auto num_read = [](const std::vector<float> &values) {
    return static_cast<std::int64_t>(values.size() / 3);
  };
  if (num_read(content.positions) != checked.num_vertices ||
      num_read(content.normals) != checked.num_normals ||
      content.face_sizes.size() != checked.face_lines.size())
    return source.fail(0, "tinyobjloader understands the file differently; please report this");
  for (const auto *values : {&content.positions, &content.normals})
    for (size_t i = 0; i < values->size(); ++i)
      if (!std::isfinite((*values)[i]))
        return source.fail(0, (values == &content.positions ? "vertex " : "normal ") +
                                  std::to_string(i / 3 + 1) + " is not finite");
  size_t face = 0;
  const std::string problem = check_ranges(content, face);
  if (!problem.empty())
    return source.fail(checked.face_lines[face], face_name(checked, face) + ": " + problem);
  if (!checked.small_face_lines.empty())
    source.warn(checked.small_face_lines[0],
                std::to_string(checked.small_face_lines.size()) +
                    " faces with fewer than three corners left out, the first here");

  std::vector<size_t> triangle_corners;
  const std::int64_t num_inexact = triangulate_faces(content, triangle_corners);
  if (num_inexact > 0)
    source.warn(0, std::to_string(num_inexact) + " polygons with a notch and more than " +
                       std::to_string(kMaxClippedCorners) + " corners were split as if convex");
  const size_t num_triangles = triangle_corners.size() / 3;
  if (num_triangles == 0) return source.fail(0, "no triangles in the file");
  if (static_cast<std::int64_t>(num_triangles) > kMaxMeshElements)
    return source.fail(0, "more than " + std::to_string(kMaxMeshElements) + " triangles");

  size_t num_with_normal = 0;
  for (const Corner &corner : content.corners) num_with_normal += corner.normal != kNone;
  const bool has_normals = num_with_normal == content.corners.size();
  if (num_with_normal > 0 && !has_normals)
    source.warn(0, "only some corners have normals: all normals left out");
  return assemble(content, triangle_corners, has_normals);
}

}  // namespace phalanx
