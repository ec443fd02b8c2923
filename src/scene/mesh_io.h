// Reads triangle meshes from files: Wavefront OBJ and Stanford PLY.
//
// A file is never trusted: counts are compared with the file's size before anything is allocated,
// indices are checked, coordinates must be finite. What is wrong becomes an error that names the
// file and the line or the element; the first one ends the reading of that file.
#pragma once
#include <string>

#include "../core/error.h"
#include "description.h"

namespace phalanx {

/// Reads the mesh in `path`, .obj or .ply by extension, upper or lower case. Polygons are split
/// into triangles (polygon.h). Normals are kept if every corner has one, texture coordinates and
/// colours if, besides, `needs` asks for them; a vertex that corners use with several normals or
/// coordinates is repeated. PLY colours of whole numbers are decoded from sRGB. Lines, points and
/// materials are ignored.
/// `shape_origin` ("scene.json: /shapes/3") says in messages who wanted the file.
/// After an error the returned mesh is empty.
MeshData read_mesh_file(const std::string &path, const std::string &shape_origin,
                        Diagnostics &diagnostics, MeshNeeds needs = {});

/// True if the extension of `path` is one that read_mesh_file() knows.
bool is_mesh_file(const std::string &path);

}  // namespace phalanx
