#pragma once

// Ways out of places where spheres stand out into an obstacle and the bodies themselves do not touch it: a
// hand between two shelves, a finger at a table.
//
//   const JointPath out = way_out(by_spheres(*checker), *exact, space, start, {.seed = 1});
//   if (!out.empty()) ...        // from start to out.back(), which is free by spheres as well
//
// A small tree grows from the configuration, first close to it, then further away; each of its motions is
// proved by ExactChecker. It ends at the first place that is free by spheres. A function without state; any
// thread; the same for a seed on every machine. That nothing is found proves nothing.

#include <cstdint>

#include "supervisor/motion/path/plan_path.h"
#include "supervisor/motion/recheck/exact_checker.h"

namespace stepwright::motion {

struct WayOutOptions {
  std::uint64_t seed = 1;
  double nearest = 0.03;  // of the first places that are tried, in each coordinate
  double farthest = 1.5;  // of the last ones
  std::size_t rounds = 60;
  std::size_t places = 32;     // that spheres look at in each round
  std::size_t most_exact = 3;  // motions that are proved in each round
};

// Only `from` where it is free by spheres; empty where no way was found or `from` is not free by the bodies.
// Both checkers must be made of the same robot and world.
JointPath way_out(const FreeSpace& fast, const ExactChecker& exact, const JointSpace& space,
                  const Configuration& from, const WayOutOptions& options = {});

}  // namespace stepwright::motion
