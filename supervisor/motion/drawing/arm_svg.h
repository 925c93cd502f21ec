#pragma once

// A path of an arm as a picture: what stands around it, and the arm's links at places along the path, from
// the side and from above.
//
//   std::string svg = arm_svg({robot, world, coordinates, rest, path, "panda_arm"});
//
// A function without state; any thread. Solids are drawn as the outlines of their projections; links as lines
// between the joints that move, green where the path begins and red where it ends; the line that the last one
// goes is dashed.

#include <span>
#include <string>
#include <vector>

#include "supervisor/motion/collision/world.h"
#include "supervisor/motion/path/path.h"

namespace stepwright::motion {

struct ArmPicture {
  const Robot& robot;
  const World& world;
  std::span<const int> coordinates;
  std::span<const double> rest;
  const JointPath& path;  // may be empty: the robot at rest
  std::string title;
};

std::string arm_svg(const ArmPicture& picture);

}  // namespace stepwright::motion
