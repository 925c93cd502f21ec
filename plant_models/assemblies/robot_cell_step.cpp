// One step of a robot cell: what is commanded, how the drives go, and what the judge says of it.

#include <algorithm>
#include <array>
#include <cmath>

#include "plant_models/assemblies/robot_cell.h"

namespace stepwright::assemblies {
namespace {

constexpr double kRadPerCount = 1e-4;
constexpr double kMPerCount = 1e-4;
constexpr double kDropped_m = 0.01;  // a lesser fall is being set down
constexpr double kLookAgain = 1e-6;  // rad and m that something has to move
constexpr double kWeight_m_s2 = 9.81;

}  // namespace

// What the weight of a held object does to a joint; two hands bear one half each.
double RobotCell::load_rad_s2(std::size_t arm, std::size_t joint) const {
  const Arm& here = arms_[arm];
  if (!here.grasp) return 0.0;
  const double share = other_holds(arm, here.grasp->object) ? 0.5 : 1.0;
  const double weight_n = share * objects_.mass_kg(here.grasp->object) * kWeight_m_s2;
  const Frame& frame = here.poses[0].joints[joint];
  const Vec3 axis = frame.turn * parameters_.arms[arm].joints[joint].axis;
  const Vec3 lever = objects_[here.grasp->object].pose.place - frame.place;
  return dot(axis, cross(lever, {0.0, 0.0, -weight_n})) / parameters_.drive.inertia_kgm2[joint];
}

void RobotCell::command(std::size_t arm) {
  Arm& here = arms_[arm];
  if (!here.enable) here.tripped = false;
  for (std::size_t k = 0; k < kArmJoints; ++k)
    if (here.enable && joint_faults_[arm * kArmJoints + k].overcurrent) here.tripped = true;
  const bool moves = here.enable && !here.tripped && !emergency_stop_;
  for (std::size_t k = 0; k < kArmJoints; ++k) {
    const JointFault& fault = joint_faults_[arm * kArmJoints + k];
    drives_->change(arm * kArmJoints + k, [&](JointMode& mode) {
      mode.wanted_rad = kRadPerCount * here.wanted[k];
      mode.braked = !moves;
      mode.stuck = fault.stuck;
      mode.runaway_rad_s = fault.runaway_rad_s;
      mode.load_rad_s2 = load_rad_s2(arm, k);
    });
  }
  command_hand(arm);
}

void RobotCell::command_hand(std::size_t arm) {
  HandMode hand = drives_->hand(arm);
  hand.wanted_m = std::clamp(kMPerCount * arms_[arm].opening, 0.0, parameters_.arms[arm].most_opening_m);
  hand.dead = arms_[arm].dead_hand;
  drives_->set_hand(arm, hand);
}

void RobotCell::pose_arm(std::size_t arm) {
  Arm& here = arms_[arm];
  here.poses[2] = here.poses[1];
  here.poses[1] = here.poses[0];
  here.poses[0] = arm_pose(parameters_.arms[arm], drives_->state().subspan(arm * kArmJoints, kArmJoints));
}

// A drive that is too far from its set point takes the whole arm with it.
void RobotCell::watch_drives(std::size_t arm) {
  for (std::size_t k = arm * kArmJoints; k < (arm + 1) * kArmJoints; ++k) {
    const JointMode& mode = drives_->joint(k);
    const double away = std::abs(mode.wanted_rad - drives_->angle_rad(k));
    if (!mode.braked && away > parameters_.drive.following_rad) arms_[arm].tripped = true;
  }
}

bool RobotCell::step() {
  for (std::size_t arm = 0; arm < arms_.size(); ++arm) command(arm);
  std::copy_n(drives_->state().begin(), before_.size(), before_.begin());
  if (!drives_->advance_to(end_s())) return false;
  for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
    pose_arm(arm);
    watch_drives(arm);
  }
  for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
    if (arms_[arm].grasp)
      hold_on(arm);
    else
      seek(arm);
    arms_[arm].opening_before_m = drives_->opening_m(arm);
  }
  if (objects_.step(kRobotCellStepS)) changed_ = true;
  for (const Landing& landing : objects_.landings())
    if (landing.height_m > kDropped_m)
      judge_.note_drop(landing.object, landing.support, landing.height_m, end_s());
  look();
  camera_.step(end_s());
  return true;
}

bool RobotCell::has_moved() const {
  const auto now = drives_->state();
  const std::size_t n = drives_->joints();
  const auto elsewhere = [&](std::size_t k) { return std::abs(now[k] - looked_[k]) > kLookAgain; };
  for (std::size_t k = 0; k < n; ++k)
    if (elsewhere(k)) return true;
  for (std::size_t k = 2 * n; k < now.size(); ++k)
    if (elsewhere(k)) return true;
  return false;
}

// Nobody puts something where an arm or a thing is: it stands as soon as there is room.
void RobotCell::put_blockages() {
  for (std::size_t k = 0; k < parameters_.blockages.size(); ++k)
    if (to_block_[k] && !blocked_[k] && judge_.has_room(k)) blocked_[k] = changed_ = true;
}

void RobotCell::look() {
  if (!changed_ && !has_moved()) return;
  changed_ = false;
  std::copy_n(drives_->state().begin(), looked_.size(), looked_.begin());
  std::array<ArmPose, kMostArms> poses;
  std::array<double, kMostArms> openings{};
  std::array<int, kMostArms> held{};
  for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
    poses[arm] = arms_[arm].poses[0];
    openings[arm] = drives_->opening_m(arm);
    held[arm] = arms_[arm].grasp ? static_cast<int>(arms_[arm].grasp->object) : -1;
  }
  const std::size_t n = arms_.size();
  const Look& found = judge_.look({std::span(poses).first(n), std::span(openings).first(n), &objects_,
                                   std::span(held).first(n), blocked_},
                                  end_s());
  for (std::size_t arm = 0; arm < n; ++arm)
    if (found.arm_stopped[arm]) stop_where_it_was(arm);
  for (std::size_t k = 0; k < found.touch_count; ++k) push(found.touches[k]);
  put_blockages();
}

void RobotCell::stop_where_it_was(std::size_t arm) {
  Arm& here = arms_[arm];
  here.tripped = true;
  for (std::size_t k = arm * kArmJoints; k < (arm + 1) * kArmJoints; ++k) drives_->place(k, before_[k]);
  here.poses[0] = here.poses[1];
  if (here.grasp && !other_holds(arm, here.grasp->object))
    objects_.move(here.grasp->object, carried(*here.grasp, here.poses[0].tool));
  changed_ = true;
}

// What gives way goes along with the body that it touches, on its surface.
void RobotCell::push(const Touch& touch) {
  const Arm& here = arms_[touch.arm];
  const CellObject& object = objects_[touch.object];
  if (object.state == ObjectState::Held) return;
  const std::size_t joint = parameters_.arms[touch.arm].bodies[touch.body].joint;
  const Frame& before = here.poses[1].joints[joint];
  const Vec3 moved = here.poses[0].joints[joint] * before.turn.back(object.pose.place - before.place);
  const Vec3 by = moved - object.pose.place;
  if (std::abs(by.x) < kLookAgain && std::abs(by.y) < kLookAgain) return;
  shift(touch.object, {by.x, by.y, 0.0});
}

void RobotCell::shift(std::size_t object, Vec3 by) {
  ObjectPose pose = objects_[object].pose;
  pose.place = pose.place + by;
  objects_.move(object, pose);
  changed_ = true;
}

}  // namespace stepwright::assemblies
