#include "supervisor/tamp/intervals/sequence/work_cell.h"

#include <cmath>
#include <utility>

namespace stepwright::tamp {
namespace {

class CellCheck {
 public:
  CellCheck(const WorkCell& cell, const std::string& where, std::span<const result::Location> actions_at)
      : cell_(cell),
        at_{where, 0, 0},
        actions_at_(actions_at),
        held_by_(cell.objects.size()),
        in_hand_(cell.arms.size()),
        stands_on_(cell.objects.size()) {}

  result::Result<void> check(std::span<const Action> sequence) {
    check_figures();
    for (std::size_t k = 0; k < sequence.size(); ++k) {
      step_ = "action " + std::to_string(k + 1);
      if (k < actions_at_.size()) at_ = actions_at_[k];
      if (exists(sequence[k])) follow(sequence[k]);
    }
    if (!wrong_.empty()) return tl::unexpected(std::move(wrong_));
    return {};
  }

 private:
  void complain(const char* code, std::string message, std::string hint = {}) {
    wrong_.push_back({code, result::Severity::Error, at_, std::move(message), std::move(hint)});
  }
  void number(const std::string& what, double value, double low, double high) {
    if (value >= low && value <= high) return;  // not a number is in no range
    complain("I0101", what + " is not from " + std::to_string(low) + " to " + std::to_string(high));
  }

  void check_figures() {
    for (const Arm& arm : cell_.arms)
      if (arm.reach == nullptr) complain("I0103", "arm '" + arm.name + "' has no reach");
    for (const Grasp& grasp : cell_.grasps) {
      number("grasp '" + grasp.name + "': height_m", grasp.height_m, -2.0, 2.0);
      number("grasp '" + grasp.name + "': radius_m", grasp.radius_m, 0.0, 1.0);
      for (const AngleRange range : grasp.angles) {
        number("grasp '" + grasp.name + "': an angle", range.low_rad, -10.0, 10.0);
        number("grasp '" + grasp.name + "': an angle", range.high_rad, range.low_rad, 20.0);
      }
    }
    for (const Region& region : cell_.regions) {
      const std::string name = "region '" + region.name + "': ";
      for (const double at : {region.x_m, region.y_m, region.z_m})
        number(name + "a coordinate", at, -0.9 * kFarthest_m, 0.9 * kFarthest_m);
      for (const double size : {region.size_x_m, region.size_y_m}) number(name + "a size", size, 0.0, 5.0);
      number(name + "heading_rad", region.heading_rad, -10.0, 10.0);
    }
    for (const Object& object : cell_.objects) {
      const std::string name = "object '" + object.name + "': ";
      for (const double at : {object.start.x_m, object.start.y_m, object.start.z_m})
        number(name + "a coordinate", at, -0.9 * kFarthest_m, 0.9 * kFarthest_m);
      number(name + "angle_rad", object.start.angle_rad, -10.0, 10.0);
      number(name + "height_m", object.height_m, 0.0, 2.0);
    }
  }

  bool exists(const Action& action) {
    const bool moves = action.kind != ActionKind::MoveAway;
    bool known = action.arm < cell_.arms.size() && (!moves || action.object < cell_.objects.size());
    if (action.kind == ActionKind::Pick) known = known && action.grasp < cell_.grasps.size();
    if (action.region) known = known && *action.region < cell_.regions.size();
    if (action.on) known = known && *action.on < cell_.objects.size();
    for (const Beyond& beyond : action.beyond) known = known && beyond.object < cell_.objects.size();
    if (!known) complain("I0103", step_ + ": it names something that the cell has not");
    return known;
  }

  void follow(const Action& action) {
    if (action.final_angle_rad) number(step_ + ": its angle", *action.final_angle_rad, -10.0, 10.0);
    for (const Beyond& beyond : action.beyond) {
      number(step_ + ": a direction", beyond.direction_rad, -10.0, 10.0);
      number(step_ + ": a distance", beyond.distance_m, 0.0, kFarthest_m);
    }
    if (action.kind == ActionKind::Pick) follow_pick(action);
    if (action.kind == ActionKind::Place) follow_place(action);
  }

  void follow_pick(const Action& action) {
    const std::string& object = cell_.objects[action.object].name;
    if (held_by_[action.object]) return complain("I0102", step_ + ": '" + object + "' is held already");
    if (in_hand_[action.arm])
      return complain("I0102", step_ + ": arm '" + cell_.arms[action.arm].name + "' holds something already");
    for (std::size_t k = 0; k < stands_on_.size(); ++k)
      if (stands_on_[k] == action.object)
        complain("I0102", step_ + ": '" + cell_.objects[k].name + "' stands on '" + object + "'");
    stands_on_[action.object].reset();
    held_by_[action.object] = action.arm;
    in_hand_[action.arm] = action.object;
  }

  void follow_place(const Action& action) {
    const std::string& object = cell_.objects[action.object].name;
    if (held_by_[action.object] != action.arm)
      return complain("I0102",
                      step_ + ": arm '" + cell_.arms[action.arm].name + "' does not hold '" + object + "'");
    if (action.region.has_value() == action.on.has_value())
      complain("I0102", step_ + ": a place is on one region or on one object");
    if (action.on && (*action.on == action.object || held_by_[*action.on]))
      complain("I0102", step_ + ": what '" + object + "' is placed on is held itself");
    for (const Beyond& beyond : action.beyond)
      if (beyond.object == action.object || held_by_[beyond.object])
        complain("I0102", step_ + ": what '" + object + "' is to lie beyond is held itself");
    stands_on_[action.object] = action.on;
    held_by_[action.object].reset();
    in_hand_[action.arm].reset();
  }

  const WorkCell& cell_;
  result::Location at_;
  std::span<const result::Location> actions_at_;
  std::string step_;
  std::vector<std::optional<std::size_t>> held_by_, in_hand_, stands_on_;
  result::Diagnostics wrong_;
};

}  // namespace

std::string text_of(const WorkCell& cell, const Action& action) {
  const std::string& arm = cell.arms[action.arm].name;
  if (action.kind == ActionKind::MoveAway) return arm + " moves away";
  const std::string& object = cell.objects[action.object].name;
  if (action.kind == ActionKind::Pick) return arm + " picks " + object;
  const std::string& target =
      action.region ? cell.regions[*action.region].name : cell.objects[*action.on].name;
  return arm + " places " + object + " on " + target;
}

result::Result<void> validate(const WorkCell& cell, std::span<const Action> sequence,
                              const std::string& where, std::span<const result::Location> actions_at) {
  return CellCheck(cell, where, actions_at).check(sequence);
}

}  // namespace stepwright::tamp
