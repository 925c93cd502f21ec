#include "tests/support/fleet/exact_outline.h"

#include <cmath>

namespace stepwright::support {

bool outline_hits(const fleet::OccupancyGrid& grid, const geometry::Footprint& footprint,
                  const geometry::Pose& pose) {
  const auto outline = geometry::footprint_at(pose, footprint);
  const auto& frame = grid.frame();
  const auto in_cells = [&](double value_m) {
    return static_cast<std::int32_t>(std::floor(value_m / frame.resolution_m));
  };
  const auto low = outline.bounds().low - frame.origin;
  const auto high = outline.bounds().high - frame.origin;
  for (std::int32_t row = in_cells(low.y_m) - 1; row <= in_cells(high.y_m) + 1; ++row) {
    for (std::int32_t column = in_cells(low.x_m) - 1; column <= in_cells(high.x_m) + 1; ++column) {
      const fleet::Cell cell{column, row};
      if (grid.blocked(cell) && geometry::overlaps(outline, fleet::cell_square(frame, cell))) return true;
    }
  }
  return false;
}

std::optional<std::size_t> first_hit(const fleet::OccupancyGrid& grid, const geometry::Footprint& footprint,
                                     const geometry::Path& path) {
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (outline_hits(grid, footprint, path[k].pose)) return k;
  }
  return std::nullopt;
}

}  // namespace stepwright::support
