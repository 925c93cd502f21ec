#pragma once

// Pose of an arm's joints and of its tool: forward kinematics from the figures of an arm. Pure functions; any
// thread, no heap.
//
//   const ArmPose pose = arm_pose(arm, angles);
//   const PlacedSolid finger = placed(arm.bodies[k], pose, opening_m);

#include <array>
#include <span>

#include "plant_models/assemblies/robot_cell_parameters.h"

namespace stepwright::assemblies {

struct ArmPose {
  std::array<Frame, kArmJoints> joints{};
  Frame tool;
};

// Requires seven angles.
inline ArmPose arm_pose(const ArmFigures& arm, std::span<const double> angles_rad) {
  ArmPose pose;
  Frame last;
  for (std::size_t k = 0; k < kArmJoints; ++k) {
    const JointFigures& joint = arm.joints[k];
    last = last * joint.before * Frame{turn_about(joint.axis, angles_rad[k]), {}};
    pose.joints[k] = last;
  }
  pose.tool = last * arm.tool;
  return pose;
}

inline PlacedSolid placed(const ArmBody& body, const ArmPose& pose, double opening_m) {
  Frame frame = body.frame;
  frame.place = frame.place + (0.5 * opening_m) * body.slide;
  return {body.solid, pose.joints[body.joint] * frame};
}

}  // namespace stepwright::assemblies
