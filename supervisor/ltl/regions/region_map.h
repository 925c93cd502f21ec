#pragma once

// The free floor of a scene as triangles, each with the propositions that hold in it: the regions of Plaku
// 2012, section 3.1. Two regions are neighbours where they share a side, so that no way from one to the other
// crosses a wall.
//
// A value that does not change; any thread may read.
//
//   const auto map = make_regions(floor);
//   const std::uint32_t here = map->locate({3.0, 4.0});   // kNoRegion: in an obstacle, or outside
//   for (std::uint32_t next : map->region(here).across) ...

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "supervisor/geometry/convex_polygon.h"

namespace stepwright::ltl {

using Label = std::uint64_t;  // one bit for each proposition

inline constexpr std::uint32_t kNoRegion = 0xFFFF'FFFF;
inline constexpr std::size_t kMostPropositions = 64;

// Corners in anticlockwise order, as indices of points; across[k] is the region behind the side from corner k
// to corner k + 1, kNoRegion at a wall.
struct Region {
  std::array<std::uint32_t, 3> corners{};
  std::array<std::uint32_t, 3> across{kNoRegion, kNoRegion, kNoRegion};
  Label label = 0;
};

class RegionMap {
 public:
  // Requires corners within `points`, anticlockwise; finds the neighbours. Each side has at most two regions.
  RegionMap(std::vector<geometry::Point> points, std::vector<Region> regions);

  std::span<const geometry::Point> points() const { return points_; }
  std::span<const Region> regions() const { return regions_; }
  const Region& region(std::uint32_t index) const { return regions_[index]; }
  geometry::Point corner(std::uint32_t region, std::size_t k) const {
    return points_[regions_[region].corners[k % 3]];
  }
  geometry::Point centroid(std::uint32_t region) const;
  double area_m2() const;

  // The region with that point in it, sides included; of several the first. O(1) on average.
  std::uint32_t locate(geometry::Point at) const;

 private:
  void find_neighbours();
  void sort_into_cells();
  std::size_t column(double x_m) const;
  std::size_t row(double y_m) const;

  std::vector<geometry::Point> points_;
  std::vector<Region> regions_;
  geometry::Box bounds_;
  double cell_m_ = 1.0;
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
  std::vector<std::uint32_t> first_;   // of each cell among `inside_`, and the end
  std::vector<std::uint32_t> inside_;  // regions whose boxes meet the cell
};

}  // namespace stepwright::ltl
