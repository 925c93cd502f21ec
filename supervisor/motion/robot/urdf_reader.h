#pragma once

// Robots in URDF (ROS, "XML robot description format"): links with <collision>, joints of type fixed,
// revolute, continuous and prismatic, <mimic>. Elements of other tools, <visual> and <inertial> are passed
// over.
//
//   const auto robot = read_urdf(text, "cell.urdf");
//   if (!robot) std::cerr << to_string(robot.error());      // "cell.urdf:12:9: A0106: ..."
//
// Functions without state; any thread. Refused with its place: what is no tree, joints that move without
// limits, what is not finite, and robots longer than 50 m, which are drawn in millimetres. Sizes are bounded:
// no input makes this read on without end.

#include <string_view>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/robot/robot.h"

namespace stepwright::motion {

inline constexpr std::size_t kMostLinks = 1024;
inline constexpr std::size_t kMostShapes = 16384;
inline constexpr double kLongestRobot_m = 50.0;

// `name` is the file for messages. Fails with A0101 to A0109, all that is wrong at once.
[[nodiscard]] result::Result<Robot> read_urdf(std::string_view text, std::string name);

}  // namespace stepwright::motion
