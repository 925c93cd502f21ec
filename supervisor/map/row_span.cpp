#include "supervisor/map/row_span.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stepwright::fleet {

namespace {

using geometry::Point;

constexpr double kTouching_m = 1e-9;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// Where the side from a to b runs within the strip low <= y <= high, in x.
void add_clipped(Point a, Point b, double low, double high, Range& range) {
  if (a.y_m > b.y_m) std::swap(a, b);
  if (b.y_m < low || a.y_m > high) return;
  const auto x_at = [&](double y_m) { return a.x_m + (b.x_m - a.x_m) * ((y_m - a.y_m) / (b.y_m - a.y_m)); };
  range.add(a.y_m >= low ? a.x_m : x_at(low));
  range.add(b.y_m <= high ? b.x_m : x_at(high));
}

Range within_strip(std::span<const Point> corners, double low, double high) {
  Range range;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    add_clipped(corners[k], corners[(k + 1) % corners.size()], low, high, range);
  }
  return range;
}

}  // namespace

std::vector<RowSpan> covered_spans(const geometry::ConvexPolygon& polygon, const GridFrame& frame) {
  const Point inset{kTouching_m, kTouching_m};
  const Cell lowest = frame.cell_at(polygon.bounds().low + inset);
  const Cell highest = frame.cell_at(polygon.bounds().high - inset);
  std::vector<RowSpan> spans;
  for (std::int32_t row = lowest.row; row <= highest.row; ++row) {
    const double low = frame.corner({0, row}).y_m;
    const Range range = within_strip(polygon.corners(), low, low + frame.resolution_m);
    if (range.high - range.low <= 2.0 * kTouching_m) continue;
    const std::int32_t first = frame.cell_at({range.low + kTouching_m, low}).column;
    const std::int32_t last = frame.cell_at({range.high - kTouching_m, low}).column;
    spans.push_back({row, first, last});
  }
  return spans;
}

void block(OccupancyGrid& grid, const geometry::ConvexPolygon& polygon) {
  for (const RowSpan& span : covered_spans(polygon, grid.frame())) {
    for (std::int32_t column = span.first; column <= span.last; ++column) {
      if (grid.contains({column, span.row})) grid.set({column, span.row}, true);
    }
  }
}

bool meets_obstacle(const OccupancyGrid& grid, const geometry::ConvexPolygon& polygon) {
  return std::ranges::any_of(covered_spans(polygon, grid.frame()), [&](const RowSpan& span) {
    return grid.any_blocked(span.row, span.first, span.last);
  });
}

}  // namespace stepwright::fleet
