#include "supervisor/ltl/regions/region_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace stepwright::ltl {
namespace {

using geometry::Box;
using geometry::Point;

double turn(Point a, Point b, Point c) {
  return cross(b - a, c - a);
}

}  // namespace

RegionMap::RegionMap(std::vector<Point> points, std::vector<Region> regions)
    : points_(std::move(points)), regions_(std::move(regions)) {
  find_neighbours();
  sort_into_cells();
}

void RegionMap::find_neighbours() {
  struct Side {
    std::uint32_t region;
    std::uint8_t k;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Side> open;
  for (std::uint32_t index = 0; index < regions_.size(); ++index) {
    Region& region = regions_[index];
    for (std::uint8_t k = 0; k < 3; ++k) {
      const auto ends = std::minmax(region.corners[k], region.corners[(k + 1) % 3]);
      const auto [other, is_new] = open.try_emplace(ends, Side{index, k});
      if (is_new) continue;
      region.across[k] = other->second.region;
      regions_[other->second.region].across[other->second.k] = index;
    }
  }
}

std::size_t RegionMap::column(double x_m) const {
  const double at = std::floor((x_m - bounds_.low.x_m) / cell_m_);
  return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(columns_ - 1)));
}

std::size_t RegionMap::row(double y_m) const {
  const double at = std::floor((y_m - bounds_.low.y_m) / cell_m_);
  return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(rows_ - 1)));
}

// As many square cells as regions, so that one holds a few of them.
void RegionMap::sort_into_cells() {
  if (points_.empty()) {
    first_ = {0, 0};
    return;
  }
  bounds_ = geometry::bounds_of(points_);
  const double width = std::max(bounds_.high.x_m - bounds_.low.x_m, 1e-9);
  const double height = std::max(bounds_.high.y_m - bounds_.low.y_m, 1e-9);
  const double wanted = 2.0 * static_cast<double>(regions_.size() + 1);
  cell_m_ = std::max({std::sqrt(width * height / wanted), width / wanted, height / wanted});
  columns_ = static_cast<std::size_t>(width / cell_m_) + 1;
  rows_ = static_cast<std::size_t>(height / cell_m_) + 1;

  const auto for_each_cell = [&](std::uint32_t index, auto&& visit) {
    const Point a = corner(index, 0), b = corner(index, 1), c = corner(index, 2);
    const std::size_t last_row = row(std::max({a.y_m, b.y_m, c.y_m}));
    const std::size_t last_column = column(std::max({a.x_m, b.x_m, c.x_m}));
    for (std::size_t r = row(std::min({a.y_m, b.y_m, c.y_m})); r <= last_row; ++r) {
      for (std::size_t q = column(std::min({a.x_m, b.x_m, c.x_m})); q <= last_column; ++q)
        visit(r * columns_ + q);
    }
  };
  first_.assign(columns_ * rows_ + 1, 0);
  for (std::uint32_t index = 0; index < regions_.size(); ++index)
    for_each_cell(index, [&](std::size_t cell) { ++first_[cell + 1]; });
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  inside_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t index = 0; index < regions_.size(); ++index)
    for_each_cell(index, [&](std::size_t cell) { inside_[next[cell]++] = index; });
}

Point RegionMap::centroid(std::uint32_t region) const {
  return (1.0 / 3.0) * (corner(region, 0) + corner(region, 1) + corner(region, 2));
}

double RegionMap::area_m2() const {
  double twice = 0.0;
  for (std::uint32_t index = 0; index < regions_.size(); ++index)
    twice += turn(corner(index, 0), corner(index, 1), corner(index, 2));
  return twice / 2.0;
}

std::uint32_t RegionMap::locate(Point at) const {
  if (!(at.x_m >= bounds_.low.x_m && at.x_m <= bounds_.high.x_m && at.y_m >= bounds_.low.y_m &&
        at.y_m <= bounds_.high.y_m))
    return kNoRegion;
  const std::size_t cell = row(at.y_m) * columns_ + column(at.x_m);
  for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
    const std::uint32_t index = inside_[i];
    const Point a = corner(index, 0), b = corner(index, 1), c = corner(index, 2);
    if (turn(a, b, at) >= 0.0 && turn(b, c, at) >= 0.0 && turn(c, a, at) >= 0.0) return index;
  }
  return kNoRegion;
}

}  // namespace stepwright::ltl
