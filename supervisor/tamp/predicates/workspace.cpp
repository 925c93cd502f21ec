#include "supervisor/tamp/predicates/workspace.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace stepwright::tamp::predicates {

namespace {

using scene::ActionKind;
using scene::ActionSpec;
using scene::GeometricState;

constexpr std::size_t kMostCheckers = 256;

std::size_t at(int number) {
  return static_cast<std::size_t>(number);
}

motion::Configuration vector_of(const scene::JointValues& values) {
  return {values.begin(), values.end()};
}

std::vector<double> flat(const motion::JointPath& path) {
  std::vector<double> rows;
  for (const motion::Configuration& each : path) rows.insert(rows.end(), each.begin(), each.end());
  return rows;
}

// What the arm does on its way: opened for what it goes to, or closed on what it holds.
GeometricState on_the_way(const scene::RobotCell& cell, const GeometricState& state,
                          const ActionSpec& action) {
  GeometricState moving = state;
  if (action.kind == ActionKind::Pick) moving.arms[at(action.arm)].half_open_m = cell.open_m(action.thing);
  return moving;
}

}  // namespace

const char* name_of(FailureKind kind) {
  switch (kind) {
    case FailureKind::NoRoom:
      return "no room";
    case FailureKind::HandMeets:
      return "the hand meets something";
    case FailureKind::OutOfReach:
      return "out of reach";
    case FailureKind::ArmMeets:
      return "the arm meets something";
    case FailureKind::NoPath:
      return "no path was found";
    default:
      return "impossible";
  }
}

tl::unexpected<Failure> Workspace::fail(FailureKind kind, std::uint64_t things) {
  ++counts_.failed;
  return tl::unexpected<Failure>(Failure{kind, things});
}

// Things that stand where this one would come down or be.
std::uint64_t Workspace::meeting_thing(const GeometricState& state, int thing, const scene::Pose& pose,
                                       bool& furniture) const {
  scene::Upright body = standing(cell_->things[at(thing)].form, pose);
  body.high_m += cell_->manner.lift_m;
  for (const scene::Furniture& each : cell_->furniture)
    if (meet(body, standing(each.form, each.pose), cell_->manner.things_apart_m)) furniture = true;
  std::uint64_t met = 0;
  for (std::size_t k = 0; k < cell_->things.size(); ++k)
    if (k != at(thing) && state.things[k].holder < 0 &&
        meet(body, standing(cell_->things[k].form, state.things[k].pose), cell_->manner.things_apart_m))
      met |= std::uint64_t{1} << k;
  return met;
}

std::uint64_t Workspace::meeting_hand(const GeometricState& state, int arm, int thing, const ToolPlace& tool,
                                      bool& furniture) const {
  std::uint64_t met = 0;
  for (const scene::HandPart& part : cell_->arms[at(arm)].hand_of[at(thing)]) {
    const scene::Upright body =
        placed(part, tool.x_m, tool.y_m, tool.z_m, tool.angle_rad, cell_->manner.lift_m);
    for (const scene::Furniture& each : cell_->furniture)
      if (meet(body, standing(each.form, each.pose), cell_->manner.clearance_m)) furniture = true;
    for (std::size_t k = 0; k < cell_->things.size(); ++k)
      if (k != at(thing) && state.things[k].holder < 0 &&
          meet(body, standing(cell_->things[k].form, state.things[k].pose), cell_->manner.clearance_m))
        met |= std::uint64_t{1} << k;
  }
  return met;
}

double Workspace::hand_room(int arm, int thing, const ToolPlace& tool,
                            const std::vector<scene::Upright>& others) const {
  double least_m = 1.0;
  for (const scene::HandPart& part : cell_->arms[at(arm)].hand_of[at(thing)]) {
    const scene::Upright body =
        placed(part, tool.x_m, tool.y_m, tool.z_m, tool.angle_rad, cell_->manner.lift_m);
    for (const scene::Upright& other : others)
      if (meet(body, other, 1.0)) least_m = std::min(least_m, gap(body, other));
  }
  return least_m;
}

