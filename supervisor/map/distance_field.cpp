#include "supervisor/map/distance_field.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <span>

namespace stepwright::fleet {

namespace {

using std::int32_t;
using std::int64_t;

bool beside_obstacle(const OccupancyGrid& grid, int32_t column, int32_t row) {
  return grid.blocked({column, row}) || grid.blocked({column - 1, row}) || grid.blocked({column, row - 1}) ||
         grid.blocked({column - 1, row - 1});
}

// Distances along each column, in cells. The first and the last corner of a column are at an obstacle.
std::vector<int32_t> along_columns(const OccupancyGrid& grid, int32_t columns, int32_t rows) {
  std::vector<int32_t> cells(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const auto at = [&](int32_t column, int32_t row) -> int32_t& {
    return cells[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                 static_cast<std::size_t>(column)];
  };
  for (int32_t row = 0; row < rows; ++row) {
    for (int32_t column = 0; column < columns; ++column) {
      at(column, row) = beside_obstacle(grid, column, row) ? 0 : at(column, row - 1) + 1;
    }
  }
  for (int32_t row = rows - 2; row > 0; --row) {
    for (int32_t column = 0; column < columns; ++column) {
      at(column, row) = std::min(at(column, row), at(column, row + 1) + 1);
    }
  }
  return cells;
}

// The lower envelope of the parabolas (x - q)^2 + height(q)^2 along one row.
class Envelope {
 public:
  explicit Envelope(std::size_t corners) : vertex_(corners), from_(corners) {}

  void transform(std::span<const int32_t> height, double resolution_m, std::span<float> metres) {
    std::size_t last = 0;
    vertex_[0] = 0;
    from_[0] = 0;
    const auto size = static_cast<int32_t>(height.size());
    for (int32_t q = 1; q < size; ++q) {
      while (last > 0 && first_below(height, vertex_[last], q) <= from_[last]) --last;
      const int64_t from = first_below(height, vertex_[last], q);
      if (from >= size) continue;
      if (from <= from_[last]) {
        vertex_[last] = q;  // only where last is 0: q lies below it everywhere
        continue;
      }
      ++last;
      vertex_[last] = q;
      from_[last] = static_cast<int32_t>(from);
    }
    read_off(height, last, resolution_m, metres);
  }

 private:
  // The first x at which the parabola of q lies below that of p < q, in whole numbers.
  static int64_t first_below(std::span<const int32_t> height, int32_t p, int32_t q) {
    const auto squared = [&](int32_t x) {
      const int64_t h = height[static_cast<std::size_t>(x)];
      return h * h + int64_t{x} * x;
    };
    const int64_t above = squared(q) - squared(p);
    const int64_t twice = 2 * (int64_t{q} - p);
    const int64_t quotient = above / twice - (above % twice < 0 ? 1 : 0);
    return std::max<int64_t>(quotient + 1, 0);
  }

  void read_off(std::span<const int32_t> height, std::size_t last, double resolution_m,
                std::span<float> metres) const {
    std::size_t k = last;
    for (auto x = static_cast<int32_t>(height.size()) - 1; x >= 0; --x) {
      while (k > 0 && from_[k] > x) --k;
      const double across = vertex_[k] - x;
      const double along = height[static_cast<std::size_t>(vertex_[k])];
      metres[static_cast<std::size_t>(x)] =
          static_cast<float>(resolution_m * std::sqrt(across * across + along * along));
    }
  }

  std::vector<int32_t> vertex_;  // where the k-th parabola of the envelope stands
  std::vector<int32_t> from_;    // the first x at which it is the lowest
};

}  // namespace

DistanceField::DistanceField(const OccupancyGrid& grid) : columns_(grid.frame().columns + 1) {
  const auto columns = static_cast<std::size_t>(columns_);
  const std::vector<int32_t> heights = along_columns(grid, columns_, grid.frame().rows + 1);
  metres_.resize(heights.size());
  Envelope envelope(columns);
  for (std::size_t begin = 0; begin < heights.size(); begin += columns) {
    envelope.transform(std::span(heights).subspan(begin, columns), grid.frame().resolution_m,
                       std::span(metres_).subspan(begin, columns));
  }
}

}  // namespace stepwright::fleet
