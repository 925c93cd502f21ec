#pragma once

// Free paths of an arm from one configuration to another: two trees that grow towards each other.
//
// Kuffner and LaValle 2000, RRT-Connect: an efficient approach to single-query path planning. A tree grows by
// a step of `range` towards a random configuration; the other one then grows towards the new node as far as
// it can.
//
//   const JointSpace space = joint_space(robot, arm.coordinates);
//   const PathAnswer answer = plan_path(*checker, space, from, {goal}, {.seed = 1});
//   if (!answer.path.empty()) ...
//
// Functions without state; any thread. The same seed gives the same path on every machine: what ends the
// search is numbers of nodes and tries, never a clock. That no path is found proves nothing but for ends that
// collide.

#include <cstdint>

#include "supervisor/motion/path/free_space.h"
#include "supervisor/motion/path/path.h"

namespace stepwright::motion {

// Limits of the coordinates that are planned for; half a turn where there are none.
struct JointSpace {
  Configuration lower, upper;
};
JointSpace joint_space(const Robot& robot, std::span<const int> coordinates);

struct PathOptions {
  std::uint64_t seed = 1;
  double range = 1.0;               // longest step of a tree, in the measure of joint_distance
  double step = 0.02;               // between places that are checked, in each coordinate
  std::size_t most_nodes = 20'000;  // both together; the nearest one is looked for among all
  std::size_t most_tries = 20'000;
};

struct PathAnswer {
  enum class Ending : std::uint8_t {
    Found,
    StartCollides,
    GoalsCollide,  // or lie outside of the limits
    Exhausted,
  };
  Ending ending = Ending::Exhausted;
  JointPath path;  // from the start to one of the goals; empty unless Found
  std::size_t nodes = 0;
  std::size_t motions = 0;  // that were checked
};

PathAnswer plan_path(const FreeSpace& free, const JointSpace& space, const Configuration& from,
                     const std::vector<Configuration>& goals, const PathOptions& options = {});
PathAnswer plan_path(const CollisionChecker& checker, const JointSpace& space, const Configuration& from,
                     const std::vector<Configuration>& goals, const PathOptions& options = {});

// Within the limits, but for rounding in the sixth digit.
bool inside(const JointSpace& space, std::span<const double> q);

}  // namespace stepwright::motion
