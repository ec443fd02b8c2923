#include "wave.h"

#include <algorithm>

#include "../plan/columns.h"

namespace phalanx {
namespace {

constexpr std::size_t kWidestGang = 16;

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
