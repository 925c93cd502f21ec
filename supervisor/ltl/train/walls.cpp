#include "supervisor/ltl/train/walls.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "supervisor/geometry/outline.h"

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr double kMostCells = 4e6;
constexpr double kFar_m = 6.0;      // beyond it a fifth more or less is no matter
constexpr double kBarely_m = 1e-9;  // a side that comes no further into a box only touches it

}  // namespace

Walls::Walls(const Floor& floor, const TrainModel& model)
    : half_length_m_(0.5 * model.length_m),
      half_width_m_(0.5 * model.width_m),
      reach_m_(std::hypot(half_length_m_, half_width_m_)) {
  bounds_ = geometry::kNoBox;
  add(floor.border.ring);
  for (const Area& obstacle : floor.obstacles) add(obstacle.ring);
  for (const Area& obstacle : floor.blocked) add(obstacle.ring);
  const double wide = bounds_.high.x_m - bounds_.low.x_m;
  const double high = bounds_.high.y_m - bounds_.low.y_m;
  cell_m_ = std::max(0.25 * reach_m_, std::sqrt(wide * high / kMostCells));
  columns_ = static_cast<std::size_t>(wide / cell_m_) + 1;
  rows_ = static_cast<std::size_t>(high / cell_m_) + 1;
  sort_into_cells();
  measure_cells();
}

void Walls::add(const std::vector<Point>& ring) {
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point at = ring[k];
    sides_.push_back({at, ring[(k + 1) % ring.size()]});
    extend(bounds_, at);
  }
}

std::size_t Walls::column(double x_m) const {
  const double at = (x_m - bounds_.low.x_m) / cell_m_;
  return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(columns_ - 1)));
}

std::size_t Walls::row(double y_m) const {
  const double at = (y_m - bounds_.low.y_m) / cell_m_;
  return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(rows_ - 1)));
}

// Row by row, the columns that the part of a side in it comes to.
template <typename Visit>
void Walls::each_cell(const Visit& visit) const {
  for (std::uint32_t k = 0; k < sides_.size(); ++k) {
    const bool is_upwards = sides_[k].from.y_m <= sides_[k].to.y_m;
    const Point low = is_upwards ? sides_[k].from : sides_[k].to;
    const Point high = is_upwards ? sides_[k].to : sides_[k].from;
    const double slope = (high.x_m - low.x_m) / std::max(high.y_m - low.y_m, 1e-300);
    for (std::size_t r = row(low.y_m - kBarely_m); r <= row(high.y_m + kBarely_m); ++r) {
      const double floor_y = bounds_.low.y_m + cell_m_ * static_cast<double>(r);
      const auto x_at = [&](double y_m) {
        if (y_m <= low.y_m) return low.x_m;
        return y_m >= high.y_m ? high.x_m : low.x_m + slope * (y_m - low.y_m);
      };
      const double below = x_at(floor_y - kBarely_m), above = x_at(floor_y + cell_m_ + kBarely_m);
      const std::size_t last = column(std::max(below, above) + kBarely_m);
      for (std::size_t c = column(std::min(below, above) - kBarely_m); c <= last; ++c)
        visit(r * columns_ + c, k);
    }
  }
}

void Walls::sort_into_cells() {
  first_.assign(columns_ * rows_ + 1, 0);
  each_cell([this](std::size_t cell, std::uint32_t) { ++first_[cell + 1]; });
  for (std::size_t cell = 0; cell < columns_ * rows_; ++cell) first_[cell + 1] += first_[cell];
  inside_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  each_cell([&](std::size_t cell, std::uint32_t side) { inside_[next[cell]++] = side; });
}

// Square by square, each a quarter of the one before: which sides can be the nearest one of any of its cells
// is asked of those that can be of the square around it.
void Walls::measure_cells() {
  clearance_m_.resize(columns_ * rows_);
  std::vector<std::uint32_t> all(sides_.size());
  for (std::uint32_t k = 0; k < sides_.size(); ++k) all[k] = k;
  measure_square(0, 0, std::bit_ceil(std::max(rows_, columns_)), all);
}

