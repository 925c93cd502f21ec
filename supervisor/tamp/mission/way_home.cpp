#include "supervisor/tamp/mission/way_home.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "supervisor/tamp/mission/observed_state.h"
#include "supervisor/tamp/mission/retreat.h"
#include "supervisor/tamp/predicates/certify.h"
#include "supervisor/tamp/predicates/samples.h"
#include "supervisor/tamp/predicates/workspace.h"
#include "supervisor/tamp/schedule/arm_capsules.h"

namespace stepwright::tamp::mission {
namespace {

using predicates::Sample;
using predicates::Settled;
using scene::ActionKind;
using scene::ActionSpec;

constexpr std::size_t kMostPlaces = 60;  // of a region that are tried
constexpr std::size_t kMostWays = 3;     // of the arm, of each place
constexpr int kTurns = 8;
// Of two arms. A plan that brings them nearer than 30 mm is refused (arms_program.h).
constexpr double kApart_m = 0.04;
constexpr double kNearer_m = 0.001;  // than they are, which does not count

class HomeFinder {
 public:
  HomeFinder(const scene::RobotCell& cell, const std::vector<Wanted>& wanted, const WayHomeOptions& options)
      : cell_(cell), wanted_(wanted), options_(options), workspace_(cell, options.seed) {}

  // One arm after the other, in this order.
  bool go(const scene::GeometricState& start, const std::vector<std::size_t>& arms) {
    state_ = start;
    settled_.clear();
    for (const std::size_t arm : arms) {
      draw_back(arm);
      if (!put_down(arm) || !leave(arm)) return false;
    }
    const auto uncertain = predicates::certify(workspace_, settled_, options_.seed, start, options_.leaves);
    if (!uncertain) return true;
    why_ = text_of(cell_, settled_[uncertain->action].action.what) + ": " + uncertain->what;
    return false;
  }

  WayHome take() {
    WayHome way;
    for (Settled& each : settled_) way.actions.push_back(std::move(each.action));
    way.after = std::move(state_);
    return way;
  }
  const std::string& why() const { return why_; }

 private:
  bool settle(const ActionSpec& action, const Sample& sample) {
    auto ways = workspace_.ways(state_, action, sample);
    if (!ways) return refused(action, ways.error());
    if (ways->size() > kMostWays) ways->resize(kMostWays);
    for (const predicates::ArmWay& way : *ways) {
      auto settled = workspace_.settle(state_, action, sample, way, true);
      if (!settled) {
        refused(action, settled.error());
        continue;
      }
      state_ = settled->after;
      settled_.push_back(*std::move(settled));
      return true;
    }
    return false;
  }

  bool refused(const ActionSpec& action, const predicates::Failure& failure) {
    why_ = text_of(cell_, action) + ": " + predicates::text_of(cell_, failure);
    kind_ = failure.kind;
    return false;
  }

  // Along the way that it came until it is clear, if it touches something where it is.
  void draw_back(std::size_t arm) {
    if (arm >= options_.back.size()) return;
    const motion::JointPath path =
        retreat({options_.known != nullptr ? *options_.known : cell_, cell_, state_, options_.seed}, arm,
                options_.back[arm]);
    if (path.empty()) return;
    scene::ArmState& here = state_.arms[arm];
    const int near = std::max(0, here.near);
    std::copy(path.back().begin(), path.back().end(), here.at.begin());
    here.near = -1;
    here.line.clear();
    scene::PlannedAction action{{ActionKind::MoveAway, static_cast<int>(arm), near}, 0.0, {}, {}};
    action.motions.push_back({scene::Phase::Lift, here.half_open_m, path});
    settled_.push_back({state_, std::move(action)});
  }

  // Where it is wanted first, then near by.
  bool put_down(std::size_t arm) {
    const int thing = state_.arms[arm].holds;
    if (thing < 0) return true;
    const motion::Transform tool = tool_of(cell_.arms[arm], state_.arms[arm].at);
    const motion::Vector3 ahead = tool.rotation.column(0);
    const double turned_rad = std::atan2(ahead.y, ahead.x) - state_.things[at(thing)].hand_rad;
    for (const auto& [surface, pose] : places_for(thing, tool)) {
      for (int turn = 0; turn < kTurns; ++turn) {
        scene::Pose there = pose;
        there.angle_rad = turned_rad + 2.0 * std::numbers::pi * turn / kTurns;
        if (settle({ActionKind::Place, static_cast<int>(arm), thing, surface, -1}, {0.0, there})) return true;
        // Whether there is room does not hang on the hand.
        if (kind_ == predicates::FailureKind::NoRoom) break;
      }
    }
    return false;
  }