ToolPlace Workspace::tool_of(const GeometricState& state, const ActionSpec& action,
                             const Sample& sample) const {
  const scene::ThingState& thing = state.things[at(action.thing)];
  const scene::Pose& pose = action.kind == ActionKind::Pick ? thing.pose : sample.pose;
  const double hand_rad = action.kind == ActionKind::Pick ? sample.hand_rad : thing.hand_rad;
  return {pose.x_m, pose.y_m, pose.z_m + cell_->tool_above(action.thing), pose.angle_rad + hand_rad};
}

tl::expected<std::vector<ArmWay>, Failure> Workspace::ways(const GeometricState& state,
                                                           const ActionSpec& action, const Sample& sample) {
  const scene::ArmState& arm = state.arms[at(action.arm)];
  const scene::ThingState& thing = state.things[at(action.thing)];
  if (action.kind == ActionKind::MoveAway) {
    if (arm.holds >= 0) return fail(FailureKind::Impossible);
    ArmWay home;
    home.bottom = home.top = cell_->arms[at(action.arm)].home;
    return std::vector{home};
  }
  const bool pick = action.kind == ActionKind::Pick;
  if (pick ? arm.holds >= 0 || thing.holder >= 0 : thing.holder != action.arm)
    return fail(FailureKind::Impossible);
  const ToolPlace tool = tool_of(state, action, sample);
  bool furniture = false;
  if (!pick) {
    if (!lies_within(cell_->surfaces[at(action.surface)], cell_->things[at(action.thing)].form, sample.pose))
      return fail(FailureKind::NoRoom);
    const std::uint64_t met = meeting_thing(state, action.thing, sample.pose, furniture);
    if (met != 0 || furniture) return fail(FailureKind::NoRoom, furniture ? 0 : met);
  }
  const std::uint64_t met = meeting_hand(state, action.arm, action.thing, tool, furniture);
  if (met != 0 || furniture) return fail(FailureKind::HandMeets, furniture ? 0 : met);
  std::vector<ArmWay> found = arm_ways(cell_->arms[at(action.arm)], tool, cell_->manner.lift_m, arm.at);
  if (found.empty()) return fail(FailureKind::OutOfReach);
  return found;
}

const Workspace::Checkers& Workspace::checkers(const GeometricState& state, int arm) {
  GeometricState around = state;
  around.arms[at(arm)].at = {};
  for (scene::ArmState& each : around.arms) each.line.clear();
  const std::uint64_t key = fingerprint(around) + static_cast<std::uint64_t>(arm);
  if (const auto known = checkers_.find(key); known != checkers_.end()) return known->second;
  if (checkers_.size() >= kMostCheckers) checkers_.clear();
  const scene::Surroundings around_it = surroundings(*cell_, state, 0.0);
  const std::vector<double> rest = values_of(*cell_, state);
  const scene::ArmModel& model = cell_->arms[at(arm)];
  const auto make = [&](const motion::SphereModel& spheres, const motion::World& world,
                        const std::vector<motion::AttachedBody>& held) {
    // The world is made of sound solids: it cannot fail.
    return *motion::CollisionChecker::make(cell_->robot, spheres, &cell_->semantics, world, model.coordinates,
                                           rest, held);
  };
  return checkers_
      .emplace(key, Checkers{make(cell_->spheres, {}, around_it.held),
                             make(model.without_hand, around_it.world, {}),
                             make(cell_->spheres, around_it.world, around_it.held)})
      .first->second;
}

const motion::CollisionChecker& Workspace::path_checker(const GeometricState& state, int arm) {
  return checkers(state, arm).all;
}

motion::JointSpace Workspace::joint_space(int arm) const {
  return motion::joint_space(cell_->robot, cell_->arms[at(arm)].coordinates);
}

bool Workspace::line_is_free(const GeometricState& state, int arm, const motion::JointPath& line) {
  const Checkers& check = checkers(state, arm);
  const std::vector<double> rows = flat(line);
  return check.without_hand.all_free(rows) && check.with_itself.all_free(rows);
}

