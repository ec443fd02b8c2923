// Normals of a smooth mesh from its triangles.
#pragma once
#include "description.h"

namespace phalanx {

/// Fills mesh.normals: at each vertex the sum of the normals of its triangles, weighted by area, of
/// unit length; (0, 0, 0) where the vertex has no triangle with area. All indices must be valid.
void smooth_normals(MeshData &mesh);

}  // namespace phalanx
