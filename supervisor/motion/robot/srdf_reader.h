#pragma once

// Semantics of robots in SRDF (MoveIt): <group> of chains, links, joints and groups, <group_state>,
// <end_effector>, <disable_collisions>. Virtual and passive joints are passed over: a robot stands where its
// root is.
//
//   const auto semantics = read_srdf(text, "cell.srdf", *robot);
//
// A function without state; any thread. Names that the robot does not have are refused with their place and
// the nearest name; a value for a joint that does not move is passed over.

#include <string_view>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/robot/robot.h"
#include "supervisor/motion/robot/semantics.h"

namespace stepwright::motion {

inline constexpr std::size_t kMostGroups = 256;
inline constexpr std::size_t kMostNamedStates = 4096;

// `name` is the file for messages. Fails with A0101 to A0104, A0107, A0111, all that is wrong at once.
[[nodiscard]] result::Result<Semantics> read_srdf(std::string_view text, std::string name,
                                                  const Robot& robot);

}  // namespace stepwright::motion
