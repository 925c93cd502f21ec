#include "supervisor/motion/kinematics/link_frames.h"

namespace stepwright::motion {

LinkFrames::LinkFrames(const Robot& robot) {
  steps_.reserve(robot.joints.size());
  for (const Joint& joint : robot.joints)
    steps_.push_back({joint.coordinate < 0 ? JointKind::Fixed : joint.kind,
                      static_cast<std::size_t>(joint.parent), joint.coordinate, joint.multiplier,
                      joint.offset, joint.origin, Turning(joint.origin.rotation, joint.axis),
                      joint.origin.rotation * joint.axis});
}

void LinkFrames::place(std::span<const double> configuration, std::span<Transform> frames) const {
  frames[0] = {};
  for (std::size_t j = 0; j < steps_.size(); ++j) {
    const Step& step = steps_[j];
    const Transform& parent = frames[step.parent];
    if (step.kind == JointKind::Fixed) {
      frames[j + 1] = parent * step.origin;
      continue;
    }
    const double value =
        step.multiplier * configuration[static_cast<std::size_t>(step.coordinate)] + step.offset;
    if (step.kind == JointKind::Prismatic)
      frames[j + 1] = {parent.rotation * step.origin.rotation,
                       parent * (step.origin.position_m + value * step.along)};
    else
      frames[j + 1] = {parent.rotation * step.turning.at(value), parent * step.origin.position_m};
  }
}

}  // namespace stepwright::motion