  std::vector<std::pair<int, scene::Pose>> places_for(int thing, const motion::Transform& tool) const {
    const scene::Thing& what = cell_.things[at(thing)];
    std::vector<std::pair<int, scene::Pose>> wanted, others;
    for (std::size_t k = 0; k < cell_.surfaces.size(); ++k) {
      const auto surface = static_cast<int>(k);
      const bool here = std::ranges::any_of(
          wanted_, [&](const Wanted& each) { return each.thing == thing && each.surface == surface; });
      const auto shared = std::ranges::count(wanted_, surface, &Wanted::surface);
      std::vector<std::pair<int, scene::Pose>>& list = here ? wanted : others;
      // Of a region for one thing the middle is best; where more are to come, the corners.
      if (here && shared == 1)
        list.emplace_back(surface, predicates::place_on(cell_.surfaces[k], 0.0, 0.0, 0.0));
      for (std::size_t n = 0; n < std::min(kMostPlaces, cell_.manner.places); ++n)
        list.emplace_back(surface, predicates::place_sample(cell_.surfaces[k], what, n));
    }
    const auto far_m = [&](const std::pair<int, scene::Pose>& place) {
      return std::hypot(place.second.x_m - tool.position_m.x, place.second.y_m - tool.position_m.y);
    };
    std::ranges::stable_sort(others, {}, far_m);
    wanted.insert(wanted.end(), others.begin(), others.end());
    return wanted;
  }

  bool leave(std::size_t arm) {
    scene::ArmState& here = state_.arms[arm];
    if (here.at == cell_.arms[arm].home) {
      here.near = -1;
      here.line.clear();
      return true;
    }
    const ActionSpec away{ActionKind::MoveAway, static_cast<int>(arm), std::max(0, here.near)};
    const motion::JointPath line = here.line;
    // Straight up first, less far where that meets something or brings the arms too near to each other.
    const std::size_t apart = rows_apart(arm, line);
    for (std::size_t rows = line.size(); rows > 1; rows = (rows + 1) / 2)
      if (rows <= apart && leave_along(away, line, rows)) return true;
    if (leave_along(away, line, 0)) return true;
    for (std::size_t rows = line.size(); rows > 1; rows = (rows + 1) / 2)
      if (rows > apart && leave_along(away, line, rows)) return true;
    return false;
  }

  // So many rows of the line first.
  bool leave_along(const ActionSpec& away, const motion::JointPath& line, std::size_t rows) {
    state_.arms[at(away.arm)].line.assign(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(rows));
    return settle(away, {});
  }

  // Rows of the line up to which the arm stays as far from the others as the interlock wants, or as it is.
  std::size_t rows_apart(std::size_t arm, const motion::JointPath& line) {
    if (line.size() < 2) return line.size();
    for (std::size_t k = empty_.size(); k < cell_.arms.size(); ++k)
      empty_.push_back(schedule::arm_capsules(cell_, k));
    const std::vector<schedule::Capsule> others = schedule::others_at(empty_, cell_, state_, arm);
    const schedule::ArmCapsules own = schedule::with_held(empty_[arm], cell_, state_, arm);
    const auto room_m = [&](const motion::Configuration& row) {
      return schedule::distance_of(schedule::capsules_at(own, row), others);
    };
    const double least_m = std::min(kApart_m, room_m(line.front()) - kNearer_m);
    const auto near = std::ranges::find_if(line, [&](const auto& row) { return room_m(row) < least_m; });
    return static_cast<std::size_t>(near - line.begin());
  }

  const scene::RobotCell& cell_;
  const std::vector<Wanted>& wanted_;
  const WayHomeOptions& options_;
  predicates::Workspace workspace_;
  scene::GeometricState state_;
  std::vector<Settled> settled_;
  std::vector<schedule::ArmCapsules> empty_;  // of each arm, once they are asked for
  std::string why_;
  predicates::FailureKind kind_ = predicates::FailureKind::Impossible;  // of the last refusal
};

}  // namespace

result::Result<WayHome> way_home(const scene::RobotCell& cell, const scene::GeometricState& start,
                                 const std::vector<Wanted>& wanted, const WayHomeOptions& options) {
  std::vector<std::size_t> arms;
  for (std::size_t k = 0; k < cell.arms.size(); ++k) arms.push_back(k);
  if (options.last_first) std::ranges::reverse(arms);
  HomeFinder finder(cell, wanted, options);
  if (finder.go(start, arms)) return finder.take();
  const std::string why = finder.why();
  std::ranges::reverse(arms);
  if (finder.go(start, arms)) return finder.take();
  return result::fail("G0406", {}, "the arms find no way home from where they are: " + why,
                      "see to what is in the way, or move the arms by hand");
}

scene::GeometricState state_after(const scene::RobotCell& cell, scene::GeometricState state,
                                  const std::vector<scene::PlannedAction>& actions) {
  for (const scene::PlannedAction& each : actions) {
    scene::ArmState& arm = state.arms[at(each.what.arm)];
    scene::ThingState& thing = state.things[at(each.what.thing)];
    if (!each.motions.empty()) {
      const scene::Motion& last = each.motions.back();
      std::copy(last.path.back().begin(), last.path.back().end(), arm.at.begin());
      arm.line.clear();
      if (last.phase == scene::Phase::Lower) arm.line.assign(last.path.rbegin(), last.path.rend());
    }
    arm.near = -1;
    switch (each.what.kind) {
      case ActionKind::Pick:
        arm.holds = each.what.thing;
        arm.half_open_m = cell.grip_m(each.what.thing);
        thing.holder = each.what.arm;
        thing.hand_rad = each.hand_rad;
        break;
      case ActionKind::Place:
        arm.holds = -1;
        arm.near = each.what.thing;
        arm.half_open_m = cell.open_m(each.what.thing);
        thing.holder = -1;
        thing.pose = each.pose;
        break;
      case ActionKind::MoveAway:
        break;
    }
  }
  return state;
}

}  // namespace stepwright::tamp::mission
