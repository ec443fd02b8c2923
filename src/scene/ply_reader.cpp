// Stanford PLY: text or binary of either byte order. Takes x, y, z of "vertex" and, where all of them are
// there, nx, ny, nz and what else is needed: texture coordinates, red, green, blue; and the polygons of
// "face". Steps over everything else.
#include <cmath>
#include <limits>

#include "../core/srgb.h"
#include "mesh_readers.h"
#include "ply_header.h"
#include "ply_numbers.h"
#include "polygon.h"
#include "value_checks.h"

namespace phalanx {
namespace {

using std::size_t;

/// What a property is a component of.
enum class PlyTarget { kNone, kPosition, kNormal, kUv, kColour };
struct PlyComponent {
  PlyTarget target = PlyTarget::kNone;
  int component = 0;
};
using Columns = std::vector<PlyComponent>;  // one a property

/// Functions return false on an error: those of a row leave it in `problem` or `numbers`, those of
/// an element have reported it.
struct PlyReader {
  const PlyHeader &header;
  const MeshSource &source;
  PlyNumbers numbers;
  MeshData mesh;
  bool has_vertices = false;
  std::int64_t num_small_faces = 0, num_inexact = 0;
  std::string problem;

  bool skip_property(const PlyProperty &property);
  bool skip_element(const PlyElement &element);
  bool read_vertex(const PlyElement &element, const Columns &columns, std::int64_t row);
  bool read_vertices(const PlyElement &element);
  void add_face(const std::vector<std::int32_t> &corners, std::vector<std::int32_t> &triangles);
  bool read_face(const PlyElement &element, int list, std::vector<std::int32_t> &corners);
  bool read_faces(const PlyElement &element);
  bool fail(const std::string &message) {
    problem = message;
    return false;
  }
  bool row_failed(const PlyElement &element, std::int64_t row);
  bool element_failed(const std::string &message) const;
};

/// Rows are counted from 0, as indices in the file are.
bool PlyReader::row_failed(const PlyElement &element, std::int64_t row) {
  const std::string what = problem.empty() ? numbers.problem() : problem;
  source.fail(numbers.line(), element.name + " " + std::to_string(row) + ": " + what);
  return false;
}

bool PlyReader::element_failed(const std::string &message) const {
  source.fail(0, message);
  return false;
}

bool PlyReader::skip_property(const PlyProperty &property) {
  std::int64_t count = 1;
  if (property.is_list && !numbers.next_count(property, count)) return false;
  return numbers.skip(property.type, count);
}

bool PlyReader::skip_element(const PlyElement &element) {
  bool has_list = false;
  for (const PlyProperty &property : element.properties) has_list |= property.is_list;
  if (element.properties.empty()) return true;
  if (!has_list && header.format != PlyFormat::kAscii)
    return numbers.skip_bytes(element.min_row_bytes(header.format), element.count) ||
           row_failed(element, 0);
  for (std::int64_t row = 0; row < element.count; ++row) {
    if (!numbers.begin_row()) return row_failed(element, row);
    for (const PlyProperty &property : element.properties)
      if (!skip_property(property)) return row_failed(element, row);
    numbers.end_row();
  }
  return true;
}

/// The properties `names` become the components of `target`, unless one of them is missing; then its
/// name is returned.
const char *assign(const PlyElement &element, std::initializer_list<const char *> names,
                   PlyTarget target, Columns &columns) {
  const auto find = [&](const char *name) {
    const int column = element.find(name);
    return column >= 0 && element.properties[static_cast<size_t>(column)].is_list ? -1 : column;
  };
  for (const char *name : names)
    if (find(name) < 0) return name;
  int component = 0;
  for (const char *name : names) columns[static_cast<size_t>(find(name))] = {target, component++};
  return nullptr;
}

/// The names that programs give to texture coordinates.
bool assign_uvs(const PlyElement &element, Columns &columns) {
  return !assign(element, {"u", "v"}, PlyTarget::kUv, columns) ||
         !assign(element, {"s", "t"}, PlyTarget::kUv, columns) ||
         !assign(element, {"texture_u", "texture_v"}, PlyTarget::kUv, columns) ||
         !assign(element, {"texture_s", "texture_t"}, PlyTarget::kUv, columns);
}

/// Colours of whole numbers are fractions of the largest, in sRGB; others are linear.
double linear_colour(PlyType type, double value) {
  switch (type) {
    case PlyType::kUint8:
      return linear_from_srgb(value / 255);
    case PlyType::kUint16:
      return linear_from_srgb(value / 65535);
    default:
      return value;
  }
}

bool PlyReader::read_vertex(const PlyElement &element, const Columns &columns, std::int64_t row) {
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty &property = element.properties[i];
    if (columns[i].target == PlyTarget::kNone) {
      if (!skip_property(property)) return false;
      continue;
    }
    double value = 0;
    if (!numbers.next(property.type, value)) return false;
    if (!(std::fabs(value) <= static_cast<double>(std::numeric_limits<float>::max())))
      return fail(property.name + " is not a finite 32-bit number");
    const PlyTarget target = columns[i].target;
    if (target == PlyTarget::kColour) value = linear_colour(property.type, value);
    if (target == PlyTarget::kColour && !(value >= 0 && value <= kMaxRadiance))
      return fail(property.name + " is negative or too large");
    auto &values = target == PlyTarget::kPosition ? mesh.positions
                   : target == PlyTarget::kNormal ? mesh.normals
                   : target == PlyTarget::kUv     ? mesh.uvs
                                                  : mesh.colours;
    const int size = target == PlyTarget::kUv ? 2 : 3;
    values[static_cast<size_t>(row * size + columns[i].component)] = static_cast<float>(value);
  }
  return true;
}

bool PlyReader::read_vertices(const PlyElement &element) {
  Columns columns(element.properties.size());
  if (const char *missing = assign(element, {"x", "y", "z"}, PlyTarget::kPosition, columns))
    return element_failed(std::string("element 'vertex' has no property '") + missing + "'");
  if (element.count > kMaxMeshElements)
    return element_failed("more than " + std::to_string(kMaxMeshElements) + " vertices");
  // The check of the header guarantees that the file is longer than a quarter of what is allocated.
  const auto count = static_cast<size_t>(element.count);
  mesh.positions.resize(count * 3);
  if (!assign(element, {"nx", "ny", "nz"}, PlyTarget::kNormal, columns))
    mesh.normals.resize(count * 3);
  if (source.needs.uvs && assign_uvs(element, columns)) mesh.uvs.resize(count * 2);
  if (source.needs.colours &&
      !assign(element, {"red", "green", "blue"}, PlyTarget::kColour, columns))
    mesh.colours.resize(count * 3);
  for (std::int64_t row = 0; row < element.count; ++row) {
    if (!numbers.begin_row() || !read_vertex(element, columns, row))
      return row_failed(element, row);
    numbers.end_row();
  }
  has_vertices = true;
  return true;
}

void PlyReader::add_face(const std::vector<std::int32_t> &corners,
                         std::vector<std::int32_t> &triangles) {
  if (corners.size() < 3) {
    ++num_small_faces;
    return;
  }
  if (corners.size() == 3) {
    mesh.indices.insert(mesh.indices.end(), corners.begin(), corners.end());
    return;
  }
  triangles.clear();
  if (!triangulate_polygon(mesh.positions, corners, triangles)) ++num_inexact;
  for (const std::int32_t corner : triangles)
    mesh.indices.push_back(corners[static_cast<size_t>(corner)]);
}

bool PlyReader::read_face(const PlyElement &element, int list, std::vector<std::int32_t> &corners) {
  const std::size_t num_vertices = mesh.positions.size() / 3;
  for (size_t i = 0; i < element.properties.size(); ++i) {
    const PlyProperty &property = element.properties[i];
    if (static_cast<int>(i) != list) {
      if (!skip_property(property)) return false;
      continue;
    }
    std::int64_t count = 0;
    if (!numbers.next_count(property, count)) return false;
    corners.clear();
    for (double index = 0; count > 0; --count) {
      if (!numbers.next(property.type, index)) return false;
      if (!(index >= 0 && index < static_cast<double>(num_vertices)) || index != std::floor(index))
        return fail("a corner refers to a vertex that does not exist, the file has " +
                    std::to_string(num_vertices));
      corners.push_back(static_cast<std::int32_t>(index));
    }
  }
  return true;
}

bool PlyReader::read_faces(const PlyElement &element) {
  int list = element.find("vertex_indices");
  if (list < 0) list = element.find("vertex_index");
  if (list < 0 || !element.properties[static_cast<size_t>(list)].is_list)
    return element_failed("element 'face' has no list 'vertex_indices'");
  if (!has_vertices && element.count > 0)
    return element_failed("element 'face' comes before element 'vertex'");
  std::vector<std::int32_t> corners, triangles;
  for (std::int64_t row = 0; row < element.count; ++row) {
    if (!numbers.begin_row() || !read_face(element, list, corners)) return row_failed(element, row);
    numbers.end_row();
    add_face(corners, triangles);
    if (static_cast<std::int64_t>(mesh.indices.size()) > kMaxMeshElements * 3)
      return element_failed("more than " + std::to_string(kMaxMeshElements) + " triangles");
  }
  return true;
}

}  // namespace

