// Which columns a wave has: the one list behind what is allocated and what `phalanx plan` prints.
#pragma once
#include <vector>

#include "../../kernels/path_view.h"
#include "plan.h"

namespace phalanx {

/// Every column of a WaveView once: where it is, what group it belongs to, whether it exists. All
/// elements are four bytes. visit(name, exists, columns...).
template <typename Visit>
void for_each_column(const Plan &plan, WaveView &w, const Visit &visit) {
  visit("ray", true, w.origin_x, w.origin_y, w.origin_z, w.direction_x, w.direction_y,
        w.direction_z);
  visit("throughput, pdf", true, w.throughput_r, w.throughput_g, w.throughput_b, w.pdf);
  visit("depth, sampler, sample", true, w.depth, w.scramble, w.block_index);
  visit("hit", true, w.hit_geometry, w.hit_primitive, w.hit_kind);
  visit("sphere root", plan.spheres, w.hit_far_root);
  visit("instance", plan.instances, w.hit_instance);
  visit("resolved material", plan.blends, w.hit_material);
  visit("place on curve", plan.curves, w.hit_u);
  visit("shadow ray", plan.sample_lights, w.shadow_origin_x, w.shadow_origin_y, w.shadow_origin_z,
        w.shadow_direction_x, w.shadow_direction_y, w.shadow_direction_z, w.shadow_distance,
        w.shadow_r, w.shadow_g, w.shadow_b);
  visit("lists", true, w.active, w.free, w.order);
  visit("shadow list", plan.sample_lights, w.shadow_list);
}

/// The columns that exist, with the bytes that each costs a path.
inline std::vector<Column> wave_columns(const Plan &plan) {
  std::vector<Column> result;
  WaveView view = {};
  for_each_column(plan, view, [&](const char *name, bool exists, auto *&...columns) {
    if (exists) result.push_back({name, static_cast<int>(4 * sizeof...(columns))});
  });
  return result;
}

}  // namespace phalanx
