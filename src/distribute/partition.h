// Which rank renders which part of the picture: pure functions of the picture's size, the number of
// ranks and what is known of the cost.
//
// A static strategy gives every rank one rectangle, for good. `dynamic` gives none: ranks fetch tiles.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "../film/film.h"

namespace phalanx {

enum class Balance { kRows, kColumns, kGrid, kBbox, kCost, kDynamic };

const char *balance_name(Balance balance);  // "rows", "columns", ...
std::optional<Balance> balance_from_name(const std::string &name);

// Each of these cuts `crop` into as many rectangles as there are shares; rectangle i is for rank i. They
// cover the crop window exactly once. Where there are more ranks than pixels some are empty (width or
// height 0). Shares (>= 1) are what ranks can do in the same time: their numbers of threads.

/// Bands of whole rows, or columns, as high as shares say, to the nearest row.
std::vector<Rect> split_rows(Rect crop, const std::vector<int> &shares);
std::vector<Rect> split_columns(Rect crop, const std::vector<int> &shares);

/// Rows of bands, each cut into columns: as square as the number of ranks allows. A prime number of
/// ranks has rows of unequal length: no pixel and no rank is left over.
std::vector<Rect> split_grid(Rect crop, const std::vector<int> &shares);

/// The ancestor's heuristic, kept as a baseline: bands of rows with equal shares of the pixels within
/// `box`, the box around all surfaces as the picture shows it; pixels outside it count nothing.
std::vector<Rect> split_bbox(Rect crop, Rect box, const std::vector<int> &shares);

/// What parts of a picture cost: seconds of each cell of a grid of squares of `cell` pixels, row after
/// row, that starts at the crop window's corner; cells at the right and the bottom are cut off.
struct CostMap {
  Rect crop;
  int cell = 16;
  std::vector<double> seconds;

  CostMap(Rect the_crop, int the_cell);
  int columns() const { return (crop.width + cell - 1) / cell; }
  int rows() const { return (crop.height + cell - 1) / cell; }
  /// Spreads `cost` evenly over the pixels of `part`, a rectangle within the crop window.
  void add(Rect part, double cost);
  /// Within a cell the cost is taken to be even.
  double cost_of(Rect part) const;
};

/// Rectangles of equal cost: halves the ranks and cuts the longer side where the cost of both parts is
/// as their shares are, again and again.
std::vector<Rect> split_cost(const CostMap &map, const std::vector<int> &shares);

/// Tiles of at most `size` pixels along a side that cover the rectangle; none for an empty one.
std::vector<Rect> tiles_of(Rect region, int size);

/// What two rectangles share; width or height 0 if it is nothing.
Rect intersection(Rect a, Rect b);

}  // namespace phalanx