MeshData read_ply(const std::string &bytes, const MeshSource &source) {
  PlyHeader header;
  int error_line = 0;
  const std::string problem = parse_ply_header(bytes, header, error_line);
  if (!problem.empty()) return source.fail(error_line, problem);

  PlyReader reader{header, source, PlyNumbers(bytes, header), {}, false, 0, 0, {}};
  for (const PlyElement &element : header.elements) {
    const bool good = element.name == "vertex" ? reader.read_vertices(element)
                      : element.name == "face" ? reader.read_faces(element)
                                               : reader.skip_element(element);
    if (!good) return {};
  }
  const std::int64_t num_left = reader.numbers.num_bytes_left();
  if (num_left > 0)
    source.warn(reader.numbers.line(),
                std::to_string(num_left) + " bytes after the last element ignored");
  if (reader.numbers.num_long_rows() > 0)
    source.warn(reader.numbers.first_long_line(),
                std::to_string(reader.numbers.num_long_rows()) +
                    " rows have more numbers than the header declares, the first here; ignored");
  if (reader.num_small_faces > 0)
    source.warn(0, std::to_string(reader.num_small_faces) +
                       " faces with fewer than three corners left out");
  if (reader.num_inexact > 0)
    source.warn(0, std::to_string(reader.num_inexact) + " polygons with a notch and more than " +
                       std::to_string(kMaxClippedCorners) + " corners were split as if convex");
  if (reader.mesh.indices.empty()) return source.fail(0, "no triangles in the file");
  return std::move(reader.mesh);
}

}  // namespace phalanx
