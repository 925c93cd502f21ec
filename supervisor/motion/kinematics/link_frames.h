#pragma once

// Forward kinematics of a whole robot: where each link is.
//
//   const LinkFrames kinematics(robot);
//   std::vector<Transform> frames(robot.links.size());
//   kinematics.place(configuration, frames);            // frames[k]: of link k in the root's frame
//
// Keeps nothing of the robot; does not change after it was made, so any thread may place(). Links that hang
// on the root by fixed joints alone cost nothing but a copy.

#include <span>
#include <vector>

#include "supervisor/motion/kinematics/turning.h"
#include "supervisor/motion/robot/robot.h"

namespace stepwright::motion {

class LinkFrames {
 public:
  explicit LinkFrames(const Robot& robot);

  // Requires a value for each coordinate and a frame for each link.
  void place(std::span<const double> configuration, std::span<Transform> frames) const;

 private:
  struct Step {
    JointKind kind;
    std::size_t parent;
    int coordinate;
    double multiplier, offset;
    Transform origin;
    Turning turning;
    Vector3 along;  // prismatic: the axis in the parent's frame
  };
  std::vector<Step> steps_;
};

}  // namespace stepwright::motion
