#include "supervisor/tamp/mission/observed_state.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace stepwright::tamp::mission {
namespace {

constexpr double kHome_rad = 0.015;  // an arm so near to it is at home
constexpr double kWidth_m = 0.003;   // of what is held
constexpr double kBetween_m = 0.05;  // a thing between the fingers is so near to the tool
constexpr double kHangs = -0.99;     // a tool that hangs down, within 8 degrees
constexpr double kLineStep_m = 0.02;

class Observation {
 public:
  Observation(const scene::RobotCell& cell, const ArmsReading& reading, const Sight& sight,
              const std::vector<int>& held)
      : cell_(cell), reading_(reading), sight_(sight), held_(held) {}

  Observed make() {
    seen_.state = initial_state(cell_);
    for (std::size_t k = 0; k < cell_.things.size(); ++k)
      if (sight_.things[k]) seen_.state.things[k].pose = settled(cell_, sight_, k, *sight_.things[k]);
    for (std::size_t arm = 0; arm < cell_.arms.size(); ++arm) put_arm(arm);
    for (std::size_t k = 0; k < cell_.things.size(); ++k)
      if (!sight_.things[k] && seen_.state.things[k].holder < 0) wrong(cell_.things[k].name + " is not seen");
    return std::move(seen_);
  }

 private:
  void wrong(std::string what) {
    if (seen_.wrong.empty()) seen_.wrong = std::move(what);
  }

  void put_arm(std::size_t arm) {
    const scene::ArmModel& model = cell_.arms[arm];
    const ArmReading& now = reading_.arms[arm];
    scene::ArmState& at = seen_.state.arms[arm];
    at.at = now.joints;
    const motion::Transform tool = tool_of(model, now.joints);
    const double widest_m = cell_.robot.coordinates[static_cast<std::size_t>(model.gripper)].upper;
    at.half_open_m = std::clamp(0.5 * now.width_m, 0.0, widest_m);
    if (now.grasp_switch) hold(arm, tool);
    bool home = true;
    for (std::size_t j = 0; j < now.joints.size(); ++j)
      home = home && std::abs(now.joints[j] - model.home[j]) < kHome_rad;
    if (home && at.holds < 0) {
      at.at = model.home;
      return;
    }
    if (at.holds < 0)
      if (const auto near = nearest(tool, now.width_m, /*held=*/false)) {
        at.near = static_cast<int>(*near);
        at.half_open_m = std::clamp(cell_.open_m(at.near), at.half_open_m, widest_m);
      }
    at.line = line_up(model, now.joints);
  }

  void hold(std::size_t arm, const motion::Transform& tool) {
    const double width_m = reading_.arms[arm].width_m;
    auto thing = nearest(tool, width_m, /*held=*/true);
    const int before = held_[arm];
    if (!thing && before >= 0 && std::abs(2.0 * cell_.grip_m(before) - width_m) < kWidth_m &&
        !sight_.things[static_cast<std::size_t>(before)])
      thing = static_cast<std::size_t>(before);
    if (!thing)
      return wrong("the " + cell_.arms[arm].name + " hand holds something that the camera does not show");
    scene::ThingState& it = seen_.state.things[*thing];
    if (it.holder >= 0) return wrong("both hands hold " + cell_.things[*thing].name);
    it.holder = static_cast<int>(arm);
    const motion::Vector3 ahead = tool.rotation.column(0);
    it.hand_rad = std::atan2(ahead.y, ahead.x) - it.pose.angle_rad;
    seen_.state.arms[arm].holds = static_cast<int>(*thing);
    seen_.state.arms[arm].half_open_m = cell_.grip_m(static_cast<int>(*thing));
  }

  // The thing that the fingers are around.
  std::optional<std::size_t> nearest(const motion::Transform& tool, double width_m, bool held) const {
    std::optional<std::size_t> found;
    double least_m = kBetween_m;
    for (std::size_t k = 0; k < cell_.things.size(); ++k) {
      if (!sight_.things[k] || seen_.state.things[k].holder >= 0) continue;
      const scene::Pose& seen = *sight_.things[k];
      // Where its underside would be between the pads, however the hand is turned.
      const motion::Vector3 there =
          tool.position_m + cell_.tool_above(static_cast<int>(k)) * tool.rotation.column(2);
      const double up_m = seen.z_m - there.z;
      const double far_m = std::hypot(seen.x_m - there.x, seen.y_m - there.y);
      if (std::abs(up_m) > kBetween_m || far_m >= least_m) continue;
      if (held && std::abs(2.0 * cell_.grip_m(static_cast<int>(k)) - width_m) > kWidth_m) continue;
      least_m = far_m;
      found = k;
    }
    return found;
  }

  // Straight up, as far as the arm goes; empty: its tool does not hang down.
  motion::JointPath line_up(const scene::ArmModel& model, const scene::JointValues& joints) const {
    motion::Transform tip = model.kinematics.forward(joints);
    motion::Transform tool = model.base * tip;
    if (tool.rotation.column(2).z > kHangs) return {};
    const double swivel_rad = model.kinematics.swivel(joints);
    const motion::SrsBranch branch = model.kinematics.branch(joints);
    motion::JointPath line = {{joints.begin(), joints.end()}};
    for (double up_m = kLineStep_m; up_m < cell_.manner.lift_m + 1e-9; up_m += kLineStep_m) {
      motion::Transform higher = tool;
      higher.position_m.z += up_m;
      const auto found = model.kinematics.solve(inverse(model.base) * higher, swivel_rad, branch);
      if (!found || motion::joint_distance(found->q, line.back()) > 0.5) break;
      line.emplace_back(found->q.begin(), found->q.end());
    }
    return line.size() > 1 ? line : motion::JointPath{};
  }

  const scene::RobotCell& cell_;
  const ArmsReading& reading_;
  const Sight& sight_;
  const std::vector<int>& held_;
  Observed seen_;
};

}  // namespace

Observed observe(const scene::RobotCell& cell, const ArmsReading& reading, const Sight& sight,
                 const std::vector<int>& held) {
  return Observation(cell, reading, sight, held).make();
}

motion::Transform tool_of(const scene::ArmModel& arm, const scene::JointValues& joints) {
  return arm.base * arm.kinematics.forward(joints);
}

}  // namespace stepwright::tamp::mission
