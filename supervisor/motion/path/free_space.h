#pragma once

// Free space, as planners ask for it: by spheres, by the bodies themselves, or by the bodies where spheres
// say no.
//
//   const FreeSpace free = by_spheres(*checker);
//   if (free.motion_is_free(a, b, 0.02)) ...
//
// Values that look at their checkers, which must outlive them; any thread. Motions by spheres are tried at
// places `step` apart in each coordinate; by bodies they are proved as a whole.

#include <functional>
#include <span>

#include "supervisor/motion/collision/collision_checker.h"
#include "supervisor/motion/recheck/exact_checker.h"

namespace stepwright::motion {

struct FreeSpace {
  std::function<bool(std::span<const double>)> is_free;
  // From, to, step.
  std::function<bool(std::span<const double>, std::span<const double>, double)> motion_is_free;
};

FreeSpace by_spheres(const CollisionChecker& checker);
// `all` checks every pair, `lean` not those that spheres judge wrongly, which `pairs` judges by bodies
// (false_pairs.h), at the places that are tried.
FreeSpace by_spheres(const CollisionChecker& all, const CollisionChecker& lean, const ExactChecker& pairs);
FreeSpace by_bodies(const ExactChecker& checker);
// Spheres first, which take a thousandth of the time. Both checkers must be made of the same robot and world.
FreeSpace by_spheres_or_bodies(const FreeSpace& fast, const ExactChecker& exact);

}  // namespace stepwright::motion
