#include "supervisor/tamp/judge/plan_judge.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "supervisor/motion/kinematics/link_frames.h"
#include "supervisor/motion/recheck/exact_checker.h"

namespace stepwright::tamp::judge {

namespace {

using motion::Transform;
using scene::ActionKind;

constexpr double kExact_m = 1e-6;
constexpr double kUpright_rad = 1e-4;
constexpr double kShrunk_m = 2e-4;
constexpr double kTipMeetsMiddle_m = 1e-5;

struct Standing {
  Transform at;           // of its frame; of what is held: in the tool's frame
  std::optional<int> in;  // the arm that holds it
};

class Judge {
 public:
  Judge(const scene::RobotCell& cell, const scene::TampPlan& plan)
      : cell_(cell), plan_(plan), values_(cell.rest) {
    for (const scene::Thing& each : cell.things)
      things_.push_back({scene::frame_of(each.start), std::nullopt});
    for (const scene::ArmModel& arm : cell.arms)
      values_[index(arm.gripper)] = cell.robot.coordinates[index(arm.gripper)].upper;
  }

  Judgement run() {
    for (std::size_t k = 0; k < plan_.actions.size(); ++k) {
      const scene::PlannedAction& action = plan_.actions[k];
      std::string wrong = drive(action);
      if (wrong.empty()) wrong = end_of(action);
      if (!wrong.empty()) {
        judged_.action = k;
        judged_.reason =
            "action " + std::to_string(k + 1) + ", " + text_of(cell_, action.what) + ": " + wrong;
        return judged_;
      }
    }
    judged_.sound = true;
    return judged_;
  }

 private:
  static std::size_t index(int number) { return static_cast<std::size_t>(number); }

  Transform tip(int arm) const {
    std::vector<Transform> frames(cell_.robot.links.size());
    motion::LinkFrames(cell_.robot).place(values_, frames);
    return frames[index(cell_.arms[index(arm)].tip)];
  }

  // Bodies as they are now; what hands hold hangs on them.
  result::Result<motion::ExactChecker> exact(int arm) const {
    motion::World world;
    std::vector<motion::AttachedBody> held;
    for (const scene::Furniture& each : cell_.furniture)
      world.obstacles.push_back(scene::obstacle_of(each.name, each.form, each.pose));
    for (std::size_t k = 0; k < things_.size(); ++k) {
      if (things_[k].in) {
        held.push_back(
            scene::held_thing(cell_, k, cell_.arms[index(*things_[k].in)], things_[k].at, kShrunk_m));
        continue;
      }
      motion::Obstacle body = scene::obstacle_of(cell_.things[k].name, cell_.things[k].form, {});
      body.shape.origin = things_[k].at * body.shape.origin;
      world.obstacles.push_back(std::move(body));
    }
    return motion::ExactChecker::make(cell_.robot, cell_.bodies, &cell_.semantics, world,
                                      cell_.arms[index(arm)].coordinates, values_, nullptr, held);
  }

  std::string drive(const scene::PlannedAction& action) {
    const int arm = action.what.arm;
    const scene::ArmModel& model = cell_.arms[index(arm)];
    for (const scene::Motion& each : action.motions) {
      const std::string phase = name_of(each.phase);
      const motion::Coordinate& fingers = cell_.robot.coordinates[index(model.gripper)];
      if (!(each.half_open_m >= fingers.lower && each.half_open_m <= fingers.upper))
        return phase + ": fingers beyond their limits";
      const std::string held = holding(arm);
      if (!held.empty() && each.half_open_m != values_[index(model.gripper)])
        return phase + ": the fingers move while they hold " + held;
      values_[index(model.gripper)] = each.half_open_m;
      if (each.path.size() < 2) return phase + ": no motion";
      const auto checker = exact(arm);
      if (!checker) return phase + ": the scene cannot be checked";
      for (std::size_t j = 0; j < model.coordinates.size(); ++j)
        if (each.path.front().size() != model.coordinates.size() ||
            std::abs(each.path.front()[j] - values_[index(model.coordinates[j])]) > 1e-9)
          return phase + ": it does not begin where the arm is";
      for (std::size_t k = 1; k < each.path.size(); ++k) {
        if (!model.chain.within_limits(each.path[k], 1e-6)) return phase + ": beyond the limits of a joint";
        const motion::MotionVerdict verdict = checker->check_motion(each.path[k - 1], each.path[k]);
        if (verdict.kind != motion::MotionVerdict::Kind::Free)
          return phase + ": " + verdict.contact.link + " meets " + verdict.contact.other;
        ++judged_.motions;
      }
      for (std::size_t j = 0; j < model.coordinates.size(); ++j)
        values_[index(model.coordinates[j])] = each.path.back()[j];
    }
    return {};
  }

  std::string holding(int arm) const {
    for (std::size_t k = 0; k < things_.size(); ++k)
      if (things_[k].in == arm) return cell_.things[k].name;
    return {};
  }

  std::string end_of(const scene::PlannedAction& action) {
    switch (action.what.kind) {
      case ActionKind::Pick:
        return grasp(action);
      case ActionKind::Place:
        return release(action);
      case ActionKind::MoveAway:
        break;
    }
    return {};
  }

