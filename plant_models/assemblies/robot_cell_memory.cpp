// What outlives the process that simulates a robot cell: numbers in the order of keep().

#include <algorithm>
#include <cmath>

#include "plant_models/assemblies/robot_cell.h"

namespace stepwright::assemblies {
namespace {

constexpr std::size_t kOfGrasp = 9;   // object from 1, width, offset, turned, up; all 0 without one
constexpr std::size_t kOfObject = 6;  // pose, state, support
constexpr double kFarthestKeptObject_m = 10.0;

bool is_kept_place(std::span<const double> numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](double each) { return std::abs(each) <= kFarthestKeptObject_m; });
}

}  // namespace

std::size_t RobotCell::kept_size() const {
  return arms_.size() * (kArmJoints + 1 + kOfGrasp) + objects_.all().size() * kOfObject;
}

void RobotCell::keep(std::span<double> numbers) const {
  std::size_t at = 0;
  const auto put = [&](std::initializer_list<double> values) {
    for (const double value : values) numbers[at++] = value;
  };
  for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
    for (std::size_t k = 0; k < kArmJoints; ++k) put({drives_->angle_rad(arm * kArmJoints + k)});
    put({drives_->opening_m(arm)});
    const Grasp grasp = arms_[arm].grasp.value_or(Grasp{});
    put({arms_[arm].grasp ? static_cast<double>(grasp.object + 1) : 0.0, grasp.width_m, grasp.offset.x,
         grasp.offset.y, grasp.offset.z, grasp.turned_rad, grasp.up.x, grasp.up.y, grasp.up.z});
  }
  for (const CellObject& object : objects_.all()) {
    put({object.pose.place.x, object.pose.place.y, object.pose.place.z, object.pose.yaw_rad,
         static_cast<double>(object.state), static_cast<double>(object.support)});
  }
}

// Whether such an arm can have kept these; which object it holds, from 1.
bool RobotCell::can_be_arm(std::size_t arm, std::span<const double> kept) const {
  constexpr double kRounding = 1e-6;
  for (std::size_t k = 0; k < kArmJoints; ++k) {
    const JointFigures& joint = parameters_.arms[arm].joints[k];
    if (kept[k] < joint.lower_rad || kept[k] > joint.upper_rad) return false;
  }
  const double opening = kept[kArmJoints];
  const double held = kept[kArmJoints + 1];
  return opening >= -kRounding && opening <= parameters_.arms[arm].most_opening_m + kRounding &&
         held >= 0.0 && held <= static_cast<double>(objects_.all().size()) && held == std::floor(held);
}

bool RobotCell::restore_objects(std::span<const double> numbers, const std::vector<bool>& in_a_hand) {
  CellObjects restored = objects_;
  for (std::size_t k = 0; k < in_a_hand.size(); ++k) {
    const auto kept = numbers.subspan(k * kOfObject, kOfObject);
    const bool known = kept[4] == 0.0 || kept[4] == 1.0 || kept[4] == 2.0;
    const bool whole = kept[5] == std::floor(kept[5]) && std::abs(kept[5]) < 1e6;
    if (!is_kept_place(kept.first(3)) || !known || !whole || (kept[4] == 1.0) != in_a_hand[k]) return false;
    const ObjectPose pose{{kept[0], kept[1], kept[2]}, kept[3]};
    if (!restored.restore(k, pose, static_cast<ObjectState>(static_cast<int>(kept[4])),
                          static_cast<int>(kept[5])))
      return false;
  }
  objects_ = std::move(restored);
  return true;
}

void RobotCell::restore_arm(std::size_t arm, std::span<const double> kept) {
  Arm& here = arms_[arm];
  for (std::size_t k = 0; k < kArmJoints; ++k) {
    drives_->place(arm * kArmJoints + k, kept[k]);
    here.wanted[k] = static_cast<std::int16_t>(std::round(1e4 * kept[k]));
  }
  const double opening = kept[kArmJoints];
  const auto g = kept.subspan(kArmJoints + 1);
  here.grasp.reset();
  if (g[0] > 0.0)
    here.grasp = Grasp{.object = static_cast<std::size_t>(g[0]) - 1,
                       .width_m = g[1],
                       .offset = {g[2], g[3], g[4]},
                       .turned_rad = g[5],
                       .up = {g[6], g[7], g[8]},
                       .sliding_m_s = {},
                       .slid_m = 0.0};
  drives_->stop_hand_at(arm, std::clamp(opening, 0.0, parameters_.arms[arm].most_opening_m));
  HandMode hand = drives_->hand(arm);
  hand.least_m = here.grasp ? std::clamp(opening, 0.0, parameters_.arms[arm].most_opening_m) : 0.0;
  drives_->set_hand(arm, hand);
  // A hand that holds goes on pressing until the program says otherwise.
  here.opening = here.grasp ? std::int16_t{0} : static_cast<std::int16_t>(std::round(1e4 * opening));
  here.opening_before_m = opening;
  for (std::size_t k = 0; k < here.poses.size(); ++k) pose_arm(arm);
}

bool RobotCell::resume(std::span<const double> numbers) {
  constexpr std::size_t kOfArm = kArmJoints + 1 + kOfGrasp;
  const auto finite = [](double each) { return std::isfinite(each); };
  if (numbers.size() != kept_size() || !std::all_of(numbers.begin(), numbers.end(), finite)) return false;
  std::vector<bool> in_a_hand(objects_.all().size(), false);
  for (std::size_t arm = 0; arm < arms_.size(); ++arm) {
    const auto kept = numbers.subspan(arm * kOfArm, kOfArm);
    if (!can_be_arm(arm, kept)) return false;
    const auto held = static_cast<std::size_t>(kept[kArmJoints + 1]);
    if (held > 0) in_a_hand[held - 1] = true;
  }
  if (!restore_objects(numbers.subspan(arms_.size() * kOfArm), in_a_hand)) return false;
  for (std::size_t arm = 0; arm < arms_.size(); ++arm)
    restore_arm(arm, numbers.subspan(arm * kOfArm, kOfArm));
  changed_ = true;
  return true;
}

}  // namespace stepwright::assemblies
