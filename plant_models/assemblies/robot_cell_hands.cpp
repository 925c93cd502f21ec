// The hands of a robot cell: what the fingers take, carry and lose.

#include <algorithm>
#include <cmath>

#include "plant_models/assemblies/robot_cell.h"

namespace stepwright::assemblies {
namespace {

constexpr double kReleased_m = 0.0005;   // fingers that have opened so far hold nothing
constexpr double kBeside_m = 0.001;      // a finger may be in a part by so much and still be beside it
constexpr double kOutOfPlace_m = 0.005;  // between two hands that hold one object
constexpr double kSlipped_m = 0.0005;    // a lesser way is none
constexpr double kPressedUp_m = 0.03;    // how far a surface may push an object up in a hand within a step

}  // namespace

bool RobotCell::other_holds(std::size_t arm, std::size_t object) const {
  for (std::size_t other = 0; other < arms_.size(); ++other)
    if (other != arm && arms_[other].grasp && arms_[other].grasp->object == object) return true;
  return false;
}

double RobotCell::grip_force_n(std::size_t arm) const {
  const double pressed_m = arms_[arm].grasp->width_m - drives_->hand(arm).wanted_m;
  return std::clamp(parameters_.hand.stiffness_n_m * pressed_m, 0.0, parameters_.hand.force_n);
}

// Looks for something between the fingers while they close; one finger that touches pushes it to the middle.
void RobotCell::seek(std::size_t arm) {
  const Arm& here = arms_[arm];
  const double opening = drives_->opening_m(arm);
  if (here.drops || !(opening < here.opening_before_m)) return;
  const Frame& tool = here.poses[0].tool;
  for (std::size_t k = 0; k < objects_.all().size(); ++k) {
    if (objects_[k].state == ObjectState::Falls) continue;
    for (const ObjectPart& part : objects_[k].shape.parts()) {
      const auto fit = fit_between(tool, objects_[k].pose, part);
      if (!fit) continue;
      const double side = std::abs(fit->side_m);
      if (side + 0.5 * fit->width_m > 0.5 * here.opening_before_m + kBeside_m) continue;  // not between them
      if (opening >= fit->width_m + 2.0 * side) continue;                                 // not yet
      const double left = std::max(0.0, 0.5 * (opening - fit->width_m));
      if (objects_[k].state == ObjectState::Stands)
        shift(k, std::copysign(side - left, -fit->side_m) * tool.turn.column(1));
      if (opening <= fit->width_m) take(arm, k, *fit);
      return;
    }
  }
}

void RobotCell::take(std::size_t arm, std::size_t object, const Fit& fit) {
  Arm& here = arms_[arm];
  here.grasp = grasped(object, fit.width_m, here.poses[0].tool, objects_[object].pose);
  here.slip_noted = false;
  drives_->stop_hand_at(arm, fit.width_m);
  objects_.hold(object);
  changed_ = true;
}

Vec3 RobotCell::acceleration_of(std::size_t arm) const {
  const Arm& here = arms_[arm];
  const auto place = [&](std::size_t k) { return here.poses[k].tool * here.grasp->offset; };
  return (1.0 / (kRobotCellStepS * kRobotCellStepS)) * (place(0) - 2.0 * place(1) + place(2));
}

void RobotCell::hold_on(std::size_t arm) {
  Arm& here = arms_[arm];
  if (here.drops || drives_->opening_m(arm) > here.grasp->width_m + kReleased_m) return release(arm);
  const bool second = arm > 0 && other_holds(arm, here.grasp->object);
  if (second)
    follow_other(arm);
  else
    carry(arm);
  const Grasp& grasp = *here.grasp;
  worst_tilt_rad_ = std::max(worst_tilt_rad_, tilt_rad(grasp, here.poses[0].tool));
  if (!here.slip_noted && grasp.slid_m > kSlipped_m && length(grasp.sliding_m_s) > 0.0) {
    here.slip_noted = true;
    judge_.note_slip(grasp.object, arm, end_s());
  }
  if (grasp.slid_m >= parameters_.hand.slide_out_m) release(arm);
}

void RobotCell::carry(std::size_t arm) {
  Arm& here = arms_[arm];
  Grasp& grasp = *here.grasp;
  const Frame& tool = here.poses[0].tool;
  const Vec3 acceleration = acceleration_of(arm);
  const double share = other_holds(arm, grasp.object) ? 0.5 : 1.0;
  slide(grasp, tool,
        {.mass_kg = share * objects_.mass_kg(grasp.object),
         .force_n = grip_force_n(arm),
         .friction = parameters_.hand.friction * (1.0 - here.friction_lost),
         .acceleration_m_s2 = acceleration,
         .step_s = kRobotCellStepS});
  ObjectPose pose = carried(grasp, tool);
  // It cannot go into what it is set down on: then it is pushed up in the hand.
  const double surface = objects_.surface_below_m(grasp.object, pose.place + Vec3{0.0, 0.0, kPressedUp_m});
  if (pose.place.z < surface) {
    const Vec3 up{0.0, 0.0, surface - pose.place.z};
    grasp.offset = grasp.offset + tool.turn.back(up);
    grasp.slid_m += up.z;
    grasp.sliding_m_s = {};
    pose = carried(grasp, tool);
  }
  if (pose == objects_[grasp.object].pose) return;
  objects_.move(grasp.object, pose);
  objects_.shake(grasp.object, acceleration, kRobotCellStepS);
  if (length(grasp.sliding_m_s) > 0.0) changed_ = true;
}

// The first hand says where the object is; in the second one it slips where that is not where it was taken.
void RobotCell::follow_other(std::size_t arm) {
  Arm& here = arms_[arm];
  Grasp& grasp = *here.grasp;
  const Frame& tool = here.poses[0].tool;
  const ObjectPose& pose = objects_[grasp.object].pose;
  const Vec3 away = pose.place - tool * grasp.offset;
  grasp.sliding_m_s = {};
  if (length(away) < kOutOfPlace_m) return;
  grasp.slid_m += length(away);
  grasp.sliding_m_s = (1.0 / kRobotCellStepS) * away;
  grasp.offset = tool.turn.back(pose.place - tool.place);
}

void RobotCell::release(std::size_t arm) {
  Arm& here = arms_[arm];
  const Grasp grasp = *here.grasp;
  const Vec3 carried_m_s =
      (1.0 / kRobotCellStepS) * (here.poses[0].tool * grasp.offset - here.poses[1].tool * grasp.offset);
  here.grasp.reset();
  HandMode hand = drives_->hand(arm);
  hand.least_m = 0.0;
  drives_->set_hand(arm, hand);
  if (!other_holds(arm, grasp.object)) objects_.let_go(grasp.object, carried_m_s + grasp.sliding_m_s);
  changed_ = true;
}

}  // namespace stepwright::assemblies
