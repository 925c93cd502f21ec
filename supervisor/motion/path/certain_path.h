#pragma once

// A path that is free as a whole by the bodies themselves, not only by spheres at places along it.
//
//   const CertainPath found = plan_certain_path(*checker, *exact, space, from, {goal}, {.seed = 1});
//   if (!found.path.empty()) ...                     // every motion of it: ExactChecker says Free
//
// Plans and shortens with the fast checker, then has every motion judged (exact_checker.h). A path that is
// refused is thrown away, and the next round plans with another seed and checks places twice as near to each
// other. Spheres are more careful than the bodies: ends that only spheres refuse get ways out (way_out.h),
// and where spheres leave no way at all the bodies are asked wherever spheres say no. A function without
// state; any thread; the same for a seed on every machine.

#include <optional>

#include "supervisor/motion/path/plan_path.h"
#include "supervisor/motion/path/shorten.h"
#include "supervisor/motion/recheck/exact_checker.h"

namespace stepwright::motion {

struct CertainPath {
  // How it was planned, the fastest first.
  enum class Means : std::uint8_t {
    BySpheres,
    WaysOut,   // spheres, and the bodies near the ends
    ByBodies,  // the bodies wherever spheres say no
  };
  PathAnswer::Ending ending = PathAnswer::Ending::Exhausted;  // of the last round's planner
  JointPath path;  // shortened; empty where no round had a path that was accepted
  Means means = Means::BySpheres;
  std::size_t rounds = 0;
  std::size_t thrown_away = 0;           // paths that were refused
  std::optional<MotionVerdict> refused;  // of the last one
  std::optional<Contact> contact;        // what an end meets that the bodies refuse
};

struct CertainOptions {
  // What is free after a path was refused, if that is to be more careful than `fast`; it must outlive the
  // call.
  const FreeSpace* careful = nullptr;
  std::size_t most_rounds = 6;       // each is a path that was refused
  std::size_t sphere_tries = 20000;  // of a round on spheres, if PathOptions do not say less
  std::size_t body_tries = 3000;     // of a round on bodies
};

// Both checkers must be made of the same robot, world and coordinates.
CertainPath plan_certain_path(const FreeSpace& fast, const ExactChecker& exact, const JointSpace& space,
                              const Configuration& from, const std::vector<Configuration>& goals,
                              PathOptions options = {}, const CertainOptions& certain = {});
CertainPath plan_certain_path(const CollisionChecker& fast, const ExactChecker& exact,
                              const JointSpace& space, const Configuration& from,
                              const std::vector<Configuration>& goals, PathOptions options = {},
                              const CertainOptions& certain = {});

// The first motion of a path that is not free for certain; nothing: all are.
std::optional<MotionVerdict> first_refused(const ExactChecker& exact, const JointPath& path);

}  // namespace stepwright::motion
