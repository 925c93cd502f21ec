#pragma once

// Cells of a grid that a convex region covers, as runs in rows. Pure functions; any thread.
//
//   for (const RowSpan& span : covered_spans(polygon, grid.frame())) ...
//   if (meets_obstacle(grid, footprint_at(pose, footprint))) ...

#include <cstdint>
#include <vector>

#include "supervisor/map/occupancy_grid.h"

namespace stepwright::fleet {

// The cells first to last of a row, both included.
struct RowSpan {
  std::int32_t row = 0;
  std::int32_t first = 0;
  std::int32_t last = 0;

  friend bool operator==(const RowSpan&, const RowSpan&) = default;
};

// The cells, on the map or not, that share inner points with the polygon: one span per row, rows rising. A
// cell into which the polygon reaches less than a nanometre is only touched and left out.
std::vector<RowSpan> covered_spans(const geometry::ConvexPolygon& polygon, const GridFrame& frame);

// Blocks the covered cells that are on the map.
void block(OccupancyGrid& grid, const geometry::ConvexPolygon& polygon);

// Whether the polygon shares inner points with a blocked cell or with what lies outside the map.
bool meets_obstacle(const OccupancyGrid& grid, const geometry::ConvexPolygon& polygon);

}  // namespace stepwright::fleet
