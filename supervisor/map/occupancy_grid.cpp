#include "supervisor/map/occupancy_grid.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace stepwright::fleet {

namespace {

constexpr double kFarthestCell = 1e6;

std::int32_t whole(double cells) {
  return static_cast<std::int32_t>(std::clamp(std::floor(cells), -kFarthestCell, kFarthestCell));
}

}  // namespace

Cell GridFrame::cell_at(geometry::Point point) const {
  return {whole((point.x_m - origin.x_m) / resolution_m), whole((point.y_m - origin.y_m) / resolution_m)};
}

OccupancyGrid::OccupancyGrid(const GridFrame& frame, bool blocked)
    : frame_(frame),
      words_per_row_((static_cast<std::size_t>(frame.columns) + 63) / 64),
      bits_(words_per_row_ * static_cast<std::size_t>(frame.rows), blocked ? ~std::uint64_t{0} : 0) {
  assert(frame.resolution_m > 0.0 && frame.columns > 0 && frame.rows > 0);
  assert(std::int64_t{frame.columns} * frame.rows <= kMostCells);
}

void OccupancyGrid::set(Cell cell, bool blocked) {
  assert(contains(cell));
  const std::uint64_t bit = std::uint64_t{1} << (cell.column & 63);
  std::uint64_t& word = bits_[word_of(cell)];
  word = blocked ? word | bit : word & ~bit;
}

bool OccupancyGrid::any_blocked(std::int32_t row, std::int32_t first, std::int32_t last) const {
  if (first > last) return false;
  if (row < 0 || row >= frame_.rows || first < 0 || last >= frame_.columns) return true;
  const std::uint64_t from = ~std::uint64_t{0} << (first & 63);
  const std::uint64_t to = ~std::uint64_t{0} >> (63 - (last & 63));
  const std::size_t begin = word_of({first, row});
  const std::size_t end = word_of({last, row});
  if (begin == end) return (bits_[begin] & from & to) != 0;
  if ((bits_[begin] & from) != 0 || (bits_[end] & to) != 0) return true;
  for (std::size_t k = begin + 1; k < end; ++k) {
    if (bits_[k] != 0) return true;
  }
  return false;
}

geometry::ConvexPolygon cell_square(const GridFrame& frame, Cell cell) {
  const std::array<geometry::Point, 4> corners = {
      frame.corner(cell), frame.corner({cell.column + 1, cell.row}),
      frame.corner({cell.column + 1, cell.row + 1}), frame.corner({cell.column, cell.row + 1})};
  return *geometry::ConvexPolygon::hull(corners);
}

}  // namespace stepwright::fleet
