// The one list of everything that a scene consists of: for sending it, and for telling scenes apart.
#pragma once
#include <cstdint>

#include "scene.h"

namespace phalanx {

/// Calls array(vector) for every array of a scene and value(x) for everything else that rendering reads,
/// always in the same order. S is Scene or const Scene.
template <typename S, typename Array, typename Value>
void visit_scene(S &s, Array array, Value value) {
  array(s.materials), array(s.geometries), array(s.num_prims), array(s.positions);
  array(s.vertex_normals), array(s.vertex_uvs), array(s.vertex_colours), array(s.triangles);
  array(s.quads), array(s.spheres), array(s.disks), array(s.curve_points), array(s.curve_along);
  array(s.curve_segments), array(s.instances), array(s.motions), array(s.instance_group);
  array(s.groups), array(s.textures), array(s.byte_texels), array(s.float_texels);
  array(s.decode), array(s.lights), array(s.alias_threshold), array(s.alias_other);
  array(s.tables), array(s.profiles), array(s.light_nodes), array(s.environment_texels);
  array(s.environment_rows), array(s.environment_columns);
  value(s.top_level), value(s.num_infinite_lights), value(s.infinite_share);
  value(s.environment_width), value(s.environment_height), value(s.environment_x);
  value(s.environment_y), value(s.environment_z), value(s.has_environment), value(s.environment);
  value(s.bounds_lo), value(s.bounds_hi), value(s.num_dropped);
}

/// The same for the same arrays with the same contents.
std::uint64_t scene_fingerprint(const Scene &scene);

}  // namespace phalanx
