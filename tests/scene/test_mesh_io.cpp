// Mesh files: every variant that must load, every fault that must be refused. STABILITY: G3, D.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <string>

#include <unistd.h>

#include "../../src/scene/mesh_io.h"
#include "../../src/scene/polygon.h"

using namespace phalanx;
namespace fs = std::filesystem;

namespace {

/// A folder for one test's files, removed at the end.
struct TempFolder {
  fs::path path;
  TempFolder() {
    static int count = 0;
    path = fs::temp_directory_path() /
           ("phalanx_mesh_io_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    fs::create_directories(path);
  }
  ~TempFolder() { fs::remove_all(path); }
  std::string write(const std::string &name, const std::string &bytes) const {
    std::ofstream(path / name, std::ios::binary) << bytes;
    return (path / name).string();
  }
};

struct Result {
  MeshData mesh;
  std::string error, warning;  // the first of each, as printed
  int line = 0;                // of the error
};

Result read(const std::string &name, const std::string &bytes) {
  const TempFolder folder;
  Diagnostics diagnostics;
  Result result;
  result.mesh = read_mesh_file(folder.write(name, bytes), "scene.json: /shapes/3", diagnostics);
  if (diagnostics.has_errors()) {
    result.error = diagnostics.errors()[0].text();
    result.line = diagnostics.errors()[0].line;
    CHECK(diagnostics.errors().size() == 1);
    CHECK(result.mesh.indices.empty());
    CHECK(result.mesh.positions.empty());
    CHECK(result.error.find(name) != std::string::npos);
    CHECK(result.error.find("scene.json: /shapes/3") != std::string::npos);
  } else {
    CHECK_FALSE(result.mesh.indices.empty());
  }
  if (!diagnostics.warnings().empty()) result.warning = diagnostics.warnings()[0].text();
  return result;
}

Result read_obj_text(const std::string &text) { return read("mesh.obj", text); }
Result read_ply_text(const std::string &text) { return read("mesh.ply", text); }

void check_error(const Result &result, const std::string &expected) {
  INFO("error: ", result.error, "  expected: ", expected);
  CHECK(result.error.find(expected) != std::string::npos);
}

using Ints = std::vector<std::int32_t>;
using Floats = std::vector<float>;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

/// Signed area in the xy plane.
double signed_area(const Floats &positions, const Ints &indices, std::size_t triangle) {
  const auto at = [&](std::size_t corner, std::size_t axis) {
    return static_cast<double>(
        positions[static_cast<std::size_t>(indices[triangle * 3 + corner]) * 3 + axis]);
  };
  return 0.5 * ((at(1, 0) - at(0, 0)) * (at(2, 1) - at(0, 1)) -
                (at(1, 1) - at(0, 1)) * (at(2, 0) - at(0, 0)));
}

// ---- binary PLY -------------------------------------------------------------------------------

enum class Order { kLittle, kBig };

template <class T>
void put(std::string &bytes, T value, Order order) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes += raw[order == Order::kLittle ? i : sizeof(T) - 1 - i];
}

/// A square with everything around it that a reader must step over.
std::string busy_binary_square(Order order) {
  std::string bytes =
      "ply\nformat " +
      std::string(order == Order::kLittle ? "binary_little_endian" : "binary_big_endian") +
      " 1.0\ncomment made by a test\nobj_info nothing\n"
      "element camera 2\nproperty double view\nproperty list uchar short marks\n"
      "element vertex 4\nproperty uchar red\nproperty double x\nproperty float y\n"
      "property list ushort double weights\nproperty short z\nproperty float confidence\n"
      "element material 1\nproperty int id\n"
      "element face 1\nproperty char flag\nproperty list uchar ushort vertex_index\n"
      "property list int float texcoord\n"
      "element nothing 3\n"
      "end_header\n";
  for (int camera = 0; camera < 2; ++camera) {
    put(bytes, 1.5, order);
    put<std::uint8_t>(bytes, static_cast<std::uint8_t>(camera), order);
    for (int i = 0; i < camera; ++i) put<std::int16_t>(bytes, 7, order);
  }
  for (int i = 0; i < 4; ++i) {
    put<std::uint8_t>(bytes, 200, order);
    put<double>(bytes, i == 1 || i == 2 ? 1 : 0, order);
    put<float>(bytes, i >= 2 ? 1 : 0, order);
    put<std::uint16_t>(bytes, static_cast<std::uint16_t>(i), order);
    for (int k = 0; k < i; ++k) put(bytes, 0.25, order);
    put<std::int16_t>(bytes, -3, order);
    put(bytes, 0.5f, order);
  }
  put<std::int32_t>(bytes, 9, order);
  put<std::int8_t>(bytes, -1, order);
  put<std::uint8_t>(bytes, 4, order);
  for (std::uint16_t i = 0; i < 4; ++i) put(bytes, i, order);
  put<std::int32_t>(bytes, 2, order);
  put(bytes, 0.5f, order);
  put(bytes, 0.75f, order);
  return bytes;
}

const std::string kPlyVertices =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kPlyFaces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kPlyHeader =
    "ply\nformat ascii 1.0\n" + kPlyVertices + kPlyFaces + "end_header\n";
const std::string kPlyTriangle = kPlyHeader + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::string replaced(std::string text, const std::string &from, const std::string &to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// Reads every beginning of the file, and the file with some bytes changed: anything may come out
/// but a crash, an index out of range or a number that is not finite.
void torture(const std::string &name, const std::string &bytes) {
  const TempFolder folder;
  const auto survive = [&](const std::string &damaged) {
    Diagnostics diagnostics;
    const MeshData mesh =
        read_mesh_file(folder.write(name, damaged), "scene.json: /shapes/0", diagnostics);
    bool good = diagnostics.has_errors() == mesh.indices.empty();
    for (const std::int32_t i : mesh.indices)
      good &= i >= 0 && static_cast<std::size_t>(i) < mesh.positions.size() / 3;
    for (const float x : mesh.positions) good &= std::isfinite(x);
    good &= mesh.normals.empty() || mesh.normals.size() == mesh.positions.size();
    CHECK(good);
  };
  for (std::size_t size = 0; size < bytes.size(); ++size) survive(bytes.substr(0, size));
  std::mt19937 random(1);
  for (int i = 0; i < 2000; ++i) {
    std::string damaged = bytes;
    for (int k = 0; k <= i % 4; ++k) {
      const std::size_t at = random() % damaged.size();
      damaged[at] =
          static_cast<char>(i % 2 == 0 ? random() : "0123456789-./ \n\\#efnv"[random() % 21]);
    }
    survive(damaged);
  }
}

}  // namespace

TEST_CASE("mesh files are known by their extension") {
  CHECK(is_mesh_file("a/b.obj"));
  CHECK(is_mesh_file("b.OBJ"));
  CHECK(is_mesh_file("b.Ply"));
  CHECK_FALSE(is_mesh_file("b.stl"));
  CHECK_FALSE(is_mesh_file("obj"));
  CHECK_FALSE(is_mesh_file(""));
  check_error(read("mesh.stl", "solid"), "expected .obj or .ply");
}

TEST_CASE("files that cannot be read") {
  const TempFolder folder;
  const auto error_of = [](const std::string &path) {
    Diagnostics diagnostics;
    CHECK(read_mesh_file(path, "", diagnostics).indices.empty());
    REQUIRE(diagnostics.has_errors());
    return diagnostics.errors()[0].text();
  };
  CHECK(error_of((folder.path / "missing.obj").string()).find("no such file") != std::string::npos);
  fs::create_directory(folder.path / "folder.ply");
  CHECK(error_of((folder.path / "folder.ply").string()).find("not a regular file") !=
        std::string::npos);
  CHECK(error_of(std::string("a\0b.obj", 7)).find("zero byte") != std::string::npos);
}

// ---- OBJ --------------------------------------------------------------------------------------

TEST_CASE("OBJ: triangles, polygons and upper case") {
  const Result triangle = read("MESH.OBJ", kSquare + "f 1 2 3\n");
  CHECK(triangle.mesh.indices == Ints{0, 1, 2});
  CHECK(triangle.mesh.positions == Floats{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});
  CHECK(triangle.mesh.normals.empty());
  CHECK(read_obj_text(kSquare + "f 1 2 3 4\n").mesh.indices == Ints{0, 1, 2, 0, 2, 3});
  // Faces may come before their vertices.
  CHECK(read_obj_text("f 1 2 3\n" + kSquare).mesh.indices == Ints{0, 1, 2});
}

TEST_CASE("OBJ: negative indices count from the last vertex so far") {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf -3 -2 -1\nv 0 1 0\nf -4 -2 -1\n";
  CHECK(read_obj_text(text).mesh.indices == Ints{0, 1, 2, 0, 2, 3});
}

TEST_CASE("OBJ: vertices are repeated for every normal they have") {
  const std::string normals = "vn 0 0 1\nvn 0 1 0\nvt 0 0\n";
  const MeshData mesh =
      read_obj_text(kSquare + normals + "f 1//1 2//1 3//1\nf 1/1/2 3/1/1 4/1/2\n").mesh;
  CHECK(mesh.indices == Ints{0, 1, 2, 3, 2, 4});
  CHECK(mesh.positions == Floats{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1, 0});
  CHECK(mesh.normals == Floats{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1, 0});
  // Normals at some corners only: none are used, and the user is told.
  const Result partial = read_obj_text(kSquare + normals + "f 1//1 2//1 3//1\nf 1 3 4\n");
  CHECK(partial.mesh.normals.empty());
  CHECK(partial.warning.find("only some corners have normals") != std::string::npos);
  CHECK(read_obj_text(kSquare + normals + "f 1//-2 2//-2 3//-1\n").mesh.normals ==
        Floats{0, 0, 1, 0, 0, 1, 0, 1, 0});
}

TEST_CASE("OBJ: spellings") {
  const Ints expected = {0, 1, 2};
  for (const std::string face :
       {"f 1/ 2/ 3/", "f 1// 2// 3//", "f 1/1 2/1 3/1", "f 1/1/ 2/1/ 3/1/", "  f\t1  2\t3  ",
        "f 1 2 3 # comment", "f 1 2 \\\n3", "f 1 2 \\\r\n 3"}) {
    INFO(face);
    CHECK(read_obj_text(kSquare + face).mesh.indices == expected);
    CHECK(read_obj_text(kSquare + face + "\n").mesh.indices == expected);
  }
  const std::string names =
      "# comment\nmtllib missing.mtl\no thing\ng a f 1 2\nusemtl none\ns off\n";
  CHECK(read_obj_text(names + kSquare + "vp 0.5\nl 1 2\np 1\nf 1 2 3\n").mesh.indices == expected);
  std::string crlf, cr;
  for (const char c : kSquare + "f 1 2 3\n") {
    crlf += c == '\n' ? "\r\n" : std::string(1, c);
    cr += c == '\n' ? '\r' : c;
  }
  CHECK(read_obj_text(crlf).mesh.indices == expected);
  CHECK(read_obj_text(cr).mesh.indices == expected);
  CHECK(read_obj_text("\xEF\xBB\xBF" + kSquare + "f 1 2 3\n").mesh.indices == expected);
  // A fourth number, colours, signs and exponents.
  const MeshData mesh =
      read_obj_text("v +1 -.5 2.5e-1 1\nv 1 0 0 nan nan nan\nv 1e2 1.E1 0 x\nf 1 2 3\n").mesh;
  CHECK(mesh.positions == Floats{1, -0.5f, 0.25f, 1, 0, 0, 100, 10, 0});
}

TEST_CASE("OBJ: faults name the line and the element") {
  const struct {
    std::string text;
    int line;
    const char *expected;
  } cases[] = {
      {"", 0, "no triangles"},
      {"# only a comment\n", 0, "no triangles"},
      {kSquare, 0, "no triangles"},
      {kSquare + "l 1 2\np 3\n", 0, "no triangles"},
      {kSquare + "f 1 2\n", 0, "no triangles"},
      {kSquare + "f 1 2 3\nf 1 2 5\n", 6, "face 2: vertex 5 does not exist, the file has 4"},
      {kSquare + "f 1 2\nf 1 2 5\n", 6, "face 2: vertex 5 does not exist"},
      {kSquare + "f 1 2 3 9\n", 5, "face 1: vertex 9 does not exist"},
      {kSquare + "f 1 2 3 4 9\n", 5, "face 1: vertex 9 does not exist"},
      {kSquare + "f 1 2 -5\n", 5, "face 1: vertex 0 does not exist"},
      {kSquare + "f 1 2 0\n", 5, "face 1: '0' is not a corner"},
      {kSquare + "f 1 2 4294967297\n", 5, "face 1: '4294967297' is not a corner"},
      {kSquare + "f 1 2 -2147483648\n", 5, "face 1: vertex"},
      {kSquare + "f 1 2 2147483647\n", 5, "face 1: vertex 2147483647 does not exist"},
      {kSquare + "f 1 2 x\n", 5, "face 1: 'x' is not a corner"},
      {kSquare + "f 1 2 3.5\n", 5, "is not a corner"},
      {kSquare + "f 1 2 3/1/1/1\n", 5, "is not a corner"},
      {kSquare + "f 1//1 2//1 3//1\n", 5, "face 1: normal 1 does not exist, the file has 0"},
      {"v 0 0 0\nv 1 nan 0\n", 2, "vertex 2: 'nan' is not a finite"},
      {"v inf 0 0\n", 1, "vertex 1: 'inf' is not a finite"},
      {"v 0 -1e39 0\n", 1, "vertex 1: '-1e39' is not a finite"},
      {"v 0 1e99999999999 0\n", 1, "is not a finite"},
      {"v 0 1,5 0\n", 1, "vertex 1: '1,5' is not a number"},
      {"v 0 0x10 0\n", 1, "is not a number"},
      {"v 0 +-1 0\n", 1, "is not a number"},
      {"v 0 1.#IND 0\n", 1, "is not a number"},
      {"v 1 2\n", 1, "vertex 1: 2 numbers, expected 3"},
      {"v\n", 1, "vertex 1: 0 numbers, expected 3"},
      {"\\\n\\\nv 1 2\n", 1, "vertex 1: 2 numbers"},
      {"v 0 0 0 \\\n1\nv 1 2\n", 3, "vertex 2: 2 numbers"},
      {kSquare + "vn 0 nan 1\n", 5, "normal 1: 'nan' is not a finite"},
      {std::string("v 0 0\0 0\n", 9), 0, "zero byte"},
  };
  for (const auto &c : cases) {
    const Result result = read_obj_text(c.text);
    INFO(c.text);
    check_error(result, c.expected);
    CHECK(result.line == c.line);
  }
  CHECK(read_obj_text(kSquare + "f 1 2\nf 1 2 3\n").warning.find("1 faces with fewer") !=
        std::string::npos);
}

TEST_CASE("OBJ: damaged files do not crash") {
  torture("mesh.obj", "# test\n" + kSquare +
                          "vn 0 0 1\nvt 0 0\nf 1/1/1 2/1/1 3//1 -1//-1\nf 1//1 2//1 \\\n 3//1\n");
}

// ---- PLY --------------------------------------------------------------------------------------

TEST_CASE("PLY: text") {
  CHECK(read_ply_text(kPlyTriangle).mesh.indices == Ints{0, 1, 2});
  CHECK(read_ply_text(kPlyTriangle).mesh.positions == Floats{0, 0, 0, 1, 0, 0, 0, 1, 0});
  // No end of the last line; empty lines; other line ends.
  CHECK(read_ply_text(kPlyTriangle.substr(0, kPlyTriangle.size() - 1)).error.empty());
  CHECK(read_ply_text(replaced(kPlyTriangle, "1 0 0\n", "\n \n1 0 0\n")).error.empty());
  std::string crlf, cr;
  for (const char c : kPlyTriangle) {
    crlf += c == '\n' ? "\r\n" : std::string(1, c);
    cr += c == '\n' ? '\r' : c;
  }
  CHECK(read_ply_text(crlf).mesh.indices == Ints{0, 1, 2});
  CHECK(read_ply_text(cr).mesh.indices == Ints{0, 1, 2});
}

TEST_CASE("PLY: normals, other properties and elements in text") {
  const std::string text =
      "ply\nformat ascii 1.0\nelement edge 2\nproperty list uchar int ends\n"
      "element vertex 3\nproperty float nx\nproperty double x\nproperty float y\n"
      "property float ny\nproperty float z\nproperty uchar red\nproperty float nz\n"
      "element face 2\nproperty list uchar uint vertex_indices\nproperty list uchar float uv\n"
      "element tail 1\nproperty float t\nend_header\n"
      "2 0 1\n0\n"
      "0 0 0 0 0 255 1\n0 1 0 0 0 255 1\n0 0 1 1 0 nan 0\n"
      "3 0 1 2 2 0.5 0.5\n3 2 1 0 0\n"
      "nan\n";
  const Result result = read_ply_text(replaced(text, "255 1\n0 0 1 1 0 nan", "255 1\n0 0 1 1 0 7"));
  CHECK(result.error.empty());
  CHECK(result.warning.empty());
  CHECK(result.mesh.indices == Ints{0, 1, 2, 2, 1, 0});
  CHECK(result.mesh.positions == Floats{0, 0, 0, 1, 0, 0, 0, 1, 0});
  CHECK(result.mesh.normals == Floats{0, 0, 1, 0, 0, 1, 0, 1, 0});
  // Two of three normal components are no normals.
  CHECK(read_ply_text(replaced(text, "float nz", "float other")).mesh.normals.empty());
}

TEST_CASE("PLY: binary of both byte orders, with much to step over") {
  for (const Order order : {Order::kLittle, Order::kBig}) {
    const Result result = read_ply_text(busy_binary_square(order));
    CHECK(result.error == "");
    CHECK(result.warning == "");
    CHECK(result.mesh.positions == Floats{0, 0, -3, 1, 0, -3, 1, 1, -3, 0, 1, -3});
    CHECK(result.mesh.indices == Ints{0, 1, 2, 0, 2, 3});
    check_error(read_ply_text(busy_binary_square(order).substr(0, 600)), "truncated");
    CHECK(read_ply_text(busy_binary_square(order) + "more").warning.find("4 bytes after") !=
          std::string::npos);
  }
}

TEST_CASE("PLY: all types, in text and binary") {
  for (const std::string name :
       {"char", "uchar", "short", "ushort", "int", "uint", "float", "double", "int8", "uint8",
        "int16", "uint16", "int32", "uint32", "float32", "float64"}) {
    INFO(name);
    const std::string vertices = "element vertex 3\nproperty " + name + " x\nproperty " + name +
                                 " y\nproperty " + name + " z\n";
    const std::string text = "ply\nformat ascii 1.0\n" + vertices + kPlyFaces +
                             "end_header\n0 0 0\n100 0 0\n0 100 0\n3 0 1 2\n";
    CHECK(read_ply_text(text).mesh.positions == Floats{0, 0, 0, 100, 0, 0, 0, 100, 0});
    for (const Order order : {Order::kLittle, Order::kBig}) {
      std::string bytes =
          "ply\nformat " +
          std::string(order == Order::kLittle ? "binary_little_endian" : "binary_big_endian") +
          " 1.0\n" + vertices + kPlyFaces + "end_header\n";
      for (const int x : {0, 0, 0, 100, 0, 0, 0, 100, 0}) {
        if (name == "float" || name == "float32")
          put<float>(bytes, static_cast<float>(x), order);
        else if (name == "double" || name == "float64")
          put<double>(bytes, x, order);
        else if (name.find("16") != name.npos || name.find("short") != name.npos)
          put<std::int16_t>(bytes, static_cast<std::int16_t>(x), order);
        else if (name.find('8') != name.npos || name.find("char") != name.npos)
          put<std::int8_t>(bytes, static_cast<std::int8_t>(x), order);
        else
          put<std::int32_t>(bytes, x, order);
      }
      put<std::uint8_t>(bytes, 3, order);
      for (const int i : {0, 1, 2}) put<std::int32_t>(bytes, i, order);
      CHECK(read_ply_text(bytes).mesh.positions == Floats{0, 0, 0, 100, 0, 0, 0, 100, 0});
    }
  }
}

TEST_CASE("PLY: rows with more numbers than declared are read, with a warning") {
  const Result result = read_ply_text(replaced(kPlyTriangle, "3 0 1 2", "3 0 1 2 9 9"));
  CHECK(result.mesh.indices == Ints{0, 1, 2});
  CHECK(result.warning.find(":13: 1 rows have more numbers") != std::string::npos);
}

TEST_CASE("PLY: faults in the header") {
  const struct {
    const char *from, *to, *expected;
  } cases[] = {
      {"ply\n", "PLY\n", "the first line must be 'ply'"},
      {"ply\n", "", "the first line must be 'ply'"},
      {"format ascii 1.0", "format ascii 2.0", "version 1.0"},
      {"format ascii 1.0", "format text 1.0", "unknown format 'text'"},
      {"format ascii 1.0\n", "", "no format"},
      {"element vertex 3", "element vertex -3", "is not a number of elements"},
      {"element vertex 3", "element vertex 3x", "is not a number of elements"},
      {"element vertex 3", "element vertex 99999999999999999999", "is not a number of elements"},
      {"element vertex 3", "element vertex", "expected 'element NAME COUNT'"},
      {"element vertex 3", "element vertex 4000000000",
       "the header promises 4000000000 x 'vertex'"},
      {"element vertex 3", "element vertex 9223372036854775807", "the header promises"},
      {"element face 1", "element face 100000000", "the header promises 100000000 x 'face'"},
      {"element face 1", "element vertex 1", "comes twice"},
      {"float y", "float x", "property 'x' comes twice"},
      {"float y", "real y", "unknown type 'real'"},
      {"float y", "float", "expected 'property TYPE NAME'"},
      {"float y", "float w", "has no property 'y'"},
      {"float y", "list uchar float y", "has no property 'y'"},
      {"list uchar int", "list float int", "whole-number type"},
      {"list uchar int vertex_indices", "int vertex_indices", "has no list 'vertex_indices'"},
      {"vertex_indices", "corners", "has no list 'vertex_indices'"},
      {"element vertex 3\n", "", "a property before the first element"},
      {"end_header\n", "", "unknown header line"},
      {"end_header", "nonsense", "unknown header line 'nonsense'"},
  };
  for (const auto &c : cases) {
    INFO(std::string(c.from), " -> ", std::string(c.to));
    check_error(read_ply_text(replaced(kPlyTriangle, c.from, c.to)), c.expected);
  }
  check_error(read_ply_text(""), "the first line must be 'ply'");
  check_error(read_ply_text("ply\nformat ascii 1.0\n"), "no 'end_header' line");
  check_error(read_ply_text("ply\ncomment " + std::string(100000, 'x') + "\nend_header\n"),
              "no 'end_header' line");
  check_error(read_ply_text("ply\nformat ascii 1.0\n" + kPlyFaces + kPlyVertices +
                            "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n"),
              "'face' comes before element 'vertex'");
  check_error(read_ply_text("ply\nformat ascii 1.0\nend_header\n"), "no triangles");
}

TEST_CASE("PLY: faults in the rows name line and element") {
  const struct {
    const char *from, *to, *expected;
    int line;
  } cases[] = {
      {"1 0 0", "1 nan 0", "vertex 1: y is not a finite", 11},
      {"1 0 0", "1 0 -inf", "vertex 1: z is not a finite", 11},
      {"1 0 0", "1 1e39 0", "vertex 1: y is not a finite", 11},
      {"1 0 0", "1 1,5 0", "vertex 1: this is not a number", 11},
      {"1 0 0", "1 0", "vertex 1: fewer numbers than the header declares", 11},
      {"3 0 1 2", "3 0 1 3", "face 0: a corner refers to a vertex that does not exist", 13},
      {"3 0 1 2", "3 0 1 -1", "face 0: a corner refers to a vertex that does not exist", 13},
      {"3 0 1 2", "3 0 1 1.5", "face 0: a corner refers to a vertex that does not exist", 13},
      {"3 0 1 2", "3 0 1 nan", "face 0: a corner refers to a vertex that does not exist", 13},
      {"3 0 1 2", "3 0 1 99999999999", "face 0: a corner refers", 13},
      {"3 0 1 2", "4 0 1 2", "face 0: fewer numbers", 13},
      {"3 0 1 2\n", "3 0 1", "face 0: the file ends here: truncated?", 13},
      {"3 0 1 2", "2.5 0 1", "not a whole number", 13},
      {"3 0 1 2", "-3 0 1 2", "not a whole number", 13},
      {"3 0 1 2", "4000000000 0 1", "longer than the file", 13},
      {"3 0 1 2", "2 0 1", "no triangles", 0},
      {"3 0 1 2\n", "\n\n\n\n", "face 0: the file ends here", 17},
  };
  for (const auto &c : cases) {
    INFO(std::string(c.from), " -> ", std::string(c.to));
    const Result result = read_ply_text(replaced(kPlyTriangle, c.from, c.to));
    check_error(result, c.expected);
    CHECK(result.line == c.line);
  }
}

TEST_CASE("PLY: damaged files do not crash") {
  torture("mesh.ply", kPlyTriangle);
  torture("mesh.ply", busy_binary_square(Order::kLittle));
  torture("mesh.ply", busy_binary_square(Order::kBig));
}

// ---- polygons ---------------------------------------------------------------------------------

TEST_CASE("polygons are split into triangles of the same sense that cover them") {
  const std::vector<Floats> polygons = {
      {0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0},                    // rectangle
      {0, 0, 0, 4, 0, 0, 0.5f, 0.5f, 0, 0, 4, 0},              // arrowhead
      {0, 0, 0, 3, 0, 0, 3, 1, 0, 1, 1, 0, 1, 3, 0, 0, 3, 0},  // L
      {0, 0, 0, 1, 0, 0, 2, 0, 0, 2, 1, 0, 2, 2, 0, 0, 2, 0},  // collinear corners
      {0, 0, 0, 5, 0, 0, 5, 3, 0, 4, 3, 0, 4, 1, 0, 3, 1, 0,
       3, 3, 0, 2, 3, 0, 2, 1, 0, 1, 1, 0, 1, 3, 0, 0, 3, 0}};  // comb
  for (const Floats &positions : polygons) {
    const std::size_t n = positions.size() / 3;
    for (std::size_t shift = 0; shift < n; ++shift) {
      Ints corners;
      for (std::size_t i = 0; i < n; ++i)
        corners.push_back(static_cast<std::int32_t>((i + shift) % n));
      double expected = 0;
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t j = (i + 1) % n;
        expected += 0.5 * static_cast<double>(positions[i * 3] * positions[j * 3 + 1] -
                                              positions[j * 3] * positions[i * 3 + 1]);
      }
      Ints triangles;
      CHECK(triangulate_polygon(positions, corners, triangles));
      CHECK(triangles.size() == (n - 2) * 3);
      double area = 0;
      Ints vertices;
      for (const std::int32_t c : triangles)
        vertices.push_back(corners[static_cast<std::size_t>(c)]);
      for (std::size_t t = 0; t < n - 2; ++t) {
        const double a = signed_area(positions, vertices, t);
        CHECK(a >= 0);
        area += a;
      }
      CHECK(area == doctest::Approx(expected));
    }
  }
}

