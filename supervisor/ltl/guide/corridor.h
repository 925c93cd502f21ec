#pragma once

// The shortest way of a point through a row of neighbouring regions, by the funnel of D. T. Lee and F. P.
// Preparata, Euclidean shortest paths in the presence of rectilinear barriers (1984): it bends only at ends
// of sides. What must not come too near to walls keeps a margin from the ends that are corners of walls.
//
// Immutable; any thread may read. The map must outlive it. Example:
//   const Corridor corridor(*map);
//   const std::vector<geometry::Point> way = corridor.way(guide.way(here, z), at, 0.6);

#include <span>
#include <vector>

#include "supervisor/ltl/guide/guide.h"

namespace stepwright::ltl {

class Corridor {
 public:
  explicit Corridor(const RegionMap& map);

  // From `from`, in the first region, to the nearest point of the side where the last one is entered, both
  // included; `from` alone where there is one region only. Requires stages whose regions are neighbours. A
  // side too narrow for the margin is crossed in its middle.
  std::vector<geometry::Point> way(std::span<const Stage> stages, geometry::Point from,
                                   double margin_m = 0.0) const;

 private:
  struct Gate {
    geometry::Point left, right;  // as one goes
  };

  Gate gate(std::uint32_t from, std::uint32_t to, double margin_m) const;

  const RegionMap& map_;
  std::vector<bool> at_wall_;  // of each point of the map
};

double length_m(std::span<const geometry::Point> way);

}  // namespace stepwright::ltl
