#include "mesh_io.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "mesh_readers.h"

namespace phalanx {
namespace {

std::string lower_extension(const std::string &path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// The file's bytes; an empty reason means success.
std::string read_bytes(const std::string &path, std::string &reason) {
  if (path.find('\0') != std::string::npos) {
    reason = "the file name contains a zero byte";
    return {};
  }
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    reason = "no such file";
    return {};
  }
  if (!std::filesystem::is_regular_file(status)) {
    reason = "not a regular file";
    return {};
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (error || !file) {
    reason = "cannot open the file for reading";
    return {};
  }
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (static_cast<std::uintmax_t>(file.gcount()) != size)
    reason = "the file ended while it was read";
  return bytes;
}

Problem problem_in(const MeshSource &source, int line, const std::string &message) {
  Problem problem;
  problem.file = source.path;
  problem.line = line;
  problem.message = message;
  if (!source.shape_origin.empty()) problem.message += " (mesh of " + source.shape_origin + ")";
  return problem;
}

}  // namespace

void MeshSource::warn(int line, const std::string &message) const {
  diagnostics.warn(problem_in(*this, line, message));
}

MeshData MeshSource::fail(int line, const std::string &message) const {
  diagnostics.error(problem_in(*this, line, message));
  return {};
}

bool is_mesh_file(const std::string &path) {
  const std::string extension = lower_extension(path);
  return extension == ".obj" || extension == ".ply";
}

MeshData read_mesh_file(const std::string &path, const std::string &shape_origin,
                        Diagnostics &diagnostics, MeshNeeds needs) {
  const MeshSource source{path, shape_origin, diagnostics, needs};
  if (!is_mesh_file(path))
    return source.fail(0, "unknown kind of mesh file: expected .obj or .ply");
  std::string reason;
  std::string bytes = read_bytes(path, reason);
  if (!reason.empty()) return source.fail(0, reason);
  return lower_extension(path) == ".obj" ? read_obj(std::move(bytes), source)
                                         : read_ply(bytes, source);
}

}  // namespace phalanx
