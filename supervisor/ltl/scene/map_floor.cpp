#include "supervisor/ltl/scene/map_floor.h"

namespace stepwright::ltl {

namespace {

std::vector<geometry::Point> rectangle(const fleet::GridFrame& frame, fleet::Cell low, fleet::Cell beyond) {
  const geometry::Point a = frame.corner(low), b = frame.corner(beyond);
  return {a, {b.x_m, a.y_m}, b, {a.x_m, b.y_m}};
}

}  // namespace

Floor floor_of(const fleet::OccupancyGrid& grid, const std::string& file) {
  const fleet::GridFrame& frame = grid.frame();
  Floor floor;
  floor.border = {"border", rectangle(frame, {0, 0}, {frame.columns, frame.rows}), {file, 0, 0}};
  std::vector<bool> taken(static_cast<std::size_t>(frame.columns) * static_cast<std::size_t>(frame.rows));
  const auto index = [&](std::int32_t column, std::int32_t row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(frame.columns) +
           static_cast<std::size_t>(column);
  };
  const auto open = [&](std::int32_t column, std::int32_t row) {
    return !grid.blocked({column, row}) || taken[index(column, row)];
  };
  for (std::int32_t row = 0; row < frame.rows; ++row) {
    for (std::int32_t column = 0; column < frame.columns; ++column) {
      if (open(column, row)) continue;
      std::int32_t right = column, up = row + 1;
      while (right < frame.columns && !open(right, row)) ++right;
      const auto whole = [&](std::int32_t at) {
        for (std::int32_t c = column; c < right; ++c)
          if (open(c, at)) return false;
        return true;
      };
      while (up < frame.rows && whole(up)) ++up;
      for (std::int32_t r = row; r < up; ++r)
        for (std::int32_t c = column; c < right; ++c) taken[index(c, r)] = true;
      floor.obstacles.push_back({"cells at " + std::to_string(column) + ", " + std::to_string(row),
                                 rectangle(frame, {column, row}, {right, up}),
                                 {file, 0, 0}});
    }
  }
  return floor;
}

}  // namespace stepwright::ltl
