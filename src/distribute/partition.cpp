#include "partition.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../render/tiles.h"

namespace phalanx {
namespace {

constexpr Balance kAll[] = {Balance::kRows, Balance::kColumns, Balance::kGrid,
                            Balance::kBbox, Balance::kCost,    Balance::kDynamic};

int sum_of(const std::vector<int> &shares) {
  return std::accumulate(shares.begin(), shares.end(), 0);
}

/// Where the parts of [0, length] begin and end if part i gets shares[i] of it, to the nearest integer.
std::vector<int> cuts(int length, const std::vector<int> &shares) {
  const std::int64_t total = sum_of(shares);
  std::vector<int> at = {0};
  std::int64_t before = 0;
  for (const int share : shares) {
    before += share;
    at.push_back(static_cast<int>((2 * before * length + total) / (2 * total)));
  }
  return at;
}

/// The cut x of [0, length] where cost(x) is nearest to `wanted`; cost does not decrease.
template <typename Cost>
int cut_at(int length, double wanted, Cost cost) {
  int lo = 0, hi = length;
  while (lo < hi) {
    const int middle = (lo + hi) / 2;
    if (cost(middle) < wanted)
      lo = middle + 1;
    else
      hi = middle;
  }
  return lo > 0 && wanted - cost(lo - 1) < cost(lo) - wanted ? lo - 1 : lo;
}

Rect rows_of(Rect r, int from, int to) { return {r.x, r.y + from, r.width, to - from}; }
Rect columns_of(Rect r, int from, int to) { return {r.x + from, r.y, to - from, r.height}; }

void bisect(const CostMap &map, Rect part, const int *shares, int count, Rect *out) {
  if (count == 1) {
    *out = part;
    return;
  }
  const int half = count / 2;
  const double first = std::accumulate(shares, shares + half, 0.0);
  const double all = std::accumulate(shares, shares + count, 0.0);
  const double wanted = map.cost_of(part) * first / all;
  const bool across = part.height >= part.width;
  const int length = across ? part.height : part.width;
  const auto piece = [&](int from, int to) {
    return across ? rows_of(part, from, to) : columns_of(part, from, to);
  };
  const int cut = wanted > 0
                      ? cut_at(length, wanted, [&](int x) { return map.cost_of(piece(0, x)); })
                      : static_cast<int>(std::lround(length * first / all));
  bisect(map, piece(0, cut), shares, half, out);
  bisect(map, piece(cut, length), shares + half, count - half, out + half);
}

}  // namespace

const char *balance_name(Balance balance) {
  switch (balance) {
    case Balance::kRows: return "rows";
    case Balance::kColumns: return "columns";
    case Balance::kGrid: return "grid";
    case Balance::kBbox: return "bbox";
    case Balance::kCost: return "cost";
    case Balance::kDynamic: return "dynamic";
  }
  return "?";
}

std::optional<Balance> balance_from_name(const std::string &name) {
  for (const Balance b : kAll)
    if (name == balance_name(b)) return b;
  return std::nullopt;
}

std::vector<Rect> split_rows(Rect crop, const std::vector<int> &shares) {
  const std::vector<int> at = cuts(crop.height, shares);
  std::vector<Rect> parts;
  for (std::size_t i = 0; i < shares.size(); ++i)
    parts.push_back(rows_of(crop, at[i], at[i + 1]));
  return parts;
}

std::vector<Rect> split_columns(Rect crop, const std::vector<int> &shares) {
  const std::vector<int> at = cuts(crop.width, shares);
  std::vector<Rect> parts;
  for (std::size_t i = 0; i < shares.size(); ++i)
    parts.push_back(columns_of(crop, at[i], at[i + 1]));
  return parts;
}

std::vector<Rect> split_grid(Rect crop, const std::vector<int> &shares) {
  const auto count = static_cast<int>(shares.size());
  const double aspect = static_cast<double>(crop.height) / std::max(1, crop.width);
  const int num_rows =
      std::clamp(static_cast<int>(std::lround(std::sqrt(count * aspect))), 1, count);
  // Row r of the grid holds ranks [first_of(r), first_of(r + 1)).
  const auto first_of = [&](int r) { return static_cast<std::size_t>(r * count / num_rows); };
  std::vector<int> row_shares;
  for (int r = 0; r < num_rows; ++r)
    row_shares.push_back(std::accumulate(shares.begin() + static_cast<long>(first_of(r)),
                                         shares.begin() + static_cast<long>(first_of(r + 1)), 0));
  std::vector<Rect> parts;
  const std::vector<Rect> bands = split_rows(crop, row_shares);
  for (int r = 0; r < num_rows; ++r) {
    const std::vector<int> own(shares.begin() + static_cast<long>(first_of(r)),
                               shares.begin() + static_cast<long>(first_of(r + 1)));
    for (const Rect &part : split_columns(bands[static_cast<std::size_t>(r)], own))
      parts.push_back(part);
  }
  return parts;
}

std::vector<Rect> split_bbox(Rect crop, Rect box, const std::vector<int> &shares) {
  const Rect seen = intersection(crop, box);
  if (seen.width == 0 || seen.height == 0) return split_rows(crop, shares);
  std::vector<int> at = cuts(seen.height, shares);
  for (int &row : at) row += seen.y - crop.y;
  at.front() = 0;  // what lies outside goes to the first and the last rank
  at.back() = crop.height;
  std::vector<Rect> parts;
  for (std::size_t i = 0; i < shares.size(); ++i)
    parts.push_back(rows_of(crop, at[i], at[i + 1]));
  return parts;
}

CostMap::CostMap(Rect the_crop, int the_cell) : crop(the_crop), cell(the_cell) {
  seconds.resize(static_cast<std::size_t>(columns()) * static_cast<std::size_t>(rows()));
}

namespace {

/// Calls use(cell's index, cell's rectangle, what it shares with `part`).
template <typename Use>
void for_cells(const CostMap &map, Rect part, Use use) {
  if (part.width == 0 || part.height == 0) return;
  const int x0 = (part.x - map.crop.x) / map.cell, y0 = (part.y - map.crop.y) / map.cell;
  const int x1 = (part.x + part.width - 1 - map.crop.x) / map.cell;
  const int y1 = (part.y + part.height - 1 - map.crop.y) / map.cell;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      const Rect cell = intersection(
          map.crop, {map.crop.x + x * map.cell, map.crop.y + y * map.cell, map.cell, map.cell});
      use(static_cast<std::size_t>(y * map.columns() + x), cell, intersection(cell, part));
    }
}

double pixels(Rect r) { return static_cast<double>(r.width) * r.height; }

}  // namespace

void CostMap::add(Rect part, double cost) {
  for_cells(*this, part, [&](std::size_t i, Rect, Rect shared) {
    seconds[i] += cost * pixels(shared) / pixels(part);
  });
}

double CostMap::cost_of(Rect part) const {
  double sum = 0;
  for_cells(*this, part, [&](std::size_t i, Rect cell_rect, Rect shared) {
    sum += seconds[i] * pixels(shared) / pixels(cell_rect);
  });
  return sum;
}

std::vector<Rect> split_cost(const CostMap &map, const std::vector<int> &shares) {
  std::vector<Rect> parts(shares.size());
  bisect(map, map.crop, shares.data(), static_cast<int>(shares.size()), parts.data());
  return parts;
}

std::vector<Rect> tiles_of(Rect region, int size) {
  return region.width > 0 ? cut_tiles(region, size) : std::vector<Rect>{};
}

Rect intersection(Rect a, Rect b) {
  const int x0 = std::max(a.x, b.x), x1 = std::min(a.x + a.width, b.x + b.width);
  const int y0 = std::max(a.y, b.y), y1 = std::min(a.y + a.height, b.y + b.height);
  return {x0, y0, std::max(0, x1 - x0), std::max(0, y1 - y0)};
}

}  // namespace phalanx
