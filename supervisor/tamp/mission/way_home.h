#pragma once

// Brings arms home from wherever they are, as a part of a plan: what a hand holds is put down first, where it
// is wanted if the arm reaches that, else near by. An arm that has met something first goes back by the way
// that it came. Actions and motions are those of predicates/workspace.h,
// certified as those of other plans are.
//
// Functions without state; any thread. The same state gives the same actions.
//
//   auto home = way_home(cell, state, order.wanted, {.seed = 1, .leaves = true});
//   plan = home->actions; state = home->after;

#include <cstdint>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/tamp/mission/order.h"
#include "supervisor/tamp/scene/tamp_plan.h"

namespace stepwright::tamp::mission {

struct WayHome {
  std::vector<scene::PlannedAction> actions;  // none: all arms are at home and hold nothing
  scene::GeometricState after;
};

struct WayHomeOptions {
  std::uint64_t seed = 1;
  bool leaves = false;      // see certify.h
  bool last_first = false;  // the last arm goes before the first one
  // Of each arm: from where it is along the way that it came. One that touches something where it is goes
  // back there first, as far as it takes; whatever it meets that `known` has not is what it leaves.
  std::vector<motion::JointPath> back{};
  const scene::RobotCell* known = nullptr;
};

// G0406: none was found, with what is in the way.
[[nodiscard]] result::Result<WayHome> way_home(const scene::RobotCell& cell,
                                               const scene::GeometricState& start,
                                               const std::vector<Wanted>& wanted,
                                               const WayHomeOptions& options);

// The state after a plan's actions, from that of before.
scene::GeometricState state_after(const scene::RobotCell& cell, scene::GeometricState state,
                                  const std::vector<scene::PlannedAction>& actions);

}  // namespace stepwright::tamp::mission
