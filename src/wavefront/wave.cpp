#include "wave.h"

#include <algorithm>

namespace phalanx {
namespace {

constexpr std::size_t kWidestGang = 16;

/// Every column of a WaveView once: where it is, what group it belongs to, whether it exists. All
/// elements are four bytes. This list is what is allocated, and what `phalanx plan` prints.
template <typename Visit>
void for_each_column(const Plan &plan, WaveView &w, const Visit &visit) {
  visit("ray", true, w.origin_x, w.origin_y, w.origin_z, w.direction_x, w.direction_y,
        w.direction_z);
  visit("throughput, pdf", true, w.throughput_r, w.throughput_g, w.throughput_b, w.pdf);
  visit("depth, sampler, sample", true, w.depth, w.scramble, w.block_index);
  visit("hit", true, w.hit_geometry, w.hit_primitive);
  visit("sphere root", plan.spheres, w.hit_far_root);
  visit("instance", plan.instances, w.hit_instance);
  visit("shadow ray", plan.sample_lights, w.shadow_origin_x, w.shadow_origin_y, w.shadow_origin_z,
        w.shadow_direction_x, w.shadow_direction_y, w.shadow_direction_z, w.shadow_distance,
        w.shadow_r, w.shadow_g, w.shadow_b);
  visit("lists", true, w.active, w.free, w.order);
  visit("shadow list", plan.sample_lights, w.shadow_list);
}

std::size_t column_elements(const Plan &plan, bool exists) {
  return exists ? round_up(static_cast<std::size_t>(plan.wave_size), kWidestGang) : kWidestGang;
}

std::size_t wave_allocation(const Plan &plan) {
  std::size_t bytes = 0;
  WaveView view = {};
  for_each_column(plan, view, [&](const char *, bool exists, auto *&...columns) {
    bytes += sizeof...(columns) * round_up(4 * column_elements(plan, exists), kCacheLine);
  });
  return bytes;
}

}  // namespace

std::vector<Column> wave_columns(const Plan &plan) {
  std::vector<Column> result;
  WaveView view = {};
  for_each_column(plan, view, [&](const char *name, bool exists, auto *&...columns) {
    if (exists) result.push_back({name, static_cast<int>(4 * sizeof...(columns))});
  });
  return result;
}

Wave::Wave(const Plan &plan) : arena_(wave_allocation(plan)) {
  view_.capacity = plan.wave_size;
  for_each_column(plan, view_, [&](const char *, bool exists, auto *&...columns) {
    const std::size_t n = column_elements(plan, exists);
    ((columns = arena_.take<std::remove_reference_t<decltype(*columns)>>(n)), ...);
  });
  clear();
}

void Wave::clear() { std::fill_n(view_.depth, view_.capacity, -1); }

}  // namespace phalanx
