#include "supervisor/geometry/box_pairs.h"

#include <algorithm>
#include <cmath>

namespace stepwright::geometry {

namespace {

// Cells of about the mean size of a box, so that a box lies in few of them, and of cells not many more than
// boxes, so that far-off boxes do not make the grid large.
class Grid {
 public:
  explicit Grid(std::span<const Box> boxes) : low_(boxes.front().low) {
    Point high = boxes.front().high;
    double size_m = 0.0;
    for (const Box& box : boxes) {
      low_ = {std::min(low_.x_m, box.low.x_m), std::min(low_.y_m, box.low.y_m)};
      high = {std::max(high.x_m, box.high.x_m), std::max(high.y_m, box.high.y_m)};
      size_m += std::max(box.high.x_m - box.low.x_m, box.high.y_m - box.low.y_m);
    }
    const auto count = static_cast<double>(boxes.size());
    const double most = 1.0 + std::sqrt(4.0 * count);
    const auto cells = [&](double extent_m) {
      return static_cast<std::uint32_t>(std::clamp(extent_m * count / size_m, 1.0, most));
    };
    const Point extent = high - low_;
    columns_ = size_m > 0.0 ? cells(extent.x_m) : 1;
    rows_ = size_m > 0.0 ? cells(extent.y_m) : 1;
    per_x_ = extent.x_m > 0.0 ? columns_ / extent.x_m : 0.0;
    per_y_ = extent.y_m > 0.0 ? rows_ / extent.y_m : 0.0;
  }

  std::uint32_t column(double x_m) const { return place((x_m - low_.x_m) * per_x_, columns_); }
  std::uint32_t row(double y_m) const { return place((y_m - low_.y_m) * per_y_, rows_); }
  std::uint32_t cell(std::uint32_t column, std::uint32_t row) const { return row * columns_ + column; }
  std::uint32_t cells() const { return columns_ * rows_; }

  template <typename Visitor>
  void each_cell(const Box& box, Visitor&& visit) const {
    for (std::uint32_t r = row(box.low.y_m); r <= row(box.high.y_m); ++r) {
      for (std::uint32_t c = column(box.low.x_m); c <= column(box.high.x_m); ++c) visit(cell(c, r));
    }
  }

 private:
  static std::uint32_t place(double at, std::uint32_t count) {
    return std::min(static_cast<std::uint32_t>(std::max(at, 0.0)), count - 1);
  }

  Point low_;
  std::uint32_t columns_ = 1, rows_ = 1;
  double per_x_ = 0.0, per_y_ = 0.0;
};

// Without branches: which of the four fails cannot be foreseen.
bool overlap(const Box& a, const Box& b) {
  return ((a.low.x_m < b.high.x_m) & (b.low.x_m < a.high.x_m) & (a.low.y_m < b.high.y_m) &
          (b.low.y_m < a.high.y_m)) != 0;
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

// Of few boxes all pairs are looked at sooner than a grid is made.
constexpr std::size_t kFew = 160;

Pairs among_few(std::span<const Box> boxes, std::span<const std::uint32_t> groups) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    for (std::uint32_t k = i + 1; k < boxes.size(); ++k)
      if (groups[i] != groups[k] && overlap(boxes[i], boxes[k])) pairs.emplace_back(i, k);
  }
  return pairs;
}

}  // namespace

Pairs overlapping_boxes(std::span<const Box> boxes, std::span<const std::uint32_t> groups) {
  if (boxes.size() <= kFew) return among_few(boxes, groups);
  Pairs pairs;
  const Grid grid(boxes);
  std::vector<std::uint32_t> begin(grid.cells() + 1, 0);
  for (const Box& box : boxes) grid.each_cell(box, [&](std::uint32_t cell) { ++begin[cell + 1]; });
  for (std::uint32_t c = 0; c < grid.cells(); ++c) begin[c + 1] += begin[c];
  std::vector<std::uint32_t> members(begin.back());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t k = 0; k < boxes.size(); ++k) {
    grid.each_cell(boxes[k], [&](std::uint32_t cell) { members[next[cell]++] = k; });
  }
  for (std::uint32_t cell = 0; cell < grid.cells(); ++cell) {
    for (std::uint32_t m = begin[cell]; m < begin[cell + 1]; ++m) {
      const Box& a = boxes[members[m]];
      for (std::uint32_t n = m + 1; n < begin[cell + 1]; ++n) {
        const Box& b = boxes[members[n]];
        if (groups[members[m]] == groups[members[n]] || !overlap(a, b)) continue;
        // Both may meet in several cells: the one with the low corner of what they share tells of it.
        const double x = std::max(a.low.x_m, b.low.x_m), y = std::max(a.low.y_m, b.low.y_m);
        if (grid.cell(grid.column(x), grid.row(y)) == cell) pairs.emplace_back(members[m], members[n]);
      }
    }
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace stepwright::geometry
