#pragma once

// The 900 problems of Pecora and Cirillo 2012 ("Quantitative Evaluation"), with what the paper leaves open
// settled once for all: an empty floor of 50 x 50 m, ten points on a circle of 40 m around its middle, eight
// headings, two to ten vehicles, a hundred runs each.
//
//   for (const CircleTask& task : circle_problem(10, 99)) ...

#include <vector>

#include "supervisor/map/occupancy_grid.h"

namespace stepwright::support {

inline constexpr int kCirclePoints = 10;
inline constexpr int kCircleHeadings = 8;
inline constexpr int kCircleRuns = 100;

// One of the 80 poses: point j at 36 j degrees, heading 45 i degrees.
struct CirclePose {
  int point = 0;
  int heading = 0;

  geometry::Pose pose() const;
  int index() const { return point * kCircleHeadings + heading; }
  friend bool operator==(const CirclePose&, const CirclePose&) = default;
};

struct CircleTask {
  CirclePose start;
  CirclePose goal;
};

fleet::OccupancyGrid circle_floor();

// Seed: 10000 * vehicles + run, SplitMix64. Drawn in this order: the start points (Fisher and Yates' shuffle
// of the ten, the first `vehicles` of it), the goal points alike, again until nobody's goal is his start,
// then for each vehicle the heading at the start and the one at the goal.
std::vector<CircleTask> circle_problem(int vehicles, int run);

}  // namespace stepwright::support
