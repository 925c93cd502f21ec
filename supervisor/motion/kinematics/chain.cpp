#include "supervisor/motion/kinematics/chain.h"

#include <algorithm>
#include <array>

#include "supervisor/motion/robot/codes.h"

namespace stepwright::motion {

result::Result<Chain> Chain::between(const Robot& robot, int base, int tip) {
  const auto links = static_cast<int>(robot.links.size());
  if (base < 0 || tip < 0 || base >= links || tip >= links || !robot.hangs_below(tip, base))
    return result::fail(code::kNoChain, {}, "the tip of the arm does not hang below its base");
  std::vector<int> way;
  for (int link = tip; link != base; link = robot.parent_link(link)) way.push_back(Robot::joint_above(link));
  std::reverse(way.begin(), way.end());
  Chain chain;
  Transform before;
  for (const int each : way) {
    const Joint& joint = robot.joints[static_cast<std::size_t>(each)];
    before = before * joint.origin;
    if (joint.coordinate < 0) continue;
    const Coordinate& moved = robot.coordinates[static_cast<std::size_t>(joint.coordinate)];
    if (moved.joint != each)
      return result::fail(code::kNoChain, {}, "the joint '" + joint.name + "' of the arm mimics another one");
    chain.joints_.push_back({joint.kind, joint.coordinate, moved.lower, moved.upper, joint.axis, before,
                             Turning(before.rotation, joint.axis)});
    before = {};
  }
  if (chain.joints_.empty() || chain.joints_.size() > kMostJoints)
    return result::fail(code::kNoChain, {}, "the arm has no joint, or more than 32");
  chain.tool_ = before;
  return chain;
}

Transform Chain::forward(std::span<const double> q, std::span<Transform> frames) const {
  Transform at;
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const ChainJoint& joint = joints_[k];
    at.position_m = at * joint.before.position_m;
    if (joint.kind == JointKind::Prismatic) {
      at.rotation = at.rotation * joint.before.rotation;
      at.position_m += q[k] * (at.rotation * joint.axis);
    } else {
      at.rotation = at.rotation * joint.turning.at(q[k]);
    }
    if (k < frames.size()) frames[k] = at;
  }
  return at * tool_;
}

Transform Chain::forward(std::span<const double> q) const {
  return forward(q, {});
}

Transform Chain::jacobian(std::span<const double> q, std::span<double> columns) const {
  std::array<Transform, kMostJoints> frames;
  const Transform tip = forward(q, frames);
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const Vector3 axis = frames[k].rotation * joints_[k].axis;  // turning about itself does not change it
    const bool turns = joints_[k].kind != JointKind::Prismatic;
    const Vector3 speed = turns ? cross(axis, tip.position_m - frames[k].position_m) : axis;
    const Vector3 spin = turns ? axis : Vector3{};
    double* const column = columns.data() + 6 * k;
    column[0] = speed.x, column[1] = speed.y, column[2] = speed.z;
    column[3] = spin.x, column[4] = spin.y, column[5] = spin.z;
  }
  return tip;
}

bool Chain::within_limits(std::span<const double> q, double slack) const {
  for (std::size_t k = 0; k < joints_.size(); ++k)
    if (!(q[k] >= joints_[k].lower - slack && q[k] <= joints_[k].upper + slack)) return false;
  return true;
}

}  // namespace stepwright::motion
