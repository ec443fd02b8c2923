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

/// Index 0 is the first vertex, normal, texture coordinate; kNone: the corner has none.
constexpr std::int64_t kNone = INT64_MIN;
struct Corner {
  std::int64_t vertex, normal, uv;
};

/// What the callbacks collect.
struct ObjContent {
  std::vector<float> positions, normals;
  std::vector<float> uvs;                // two each; filled only if they are needed
  std::vector<Corner> corners;           // face after face
  std::vector<std::int32_t> face_sizes;  // corners of each face
};

std::int64_t from_obj_index(int index, size_t num_so_far) {
  if (index == 0) return kNone;
  return index > 0 ? index - 1LL : static_cast<std::int64_t>(num_so_far) + index;
}

void on_vertex(void *data, float x, float y, float z, float) {
  auto &positions = static_cast<ObjContent *>(data)->positions;
  positions.insert(positions.end(), {x, y, z});
}

void on_normal(void *data, float x, float y, float z) {
  auto &normals = static_cast<ObjContent *>(data)->normals;
  normals.insert(normals.end(), {x, y, z});
}

void on_uv(void *data, float u, float v, float) {
  auto &uvs = static_cast<ObjContent *>(data)->uvs;
  uvs.insert(uvs.end(), {u, v});
}

void on_face(void *data, tinyobj::index_t *indices, int count) {
  auto &content = *static_cast<ObjContent *>(data);
  content.face_sizes.push_back(count);
  for (int i = 0; i < count; ++i)
    content.corners.push_back(
        {from_obj_index(indices[i].vertex_index, content.positions.size() / 3),
         from_obj_index(indices[i].normal_index, content.normals.size() / 3),
         from_obj_index(indices[i].texcoord_index, content.uvs.size() / 2)});
}

/// The name of a face for messages: its number among all `f` lines, those left out included.
std::string face_name(const ObjText &checked, size_t face) {
  const auto &small = checked.small_face_lines;
  const auto before = std::lower_bound(small.begin(), small.end(), checked.face_lines[face]);
  return "face " + std::to_string(face + 1 + static_cast<size_t>(before - small.begin()));
}

/// Empty, or which face refers to what does not exist; `face` counts from 0.
std::string check_ranges(const ObjContent &content, bool with_uvs, size_t &face) {
  const auto num_vertices = static_cast<std::int64_t>(content.positions.size() / 3);
  const auto num_normals = static_cast<std::int64_t>(content.normals.size() / 3);
  const auto num_uvs = static_cast<std::int64_t>(content.uvs.size() / 2);
  size_t corner = 0;
  for (face = 0; face < content.face_sizes.size(); ++face) {
    for (std::int32_t i = 0; i < content.face_sizes[face]; ++i, ++corner) {
      const auto [vertex, normal, uv] = content.corners[corner];
      if (vertex < 0 || vertex >= num_vertices)
        return "vertex " + std::to_string(vertex + 1) + " does not exist, the file has " +
               std::to_string(num_vertices);
      if (normal != kNone && (normal < 0 || normal >= num_normals))
        return "normal " + std::to_string(normal + 1) + " does not exist, the file has " +
               std::to_string(num_normals);
      if (with_uvs && uv != kNone && (uv < 0 || uv >= num_uvs))
        return "texture coordinate " + std::to_string(uv + 1) + " does not exist, the file has " +
               std::to_string(num_uvs);
    }
  }
  return {};
}

/// Vertices of the mesh by (vertex, normal, uv) of the file: one normal and uv per vertex.
class VertexSplitter {
 public:
  VertexSplitter(const ObjContent &content, bool has_normals, bool has_uvs)
      : content_(content),
        has_normals_(has_normals),
        has_uvs_(has_uvs),
        first_(content.positions.size() / 3, -1) {}

  std::int32_t vertex(Corner corner, MeshData &mesh) {
    if (!has_normals_) corner.normal = kNone;
    if (!has_uvs_) corner.uv = kNone;
    std::int32_t *link = &first_[static_cast<size_t>(corner.vertex)];
    while (*link >= 0) {
      Copy &copy = copies_[static_cast<size_t>(*link)];
      if (copy.normal == corner.normal && copy.uv == corner.uv) return *link;
      link = &copy.next;
    }
    const auto added = static_cast<std::int32_t>(copies_.size());
    *link = added;
    copies_.push_back({corner.normal, corner.uv, -1});
    append(content_.positions, corner.vertex, 3, mesh.positions);
    if (has_normals_) append(content_.normals, corner.normal, 3, mesh.normals);
    if (has_uvs_) append(content_.uvs, corner.uv, 2, mesh.uvs);
    return added;
  }

 private:
  static void append(const std::vector<float> &from, std::int64_t index, int size,
                     std::vector<float> &to) {
    const auto first = from.begin() + index * size;
    to.insert(to.end(), first, first + size);
  }

  struct Copy {
    std::int64_t normal, uv;
    std::int32_t next;  // the next copy of the same vertex, -1: the last
  };
  const ObjContent &content_;
  bool has_normals_, has_uvs_;
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
                  bool has_normals, bool has_uvs) {
  MeshData mesh;
  mesh.indices.reserve(triangle_corners.size());
  if (has_normals || has_uvs) {
    VertexSplitter splitter(content, has_normals, has_uvs);
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
  const ObjText checked = check_obj_text(text, source.needs.uvs);
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
  callbacks.texcoord_cb = on_uv;
  callbacks.index_cb = on_face;
  tinyobj::LoadObjWithCallback(stream, callbacks, &content);
  text = {};

  const auto num_read = [](const std::vector<float> &values, size_t size) {
    return static_cast<std::int64_t>(values.size() / size);
  };
  if (num_read(content.positions, 3) != checked.num_vertices ||
      num_read(content.normals, 3) != checked.num_normals ||
      num_read(content.uvs, 2) != checked.num_uvs ||
      content.face_sizes.size() != checked.face_lines.size())
    return source.fail(0, "tinyobjloader understands the file differently; please report this");
  for (const auto *values : {&content.positions, &content.normals})
    for (size_t i = 0; i < values->size(); ++i)
      if (!std::isfinite((*values)[i]))
        return source.fail(0, (values == &content.positions ? "vertex " : "normal ") +
                                  std::to_string(i / 3 + 1) + " is not finite");
  for (size_t i = 0; i < content.uvs.size(); ++i)
    if (!std::isfinite(content.uvs[i]))
      return source.fail(0, "texture coordinate " + std::to_string(i / 2 + 1) + " is not finite");
  size_t face = 0;
  const std::string problem = check_ranges(content, source.needs.uvs, face);
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

  size_t num_with_normal = 0, num_with_uv = 0;
  for (const Corner &corner : content.corners) {
    num_with_normal += corner.normal != kNone;
    num_with_uv += corner.uv != kNone;
  }
  const bool has_normals = num_with_normal == content.corners.size();
  const bool has_uvs = source.needs.uvs && num_with_uv == content.corners.size();
  if (num_with_normal > 0 && !has_normals)
    source.warn(0, "only some corners have normals: all normals left out");
  if (source.needs.uvs && num_with_uv > 0 && !has_uvs)
    source.warn(0, "only some corners have texture coordinates: all of them left out");
  return assemble(content, triangle_corners, has_normals, has_uvs);
}

}  // namespace phalanx
