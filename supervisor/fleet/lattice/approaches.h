#pragma once

// From where on a floor a pose can be reached at all, if only from few poses: a goal that blocked places
// enclose. A search for a way to such a goal looks at all of the floor before it gives up; this looks at what
// is enclosed with the goal.
//
// A value that does not change; any thread may read. Exact for the lattice: a pose that is not held has no
// way to the goal. Found by a search backwards from the goal that gives up beyond a number of poses.
//
//   const auto approaches = planner.approaches(goal, 50'000);
//   if (approaches && !approaches->hold(from)) return no_way();

#include <cstdint>
#include <optional>
#include <unordered_set>

#include "supervisor/fleet/lattice/swept_cells.h"
#include "supervisor/geometry/point.h"

namespace stepwright::fleet {

class Approaches {
 public:
  // Nothing if there are more than `most`. Requires a goal in which the vehicle can stand.
  static std::optional<Approaches> find(const OccupancyGrid& map, const DistanceField& clearance,
                                        const PrimitiveSet& primitives, const SweptCells& cells,
                                        GridVector goal, int heading, std::size_t most);

  // Whether a way leads from the pose of the lattice that is nearest to this one.
  bool hold(const geometry::Pose& from) const;
  std::size_t size() const { return poses_.size(); }

 private:
  Approaches(const GridFrame& frame, double step_m) : frame_(frame), step_m_(step_m) {}

  GridFrame frame_;
  double step_m_ = 0.0;
  std::unordered_set<std::uint64_t> poses_;
};

}  // namespace stepwright::fleet
