#include "supervisor/ltl/train/walls.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "supervisor/geometry/outline.h"

namespace stepwright::ltl {

namespace {

using geometry::Point;

constexpr double kMostCells = 4e6;
constexpr std::size_t kBlock = 8;   // cells of a block in each direction
constexpr double kBarely_m = 1e-9;  // a side that comes no further into a box only touches it

}  // namespace

Walls::Walls(const Floor& floor, const TrainModel& model)
    : half_length_m_(0.5 * model.length_m),
      half_width_m_(0.5 * model.width_m),
      reach_m_(std::hypot(half_length_m_, half_width_m_)) {
  bounds_ = geometry::kNoBox;
  add(floor.border.ring);
  for (const Area& obstacle : floor.obstacles) add(obstacle.ring);
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

void Walls::sort_into_cells() {
  const auto each_cell = [this](const auto& visit) {
    for (std::uint32_t k = 0; k < sides_.size(); ++k) {
      const auto [low_x, high_x] = std::minmax(sides_[k].from.x_m, sides_[k].to.x_m);
      const auto [low_y, high_y] = std::minmax(sides_[k].from.y_m, sides_[k].to.y_m);
      for (std::size_t r = row(low_y); r <= row(high_y); ++r)
        for (std::size_t c = column(low_x); c <= column(high_x); ++c) visit(r * columns_ + c, k);
    }
  };
  first_.assign(columns_ * rows_ + 1, 0);
  each_cell([this](std::size_t cell, std::uint32_t) { ++first_[cell + 1]; });
  for (std::size_t cell = 0; cell < columns_ * rows_; ++cell) first_[cell + 1] += first_[cell];
  inside_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  each_cell([&](std::size_t cell, std::uint32_t side) { inside_[next[cell]++] = side; });
}

// Block by block: which sides can be the nearest one of any of its cells is asked once for all of them.
void Walls::measure_cells() {
  clearance_m_.resize(columns_ * rows_);
  std::vector<double> from_middle_m(sides_.size());
  std::vector<std::uint32_t> candidates;
  for (std::size_t r = 0; r < rows_; r += kBlock) {
    for (std::size_t c = 0; c < columns_; c += kBlock) {
      const double half = 0.5 * static_cast<double>(kBlock);
      const Point middle =
          cell_m_ * Point{static_cast<double>(c) + half, static_cast<double>(r) + half} + bounds_.low;
      double nearest = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < sides_.size(); ++k) {
        from_middle_m[k] = distance_to_side(middle, sides_[k].from, sides_[k].to);
        nearest = std::min(nearest, from_middle_m[k]);
      }
      candidates.clear();
      for (std::uint32_t k = 0; k < sides_.size(); ++k)
        if (from_middle_m[k] <= nearest + 2.0 * std::sqrt(2.0) * half * cell_m_) candidates.push_back(k);
      measure_block(r, c, candidates);
    }
  }
}

void Walls::measure_block(std::size_t row, std::size_t column, const std::vector<std::uint32_t>& candidates) {
  const double half_diagonal = cell_m_ * std::sqrt(0.5);
  for (std::size_t r = row; r < std::min(rows_, row + kBlock); ++r) {
    for (std::size_t c = column; c < std::min(columns_, column + kBlock); ++c) {
      const Point middle =
          cell_m_ * Point{static_cast<double>(c) + 0.5, static_cast<double>(r) + 0.5} + bounds_.low;
      double nearest = std::numeric_limits<double>::infinity();
      for (const std::uint32_t k : candidates)
        nearest = std::min(nearest, distance_to_side(middle, sides_[k].from, sides_[k].to));
      clearance_m_[r * columns_ + c] = std::max(0.0, nearest - half_diagonal);
    }
  }
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
