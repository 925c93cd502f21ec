#include "supervisor/tamp/predicates/workspace.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "supervisor/tamp/predicates/transfer.h"

namespace stepwright::tamp::predicates {

namespace {

using scene::ActionKind;
using scene::ActionSpec;
using scene::GeometricState;

constexpr std::size_t kMostCheckers = 256, kMostWays = 65'536;
// Between places of a path that are checked, in each joint: the last check of a plan finds what lies between.
constexpr double kPathStep_rad = 0.03;

std::size_t at(int number) {
  return static_cast<std::size_t>(number);
}

std::uint64_t bit_of(std::size_t k) {
  return std::uint64_t{1} << k;
}

motion::Configuration vector_of(const scene::JointValues& values) {
  return {values.begin(), values.end()};
}

std::vector<double> flat(const motion::JointPath& path) {
  std::vector<double> rows;
  for (const motion::Configuration& each : path) rows.insert(rows.end(), each.begin(), each.end());
  return rows;
}

}  // namespace

Workspace::Workspace(const scene::RobotCell& cell, std::uint64_t seed)
    : cell_(&cell), seed_(seed), path_nodes_(cell.manner.path_nodes) {
  for (const scene::ArmModel& arm : cell.arms) {
    // What is carried follows the robot's links: no hand holds more than one thing.
    std::vector<std::uint8_t> links(cell.robot.links.size() + cell.arms.size(), 1);
    for (std::size_t link = 0; link < cell.robot.links.size(); ++link)
      links[link] = cell.robot.hangs_below(static_cast<int>(link), arm.carrier) ? 1 : 0;
    hand_links_.push_back(std::move(links));
  }
}

std::size_t Workspace::WayHash::operator()(const WayKey& key) const {
  std::uint64_t hash = static_cast<std::uint64_t>(key.arm);
  for (const double value : {key.place.x_m, key.place.y_m, key.place.z_m, key.place.angle_rad})
    hash = (hash ^ (hash >> 29U) ^ std::bit_cast<std::uint64_t>(value)) * 0x9E3779B97F4A7C15U;
  return static_cast<std::size_t>(hash ^ (hash >> 32U));
}

const std::vector<ArmWay>& Workspace::all_ways_of(int arm, const ToolPlace& place) {
  const WayKey key{arm, place};
  if (const auto known = ways_.find(key); known != ways_.end()) return known->second;
  if (ways_.size() >= kMostWays) ways_.clear();
  return ways_.emplace(key, all_ways(cell_->arms[at(arm)], place, cell_->manner.lift_m)).first->second;
}

// Opened for what it goes to, or closed on what it holds.
double Workspace::half_open_on_the_way(const GeometricState& state, const ActionSpec& action) const {
  return action.kind == ActionKind::Pick ? cell_->open_m(action.thing)
                                         : state.arms[at(action.arm)].half_open_m;
}

tl::unexpected<Failure> Workspace::fail(const Failure& failure) {
  ++counts_.failed;
  return tl::unexpected<Failure>(failure);
}

// What is where this one would come down or be.
Failure Workspace::meeting_thing(const GeometricState& state, int thing, const scene::Pose& pose) const {
  scene::Upright body = standing(cell_->things[at(thing)].form, pose);
  body.high_m += cell_->manner.lift_m;
  Failure met{FailureKind::NoRoom};
  for (std::size_t k = 0; k < cell_->furniture.size(); ++k)
    if (meet(body, standing(cell_->furniture[k].form, cell_->furniture[k].pose),
             cell_->manner.things_apart_m))
      met.furniture |= bit_of(k);
  if (met.furniture != 0) return met;
  for (std::size_t k = 0; k < cell_->things.size(); ++k)
    if (k != at(thing) && state.things[k].holder < 0 &&
        meet(body, standing(cell_->things[k].form, state.things[k].pose), cell_->manner.things_apart_m))
      met.things |= bit_of(k);
  return met;
}

std::uint64_t Workspace::standing_on(const GeometricState& state, int thing) const {
  std::uint64_t above = 0;
  for (std::size_t k = 0; k < cell_->things.size(); ++k)
    if (k != at(thing) && state.things[k].holder < 0 &&
        stands_on(cell_->things[k].form, state.things[k].pose, cell_->things[at(thing)].form,
                  state.things[at(thing)].pose))
      above |= bit_of(k);
  return above;
}

// Whether there is no support or no room for what is placed.
std::optional<Failure> Workspace::refused_place(const GeometricState& state, const ActionSpec& action,
                                                const Sample& sample) const {
  const scene::Form& form = cell_->things[at(action.thing)].form;
  if (action.on < 0) {
    if (!lies_within(cell_->surfaces[at(action.surface)], form, sample.pose))
      return Failure{FailureKind::NoRoom};
  } else {
    const scene::Thing& below = cell_->things[at(action.on)];
    const scene::ThingState& there = state.things[at(action.on)];
    if (!below.carries || there.holder >= 0 || action.on == action.thing)
      return Failure{FailureKind::Impossible};
    if (!fits_on(form, below.form) ||
        sample.pose != top_of(*cell_, action.on, there.pose, sample.pose.angle_rad))
      return Failure{FailureKind::NoRoom};
  }
  const Failure met = meeting_thing(state, action.thing, sample.pose);
  return met.things == 0 && met.furniture == 0 ? std::nullopt : std::optional(met);
}

Failure Workspace::meeting_hand(const GeometricState& state, int arm, int thing,
                                const ToolPlace& tool) const {
  Failure met{FailureKind::HandMeets};
  for (const scene::HandPart& part : cell_->arms[at(arm)].hand_of[at(thing)]) {
    const scene::Upright body =
        placed(part, tool.x_m, tool.y_m, tool.z_m, tool.angle_rad, cell_->manner.lift_m);
    for (std::size_t k = 0; k < cell_->furniture.size(); ++k)
      if (meet(body, standing(cell_->furniture[k].form, cell_->furniture[k].pose), cell_->manner.clearance_m))
        met.furniture |= bit_of(k);
    for (std::size_t k = 0; k < cell_->things.size(); ++k)
      if (k != at(thing) && state.things[k].holder < 0 &&
          meet(body, standing(cell_->things[k].form, state.things[k].pose), cell_->manner.clearance_m))
        met.things |= bit_of(k);
  }
  if (met.furniture != 0) met.things = 0;
  return met;
}

double Workspace::hand_room(int arm, int thing, const ToolPlace& tool,
                            const std::vector<scene::Upright>& others) const {
  double least_m = 1.0;
  for (const scene::HandPart& part : cell_->arms[at(arm)].hand_of[at(thing)]) {
    const scene::Upright body =
        placed(part, tool.x_m, tool.y_m, tool.z_m, tool.angle_rad, cell_->manner.lift_m);
    for (const scene::Upright& other : others)
      if (share_heights(body, other)) least_m = std::min(least_m, gap(body, other));
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
    if (arm.holds >= 0) return fail({FailureKind::Impossible});
    ArmWay home;
    home.top = cell_->arms[at(action.arm)].home;
    return std::vector{home};
  }
  const bool pick = action.kind == ActionKind::Pick;
  if (pick ? arm.holds >= 0 || thing.holder >= 0 : thing.holder != action.arm)
    return fail({FailureKind::Impossible});
  const ToolPlace tool = tool_of(state, action, sample);
  if (pick) {
    if (const std::uint64_t above = standing_on(state, action.thing); above != 0)
      return fail({FailureKind::HandMeets, above});
  } else if (const auto refused = refused_place(state, action, sample)) {
    return fail(*refused);
  }
  const Failure met = meeting_hand(state, action.arm, action.thing, tool);
  if (met.things != 0 || met.furniture != 0) return fail(met);
  std::vector<ArmWay> found = all_ways_of(action.arm, tool);
  if (found.empty()) return fail({FailureKind::OutOfReach});
  sort_ways(found, arm.at);
  return found;
}

const Workspace::Checkers& Workspace::checkers(const GeometricState& state, int arm, double half_open_m) {
  const std::uint64_t key = fingerprint_around(state, arm, half_open_m);
  if (const auto known = checkers_.find(key); known != checkers_.end()) return known->second;
  if (checkers_.size() >= kMostCheckers) checkers_.clear();
  const scene::Surroundings around = surroundings(*cell_, state, 0.0);
  const scene::ArmModel& model = cell_->arms[at(arm)];
  std::vector<double> rest = values_of(*cell_, state);
  rest[at(model.gripper)] = half_open_m;
  // The world is made of sound solids: it cannot fail.
  motion::CollisionChecker all = *motion::CollisionChecker::make(
      cell_->robot, cell_->spheres, &cell_->semantics, around.world, model.coordinates, rest, around.held);
  motion::CollisionChecker line = all.without_world(hand_links_[at(arm)]);
  return checkers_.emplace(key, Checkers{std::move(all), std::move(line)}).first->second;
}

const motion::CollisionChecker& Workspace::path_checker(const GeometricState& state, int arm) {
  return checkers(state, arm, state.arms[at(arm)].half_open_m).all;
}

motion::JointSpace Workspace::joint_space(int arm) const {
  return motion::joint_space(cell_->robot, cell_->arms[at(arm)].coordinates);
}

bool Workspace::line_is_free(const GeometricState& state, int arm, double half_open_m,
                             const motion::JointPath& line) {
  return checkers(state, arm, half_open_m).line.all_free(flat(line));
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
    if (!found) return fail({FailureKind::OutOfReach});
    line = *std::move(found);
    if (!line_is_free(state, action.arm, half_open_on_the_way(state, action), line))
      return fail({FailureKind::ArmMeets});
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
    if (!line_is_free(before, action.arm, arm.half_open_m, arm.line)) return fail({FailureKind::ArmMeets});
    motions.push_back({scene::Phase::Lift, arm.half_open_m, arm.line});
  }
  const double half_open_m = half_open_on_the_way(before, action);
  const motion::Configuration from = arm.line.empty() ? vector_of(arm.at) : arm.line.back();
  const motion::Configuration to = there.line.empty() ? vector_of(there.at) : there.line.back();
  motion::PathOptions options;
  options.seed = seed_ * 1'000'003U + counts_.paths++;
  options.most_nodes = path_nodes_;
  options.step = kPathStep_rad;
  Transfer found = transfer(checkers(before, action.arm, half_open_m).all, joint_space(action.arm),
                            cell_->arms[at(action.arm)], from, to, options);
  if (found.means == Means::Straight) ++counts_.straight_paths;
  if (found.means == Means::Trees) ++counts_.tree_paths;
  counts_.path_motions += found.motions;
  if (found.path.empty()) {
    ++counts_.failed_paths;
    return fail({FailureKind::NoPath});
  }
  motions.push_back({scene::Phase::Transfer, half_open_m, std::move(found.path)});
  if (!there.line.empty())
    motions.push_back({scene::Phase::Lower, half_open_m, {there.line.rbegin(), there.line.rend()}});
  return motions;
}

}  // namespace stepwright::tamp::predicates