TEST_CASE("a quadrilateral is split along its shorter diagonal") {
  const Floats kite = {0, 0, 0, 2, -1, 0, 4, 0, 0, 2, 1, 0};
  Ints triangles;
  triangulate_polygon(kite, {0, 1, 2, 3}, triangles);
  CHECK(triangles == Ints{0, 1, 3, 1, 2, 3});
}

TEST_CASE("odd polygons give triangles and no crash") {
  const auto count = [](const Floats &positions, const Ints &corners) {
    Ints triangles;
    triangulate_polygon(positions, corners, triangles);
    for (const std::int32_t c : triangles)
      CHECK((c >= 0 && c < static_cast<std::int32_t>(corners.size())));
    return triangles.size() / 3;
  };
  const Floats square = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  CHECK(count(square, {}) == 0);
  CHECK(count(square, {0, 1}) == 0);
  CHECK(count(square, {0, 0, 0, 0, 0}) == 3);  // a point
  CHECK(count(square, {0, 1, 0, 1}) == 2);     // a line
  CHECK(count(square, {0, 2, 1, 3}) == 2);     // crosses itself
  Floats pentagram;
  for (int i = 0; i < 5; ++i) {
    const double angle = i * 4 * 3.141592653589793 / 5;
    pentagram.insert(pentagram.end(), {static_cast<float>(std::cos(angle)),
                                       static_cast<float>(std::sin(angle)), 0.0f});
  }
  CHECK(count(pentagram, {0, 1, 2, 3, 4}) == 3);
  Floats comb;  // too many corners for ear clipping: a fan, and the caller is told
  Ints corners;
  for (int i = 0; i < 3000; ++i) {
    comb.insert(comb.end(), {static_cast<float>(i), i % 2 == 0 ? 0.0f : 1.0f, 0.0f});
    corners.push_back(i);
  }
  Ints triangles;
  CHECK_FALSE(triangulate_polygon(comb, corners, triangles));
  CHECK(triangles.size() == 2998 * 3);
}

// ---- files from elsewhere ---------------------------------------------------------------------

#ifdef PHALANX_SOURCE_DIR
TEST_CASE("shared meshes load or are refused with a reason") {
  const fs::path folder = fs::path(PHALANX_SOURCE_DIR) / ".." / "shared" / "scenes" / "meshes";
  if (!fs::exists(folder)) {
    MESSAGE("skipped: there is no folder ../shared/scenes/meshes");
    return;
  }
  int num_loaded = 0;
  for (const auto &entry : fs::recursive_directory_iterator(folder)) {
    if (!is_mesh_file(entry.path().string())) continue;
    Diagnostics diagnostics;
    const MeshData mesh = read_mesh_file(entry.path().string(), "", diagnostics);
    INFO(entry.path().string());
    CHECK(diagnostics.has_errors() == mesh.indices.empty());
    num_loaded += mesh.indices.empty() ? 0 : 1;
  }
  MESSAGE(num_loaded, " meshes loaded");
  CHECK(num_loaded > 0);
}
#endif
