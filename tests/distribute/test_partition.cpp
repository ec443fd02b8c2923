// Every pixel belongs to one rank, whatever the numbers.
#include "distribute/partition.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <random>

using namespace phalanx;

namespace {

const Rect kCrops[] = {{0, 0, 1, 1},   {5, 7, 1, 37},    {0, 0, 37, 1},   {3, 2, 3, 5},
                       {0, 0, 31, 17}, {10, 20, 97, 89}, {0, 0, 128, 64}, {65000, 65000, 13, 11}};
const int kRanks[] = {1, 2, 3, 4, 5, 7, 13, 64, 101};

/// How many rectangles hold each pixel: all must be 1.
bool covers_once(Rect crop, const std::vector<Rect> &parts) {
  std::vector<int> count(static_cast<std::size_t>(crop.width * crop.height), 0);
  for (const Rect &p : parts) {
    if (p.width < 0 || p.height < 0) return false;
    for (int y = p.y; y < p.y + p.height; ++y)
      for (int x = p.x; x < p.x + p.width; ++x) {
        if (x < crop.x || y < crop.y || x >= crop.x + crop.width || y >= crop.y + crop.height)
          return false;
        ++count[static_cast<std::size_t>((y - crop.y) * crop.width + x - crop.x)];
      }
  }
  return std::all_of(count.begin(), count.end(), [](int n) { return n == 1; });
}

CostMap random_map(Rect crop, int seed) {
  CostMap map(crop, 16);
  std::mt19937 random(static_cast<unsigned>(seed));
  std::exponential_distribution<double> cost(1.0);
  for (double &s : map.seconds) s = cost(random);
  return map;
}

int area(Rect r) { return r.width * r.height; }

}  // namespace

TEST_CASE("partition: every strategy covers every pixel once") {
  for (const Rect &crop : kCrops)
    for (const int ranks : kRanks) {
      CAPTURE(crop.width);
      CAPTURE(crop.height);
      CAPTURE(ranks);
      std::vector<int> shares(static_cast<std::size_t>(ranks), 1);
      for (const bool even : {true, false}) {
        if (!even)
          for (std::size_t i = 0; i < shares.size(); ++i) shares[i] = 1 + static_cast<int>(i % 4);
        const Rect box = {crop.x + crop.width / 3, crop.y + crop.height / 3, crop.width / 2,
                          crop.height / 2};
        for (const auto &parts :
             {split_rows(crop, shares), split_columns(crop, shares), split_grid(crop, shares),
              split_bbox(crop, box, shares), split_bbox(crop, {0, 0, 0, 0}, shares),
              split_cost(random_map(crop, ranks), shares), split_cost(CostMap(crop, 16), shares)}) {
          CHECK(parts.size() == shares.size());
          CHECK(covers_once(crop, parts));
        }
      }
    }
}

TEST_CASE("partition: tiles cover a region once and are no larger than asked") {
  for (const Rect &crop : kCrops)
    for (const int size : {1, 8, 32}) {
      const std::vector<Rect> tiles = tiles_of(crop, size);
      CHECK(covers_once(crop, tiles));
      for (const Rect &t : tiles) CHECK(std::max(t.width, t.height) <= size);
    }
  CHECK(tiles_of({3, 3, 0, 5}, 8).empty());
  CHECK(tiles_of({3, 3, 5, 0}, 8).empty());
}

TEST_CASE("partition: no pixel is left over: rows differ by one at most") {
  const std::vector<Rect> parts = split_rows({0, 0, 10, 101}, std::vector<int>(7, 1));
  for (const Rect &p : parts) {
    CHECK(p.height >= 14);
    CHECK(p.height <= 15);
  }
}

TEST_CASE("partition: shares are heeded") {
  const std::vector<Rect> rows = split_rows({0, 0, 10, 100}, {1, 3});
  CHECK(rows[0].height == 25);
  const std::vector<Rect> grid = split_grid({0, 0, 100, 100}, {1, 1, 1, 1});
  for (const Rect &p : grid) CHECK(area(p) == 2500);
}

TEST_CASE("partition: bbox gives all ranks the same number of pixels within the box") {
  const Rect crop = {0, 0, 64, 100}, box = {10, 40, 20, 40};
  for (const Rect &p : split_bbox(crop, box, std::vector<int>(4, 1)))
    CHECK(area(intersection(p, box)) == 200);
}

TEST_CASE("partition: cost gives all ranks nearly the same cost where rows do not") {
  const Rect crop = {0, 0, 256, 256};
  CostMap map(crop, 16);
  map.add(crop, 1.0);
  map.add({0, 0, 64, 32}, 20.0);  // a corner that takes almost everything
  for (const int ranks : {2, 3, 5, 8}) {
    const std::vector<int> shares(static_cast<std::size_t>(ranks), 1);
    const double mean = map.cost_of(crop) / ranks;
    double worst_cost = 0, worst_rows = 0;
    for (const Rect &p : split_cost(map, shares)) worst_cost = std::max(worst_cost, map.cost_of(p));
    for (const Rect &p : split_rows(crop, shares)) worst_rows = std::max(worst_rows, map.cost_of(p));
    CAPTURE(ranks);
    CHECK(worst_cost / mean < 1.15);
    CHECK(worst_rows / mean > 1.4);
  }
}

TEST_CASE("partition: a cost map keeps what is added to it") {
  CostMap map({5, 6, 50, 41}, 16);
  map.add({7, 9, 20, 13}, 2.5);
  map.add({5, 6, 50, 41}, 1.0);
  CHECK(map.cost_of({5, 6, 50, 41}) == doctest::Approx(3.5));
  CHECK(map.cost_of({5, 6, 0, 41}) == 0);
}

TEST_CASE("partition: names") {
  for (const char *name : {"rows", "columns", "grid", "bbox", "cost", "dynamic"}) {
    REQUIRE(balance_from_name(name));
    CHECK(std::string(balance_name(*balance_from_name(name))) == name);
  }
  CHECK_FALSE(balance_from_name("fair"));
}
