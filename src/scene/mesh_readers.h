// What the mesh readers share: where their messages go. Used by mesh_io.cpp and the readers only.
#pragma once
#include <cstdint>
#include <string>

#include "../core/error.h"
#include "description.h"

namespace phalanx {

/// Where a mesh comes from, and where its problems go.
struct MeshSource {
  const std::string &path;
  const std::string &shape_origin;
  Diagnostics &diagnostics;
  MeshNeeds needs = {};

  void warn(int line, const std::string &message) const;
  /// Reports the error and returns the empty mesh that the reader then returns.
  MeshData fail(int line, const std::string &message) const;
};

/// Vertices and triangles of one mesh at most: kernels address arrays with 32-bit byte offsets.
constexpr std::int64_t kMaxMeshElements = INT32_MAX / 12;

/// text: the whole file; it is changed while it is read.
MeshData read_obj(std::string text, const MeshSource &source);
/// bytes: the whole file.
MeshData read_ply(const std::string &bytes, const MeshSource &source);

}  // namespace phalanx
