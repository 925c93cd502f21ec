#pragma once

// A path that is free as a whole by the bodies themselves, not only by spheres at places along it.
//
//   const CertainPath found = plan_certain_path(*checker, *exact, space, from, {goal}, {.seed = 1});
//   if (!found.path.empty()) ...                     // every motion of it: ExactChecker says Free
//
// Plans and shortens with the fast checker, then has every motion judged (exact_checker.h). A path that is
// refused is thrown away, and the next round plans with another seed and checks places twice as near to each
// other. A function without state; any thread; the same for a seed on every machine.

#include <optional>

#include "supervisor/motion/path/plan_path.h"
#include "supervisor/motion/path/shorten.h"
#include "supervisor/motion/recheck/exact_checker.h"

namespace stepwright::motion {

struct CertainPath {
  PathAnswer::Ending ending = PathAnswer::Ending::Exhausted;  // of the last round's planner
  JointPath path;  // shortened; empty where no round had a path that was accepted
  std::size_t rounds = 0;
  std::optional<MotionVerdict> refused;  // of the last path that was thrown away
};

// Both checkers must be made of the same robot, world and coordinates.
CertainPath plan_certain_path(const CollisionChecker& fast, const ExactChecker& exact,
                              const JointSpace& space, const Configuration& from,
                              const std::vector<Configuration>& goals, PathOptions options = {},
                              std::size_t most_rounds = 6);

// The first motion of a path that is not free for certain; nothing: all are.
std::optional<MotionVerdict> first_refused(const ExactChecker& exact, const JointPath& path);

}  // namespace stepwright::motion
