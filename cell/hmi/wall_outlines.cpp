#include "cell/hmi/wall_outlines.h"

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace stepwright::hmi {
namespace {

using fleet::Cell;
using fleet::OccupancyGrid;
using Outline = std::vector<std::int32_t>;

// Anticlockwise, so that the next one is a turn to the left.
enum Direction : int { kEast, kNorth, kWest, kSouth };
constexpr std::array<int, 4> kColumnStep = {1, 0, -1, 0};
constexpr std::array<int, 4> kRowStep = {0, 1, 0, -1};

// Edges between blocked and free cells, each with the blocked one on its left: at every corner of cells as
// many begin as end, so that they are closed lines.
class Tracer {
 public:
  Tracer(const OccupancyGrid& grid, std::size_t most_numbers)
      : grid_(grid),
        most_numbers_(most_numbers),
        width_(static_cast<std::size_t>(grid.frame().columns) + 1),
        edges_(width_ * (static_cast<std::size_t>(grid.frame().rows) + 1), 0) {}

  // None: there are more numbers than wanted.
  std::optional<std::vector<Outline>> trace() {
    mark_edges();
    std::vector<Outline> outlines;
    for (std::int32_t row = 0; row <= grid_.frame().rows; ++row) {
      for (std::int32_t column = 0; column <= grid_.frame().columns; ++column) {
        while (edges_at({column, row}) != 0) {
          outlines.push_back(follow({column, row}));
          numbers_ += outlines.back().size();
          if (numbers_ > most_numbers_) return std::nullopt;
        }
      }
    }
    return outlines;
  }

 private:
  bool is_blocked(std::int32_t column, std::int32_t row) const {
    return grid_.contains({column, row}) && grid_.blocked({column, row});
  }
  std::uint8_t& edges_at(Cell corner) {
    return edges_[static_cast<std::size_t>(corner.row) * width_ + static_cast<std::size_t>(corner.column)];
  }

  void mark_edges() {
    for (std::int32_t row = 0; row <= grid_.frame().rows; ++row) {
      for (std::int32_t column = 0; column <= grid_.frame().columns; ++column) {
        const bool upper_right = is_blocked(column, row);
        const bool upper_left = is_blocked(column - 1, row);
        const bool lower_left = is_blocked(column - 1, row - 1);
        const bool lower_right = is_blocked(column, row - 1);
        std::uint8_t& out = edges_at({column, row});
        if (upper_right && !lower_right) out |= 1 << kEast;
        if (upper_left && !upper_right) out |= 1 << kNorth;
        if (lower_left && !upper_left) out |= 1 << kWest;
        if (lower_right && !lower_left) out |= 1 << kSouth;
      }
    }
  }

  // Where two lines meet at a corner the left turn keeps them apart.
  int next_direction(Cell corner, int from) {
    for (const int turn : {1, 0, 3}) {
      const int direction = (from + turn) % 4;
      if ((edges_at(corner) >> direction & 1) != 0) return direction;
    }
    return from;
  }

  Outline follow(Cell first) {
    std::vector<Cell> corners;
    Cell at = first;
    int direction = (edges_at(at) >> kEast & 1) != 0 ? kEast : kNorth;
    const int begin = direction;
    corners.push_back(first);
    while (true) {
      edges_at(at) = static_cast<std::uint8_t>(edges_at(at) & ~(1 << direction));
      at = {at.column + kColumnStep[direction], at.row + kRowStep[direction]};
      if (at == first) break;
      const int next = next_direction(at, direction);
      if (next != direction) corners.push_back(at);
      direction = next;
    }
    // One that begins upwards begins with its second corner, so that the first step is along x.
    if (begin == kNorth) {
      corners.push_back(corners.front());
      corners.erase(corners.begin());
    }
    return steps_of(corners);
  }

  static Outline steps_of(const std::vector<Cell>& corners) {
    Outline steps = {corners.front().column, corners.front().row};
    for (std::size_t k = 1; k < corners.size(); ++k) {
      const bool along_x = k % 2 == 1;
      steps.push_back(along_x ? corners[k].column - corners[k - 1].column
                              : corners[k].row - corners[k - 1].row);
    }
    return steps;
  }

  const OccupancyGrid& grid_;
  std::size_t most_numbers_;
  std::size_t width_;                // of a row of corners
  std::vector<std::uint8_t> edges_;  // that begin at each corner and are not in a line yet
  std::size_t numbers_ = 0;
};

// Each cell stands for four.
OccupancyGrid coarser(const OccupancyGrid& grid) {
  fleet::GridFrame frame = grid.frame();
  frame.resolution_m *= 2;
  frame.columns = (frame.columns + 1) / 2;
  frame.rows = (frame.rows + 1) / 2;
  OccupancyGrid made(frame);
  for (std::int32_t row = 0; row < grid.frame().rows; ++row) {
    for (std::int32_t column = 0; column < grid.frame().columns; ++column) {
      if (grid.blocked({column, row})) made.set({column / 2, row / 2}, true);
    }
  }
  return made;
}

protocol::FloorMap map_of(const fleet::GridFrame& frame, std::vector<Outline> outlines) {
  return {frame.origin.x_m, frame.origin.y_m, frame.resolution_m,
          frame.columns,    frame.rows,       std::move(outlines)};
}

}  // namespace

protocol::FloorMap outlined(const OccupancyGrid& grid, std::size_t most_numbers) {
  if (auto outlines = Tracer(grid, most_numbers).trace()) return map_of(grid.frame(), std::move(*outlines));
  if (grid.frame().columns == 1 && grid.frame().rows == 1) return map_of(grid.frame(), {});
  return outlined(coarser(grid), most_numbers);
}

}  // namespace stepwright::hmi
