#pragma once

// A floor as a grid of square cells, each free or blocked; all that lies outside is blocked.
//
// A value: any thread may read while none writes. Column 0 and row 0 lie at the origin, rows go up with y.
// One bit per cell, so that a run of cells in a row is looked up 64 at a time.
//
//   OccupancyGrid floor({.resolution_m = 0.2, .origin = {0, 0}, .columns = 250, .rows = 250});
//   floor.set({3, 4}, true);
//   floor.any_blocked(4, 0, 9);  // true

#include <cstdint>
#include <vector>

#include "supervisor/geometry/convex_polygon.h"

namespace stepwright::fleet {

// No map has more cells than this (2^25): a file that claims more is refused before memory is taken for it.
inline constexpr std::int64_t kMostCells = std::int64_t{1} << 25;

struct Cell {
  std::int32_t column = 0;
  std::int32_t row = 0;

  friend bool operator==(const Cell&, const Cell&) = default;
};

struct GridFrame {
  double resolution_m = 0.2;  // side of a cell, positive
  geometry::Point origin;     // lower left corner of cell (0, 0)
  std::int32_t columns = 0;   // positive
  std::int32_t rows = 0;      // positive

  // The lower left corner of a cell, which need not be on the map.
  geometry::Point corner(Cell cell) const {
    return {origin.x_m + resolution_m * cell.column, origin.y_m + resolution_m * cell.row};
  }
  // The cell that holds the point, on the map or not; coordinates beyond a million cells end there.
  Cell cell_at(geometry::Point point) const;
  friend bool operator==(const GridFrame&, const GridFrame&) = default;
};

class OccupancyGrid {
 public:
  explicit OccupancyGrid(const GridFrame& frame, bool blocked = false);

  const GridFrame& frame() const { return frame_; }
  bool contains(Cell cell) const {
    return cell.column >= 0 && cell.column < frame_.columns && cell.row >= 0 && cell.row < frame_.rows;
  }
  bool blocked(Cell cell) const {
    return !contains(cell) || (bits_[word_of(cell)] >> (cell.column & 63) & 1) != 0;
  }
  // Requires a cell of the map.
  void set(Cell cell, bool blocked);
  // Whether one of the cells first to last, both included, is blocked. Cells outside the map are.
  bool any_blocked(std::int32_t row, std::int32_t first, std::int32_t last) const;

  friend bool operator==(const OccupancyGrid&, const OccupancyGrid&) = default;

 private:
  std::size_t word_of(Cell cell) const {
    return static_cast<std::size_t>(cell.row) * words_per_row_ + static_cast<std::size_t>(cell.column >> 6);
  }

  GridFrame frame_;
  std::size_t words_per_row_ = 0;
  std::vector<std::uint64_t> bits_;
};

// The square of a cell.
geometry::ConvexPolygon cell_square(const GridFrame& frame, Cell cell);

}  // namespace stepwright::fleet