GeometricState Workspace::after(const GeometricState& state, const ActionSpec& action, const Sample& sample,
                                motion::JointPath line) const {
  GeometricState next = state;
  scene::ArmState& arm = next.arms[at(action.arm)];
  scene::ThingState& thing = next.things[at(action.thing)];
  if (action.kind == ActionKind::MoveAway) {
    arm.at = cell_->arms[at(action.arm)].home;
    arm.near = -1;
    arm.line.clear();
    return next;
  }
  std::copy(line.front().begin(), line.front().end(), arm.at.begin());
  arm.line = std::move(line);
  if (action.kind == ActionKind::Pick) {
    arm.holds = action.thing;
    arm.near = -1;
    arm.half_open_m = cell_->grip_m(action.thing);
    thing.holder = action.arm;
    thing.hand_rad = sample.hand_rad;
  } else {
    arm.holds = -1;
    arm.near = action.thing;
    arm.half_open_m = cell_->open_m(action.thing);
    thing.holder = -1;
    thing.pose = sample.pose;
  }
  return next;
}

tl::expected<Settled, Failure> Workspace::settle(const GeometricState& state, const ActionSpec& action,
                                                 const Sample& sample, const ArmWay& way, bool with_path) {
  motion::JointPath line;
  if (action.kind != ActionKind::MoveAway) {
    const scene::Manner& manner = cell_->manner;
    auto found = line_of(cell_->arms[at(action.arm)], tool_of(state, action, sample), manner.lift_m,
                         manner.line_step_m, way);
    if (!found) return fail(FailureKind::OutOfReach);
    line = *std::move(found);
    if (!line_is_free(on_the_way(*cell_, state, action), action.arm, line))
      return fail(FailureKind::ArmMeets);
  }
  const bool pick = action.kind == ActionKind::Pick;
  Settled settled{after(state, action, sample, std::move(line)),
                  {action, sample.hand_rad, pick ? state.things[at(action.thing)].pose : sample.pose, {}}};
  if (with_path) {
    auto motions = connect(state, settled);
    if (!motions) return tl::unexpected<Failure>(motions.error());
    settled.action.motions = *std::move(motions);
  }
  ++counts_.configurations;
  return settled;
}

tl::expected<std::vector<scene::Motion>, Failure> Workspace::connect(const GeometricState& before,
                                                                     const Settled& settled) {
  const ActionSpec& action = settled.action.what;
  const scene::ArmState& arm = before.arms[at(action.arm)];
  const scene::ArmState& there = settled.after.arms[at(action.arm)];
  std::vector<scene::Motion> motions;
  if (!arm.line.empty()) {
    if (!line_is_free(before, action.arm, arm.line)) return fail(FailureKind::ArmMeets);
    motions.push_back({scene::Phase::Lift, arm.half_open_m, arm.line});
  }
  const GeometricState moving = on_the_way(*cell_, before, action);
  const double half_open_m = moving.arms[at(action.arm)].half_open_m;
  const motion::Configuration from = arm.line.empty() ? vector_of(arm.at) : arm.line.back();
  const motion::Configuration to = there.line.empty() ? vector_of(there.at) : there.line.back();
  motion::PathOptions options;
  options.seed = seed_ * 1'000'003U + counts_.paths++;
  options.most_nodes = cell_->manner.path_nodes;
  motion::PathAnswer answer =
      motion::plan_path(checkers(moving, action.arm).all, joint_space(action.arm), from, {to}, options);
  if (answer.path.empty()) {
    ++counts_.failed_paths;
    return fail(FailureKind::NoPath);
  }
  motions.push_back({scene::Phase::Transfer, half_open_m, std::move(answer.path)});
  if (!there.line.empty())
    motions.push_back({scene::Phase::Lower, half_open_m, {there.line.rbegin(), there.line.rend()}});
  return motions;
}

}  // namespace stepwright::tamp::predicates
