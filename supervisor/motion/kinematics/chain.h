#pragma once

// The joints between a link and one that hangs below it: an arm. Fixed joints on the way are merged.
//
//   const auto arm = Chain::between(robot, robot.link("torso"), robot.link("right_tcp"));
//   const Transform tip = arm->forward(q);              // of the tip in the base's frame; q: the arm's own
//   values
//
// Does not change after it was made; any thread. At most 32 joints; joints that mimic one another are
// refused.

#include <span>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/kinematics/turning.h"
#include "supervisor/motion/robot/robot.h"

namespace stepwright::motion {

struct ChainJoint {
  JointKind kind = JointKind::Revolute;
  int coordinate = 0;  // of the robot
  double lower = 0.0, upper = 0.0;
  Vector3 axis{0, 0, 1};  // in the frame after `before`
  Transform before;       // from the last joint's frame (the base's for the first) to this one's at 0
  Turning turning;
};

class Chain {
 public:
  static constexpr std::size_t kMostJoints = 32;

  // Fails with A0111.
  [[nodiscard]] static result::Result<Chain> between(const Robot& robot, int base, int tip);

  std::size_t size() const { return joints_.size(); }
  std::span<const ChainJoint> joints() const { return joints_; }
  const Transform& tool() const { return tool_; }  // from the last joint's frame to the tip's

  // Each requires size() values.
  Transform forward(std::span<const double> q) const;
  // And the frame of each joint after it has turned, for as many as `frames` has.
  Transform forward(std::span<const double> q, std::span<Transform> frames) const;
  // Column k, numbers 6k to 6k + 5: velocity of the tip's origin (m/s), then its turning (rad/s), per unit of
  // joint k's speed, in the base's frame. Requires 6 size() numbers. Gives the tip.
  Transform jacobian(std::span<const double> q, std::span<double> columns) const;

  bool within_limits(std::span<const double> q, double slack = 0.0) const;

 private:
  std::vector<ChainJoint> joints_;
  Transform tool_;
};

}  // namespace stepwright::motion