  std::string grasp(const scene::PlannedAction& action) {
    const int arm = action.what.arm;
    Standing& thing = things_[index(action.what.thing)];
    const scene::Form& form = cell_.things[index(action.what.thing)].form;
    if (thing.in || !holding(arm).empty()) return "somebody holds something";
    for (std::size_t k = 0; k < things_.size(); ++k)
      if (k != index(action.what.thing) && !things_[k].in && rests_on(k, index(action.what.thing)))
        return cell_.things[k].name + " stands on it";
    const Transform at = inverse(tip(arm)) * thing.at;  // the thing in the tool's frame
    // The tool's axis is the thing's, upside down, and its centre is within the thing.
    if (std::abs(at.rotation.column(2).z + 1.0) > 1e-8 ||
        std::hypot(at.position_m.x, at.position_m.y) > kTipMeetsMiddle_m)
      return "the hand is not above the middle";
    if (!(at.position_m.z > 0.0 && at.position_m.z < form.height_m)) return "the hand is too high or too low";
    values_[index(cell_.arms[index(arm)].gripper)] = form.radius_m;
    thing.at = at;
    thing.in = arm;
    return {};
  }

  // Whether one thing's underside is at the top of another one that it is over.
  bool rests_on(std::size_t upper, std::size_t lower) const {
    const motion::Vector3 above = things_[upper].at.position_m, below = things_[lower].at.position_m;
    const scene::Form &one = cell_.things[upper].form, &other = cell_.things[lower].form;
    return std::abs(above.z - below.z - other.height_m) < kShrunk_m &&
           std::hypot(above.x - below.x, above.y - below.y) < radius_around(one) + radius_around(other);
  }

  // What is wrong with what it stands on.
  std::string support_of(const scene::ActionSpec& what, const scene::Form& form,
                         const scene::Pose& pose) const {
    if (what.on < 0) {
      const scene::Surface& surface = cell_.surfaces[index(what.surface)];
      if (std::abs(pose.z_m - surface.middle.z_m) > kExact_m)
        return "it is not at the height of " + surface.name;
      return lies_within(surface, form, pose, kExact_m) ? "" : "it is not within " + surface.name;
    }
    const scene::Thing& below = cell_.things[index(what.on)];
    const Standing& there = things_[index(what.on)];
    if (there.in) return "somebody holds " + below.name;
    if (!below.carries) return below.name + " carries nothing";
    const motion::Vector3 at = there.at.position_m;
    if (std::abs(pose.z_m - at.z - below.form.height_m) > kExact_m)
      return "it is not at the height of " + below.name;
    if (std::hypot(pose.x_m - at.x, pose.y_m - at.y) > 2.0 * kTipMeetsMiddle_m)
      return "it is not over the middle of " + below.name;
    return fits_on(form, below.form) ? "" : "it stands out over " + below.name;
  }

  std::string release(const scene::PlannedAction& action) {
    const int arm = action.what.arm;
    const std::size_t which = index(action.what.thing);
    Standing& thing = things_[which];
    const scene::Form& form = cell_.things[which].form;
    if (thing.in != arm) return "the arm does not hold it";
    const Transform at = tip(arm) * thing.at;
    if (std::acos(std::clamp(at.rotation.column(2).z, -1.0, 1.0)) > kUpright_rad)
      return "it does not stand upright";
    const motion::Vector3 ahead = at.rotation.column(0);
    const scene::Pose pose{at.position_m.x, at.position_m.y, at.position_m.z, std::atan2(ahead.y, ahead.x)};
    if (std::string wrong = support_of(action.what, form, pose); !wrong.empty()) return wrong;
    const scene::Upright body = standing(form, pose);
    for (const scene::Furniture& each : cell_.furniture)
      if (meet(body, standing(each.form, each.pose), 0.0)) return "it meets " + each.name;
    for (std::size_t k = 0; k < things_.size(); ++k) {
      if (k == which || things_[k].in) continue;
      const motion::Vector3 other = things_[k].at.position_m;
      if (meet(body, standing(cell_.things[k].form, {other.x, other.y, other.z, 0.0}), 0.0))
        return "it meets " + cell_.things[k].name;
    }
    judged_.worst_place_m = std::max(
        judged_.worst_place_m, length(motion::Vector3{pose.x_m - action.pose.x_m, pose.y_m - action.pose.y_m,
                                                      pose.z_m - action.pose.z_m}));
    if (judged_.worst_place_m > kExact_m) return "it stands elsewhere than the plan says";
    thing.at = scene::frame_of(pose);
    thing.in.reset();
    const scene::ArmModel& model = cell_.arms[index(arm)];
    values_[index(model.gripper)] =
        std::min(form.radius_m + cell_.manner.opening_m, cell_.robot.coordinates[index(model.gripper)].upper);
    return {};
  }

  const scene::RobotCell& cell_;
  const scene::TampPlan& plan_;
  std::vector<double> values_;
  std::vector<Standing> things_;
  Judgement judged_;
};

}  // namespace

Judgement judge(const scene::RobotCell& cell, const scene::TampPlan& plan) {
  return Judge(cell, plan).run();
}

}  // namespace stepwright::tamp::judge