void Walls::measure_square(std::size_t row, std::size_t column, std::size_t cells,
                           const std::vector<std::uint32_t>& among) {
  if (row >= rows_ || column >= columns_) return;
  const double half = 0.5 * static_cast<double>(cells);
  const Point middle =
      cell_m_ * Point{static_cast<double>(column) + half, static_cast<double>(row) + half} + bounds_.low;
  std::vector<double> from_middle_m2(among.size());
  double nearest_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < among.size(); ++k) {
    const Point off = middle - nearest_on_side(sides_[among[k]].from, sides_[among[k]].to, middle);
    from_middle_m2[k] = dot(off, off);
    nearest_m2 = std::min(nearest_m2, from_middle_m2[k]);
  }
  const double nearest = std::sqrt(nearest_m2);
  const double reach_m = std::sqrt(2.0) * half * cell_m_;
  if (cells == 1 || (nearest > kFar_m && reach_m < 0.2 * nearest)) {
    for (std::size_t r = row; r < std::min(rows_, row + cells); ++r)
      for (std::size_t c = column; c < std::min(columns_, column + cells); ++c)
        clearance_m_[r * columns_ + c] = std::max(0.0, nearest - reach_m);
    return;
  }
  std::vector<std::uint32_t> candidates;
  const double most_m = nearest + 2.0 * reach_m + kBarely_m;
  for (std::size_t k = 0; k < among.size(); ++k)
    if (from_middle_m2[k] <= most_m * most_m) candidates.push_back(among[k]);
  const std::size_t part = cells / 2;
  for (const std::size_t r : {row, row + part})
    for (const std::size_t c : {column, column + part}) measure_square(r, c, part, candidates);
}

double Walls::clearance_m(Point at) const {
  const bool inside = at.x_m >= bounds_.low.x_m && at.x_m <= bounds_.high.x_m && at.y_m >= bounds_.low.y_m &&
                      at.y_m <= bounds_.high.y_m;
  return inside ? clearance_m_[row(at.y_m) * columns_ + column(at.x_m)] : 0.0;
}

// The part of the side within the box, by clipping in its frame (Liang, Barsky 1984).
bool Walls::crosses(const Side& side, const LinkBox& box) const {
  const Point from = side.from - box.middle;
  const Point along = side.to - side.from;
  const double places[2] = {dot(from, box.ahead), cross(box.ahead, from)};
  const double ways[2] = {dot(along, box.ahead), cross(box.ahead, along)};
  const double halves[2] = {half_length_m_ - kBarely_m, half_width_m_ - kBarely_m};
  double enters = 0.0;
  double leaves = 1.0;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (ways[axis] == 0.0) {
      if (std::abs(places[axis]) >= halves[axis]) return false;
      continue;
    }
    double one = (-halves[axis] - places[axis]) / ways[axis];
    double other = (halves[axis] - places[axis]) / ways[axis];
    if (one > other) std::swap(one, other);
    enters = std::max(enters, one);
    leaves = std::min(leaves, other);
  }
  return enters < leaves;
}

bool Walls::meets(const LinkBox& box) const {
  if (clearance_m(box.middle) >= reach_m_) return false;
  const double x = std::abs(half_length_m_ * box.ahead.x_m) + std::abs(half_width_m_ * box.ahead.y_m);
  const double y = std::abs(half_length_m_ * box.ahead.y_m) + std::abs(half_width_m_ * box.ahead.x_m);
  for (std::size_t r = row(box.middle.y_m - y); r <= row(box.middle.y_m + y); ++r) {
    for (std::size_t c = column(box.middle.x_m - x); c <= column(box.middle.x_m + x); ++c) {
      const std::size_t cell = r * columns_ + c;
      for (std::uint32_t k = first_[cell]; k < first_[cell + 1]; ++k)
        if (crosses(sides_[inside_[k]], box)) return true;
    }
  }
  return false;
}

bool Walls::meet(const LinkBoxes& boxes, std::size_t links) const {
  for (std::size_t k = 0; k < links; ++k)
    if (meets(boxes[k])) return true;
  return false;
}

}  // namespace stepwright::ltl
