#pragma once

// A path of an arm through the air, from above one place to above another: the straight motion of its joints
// if that is free, else by way of one or two configurations (between both, higher, where the arm rests), else
// two trees that grow towards each other (plan_path.h). Most need no more than the first.
//
// A function without state; any thread. The same for a seed on every machine.
//
//   const Transfer found = transfer(checker, space, arm, from, to, {.seed = 1});
//   if (!found.path.empty()) ...

#include <cstdint>

#include "supervisor/motion/path/plan_path.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::predicates {

enum class Means : std::uint8_t { Straight, ByWayOf, Trees };

struct Transfer {
  motion::JointPath path;  // empty: none was found, which proves nothing
  Means means = Means::Straight;
  std::size_t motions = 0;  // of trees: that were checked
};

Transfer transfer(const motion::CollisionChecker& checker, const motion::JointSpace& space,
                  const scene::ArmModel& arm, const motion::Configuration& from,
                  const motion::Configuration& to, const motion::PathOptions& options);

}  // namespace stepwright::tamp::predicates
