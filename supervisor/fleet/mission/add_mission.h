#pragma once

// One more mission for a plan in execution: the vehicle goes on from where its plan ends, along a new path;
// paths and orders of all that is planned stay as they are, and the new polygons are put in order among them.
//
// Pure functions but for the floor, which keeps the paths it finds. One thread at a time for one floor.
//
//   const AddedMission added = add_mission(*floor, plan, {.now = 40s, .times = retiming.earliest()},
//                                          {.stops = {{StopKind::PickUp, "dock", dock}, ...}}, {});
//   if (added.verdict == Verdict::Scheduled) plan = added.plan;

#include <atomic>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/fleet/mission/fleet_floor.h"
#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::fleet {

// Progress of a plan in execution.
struct RunningPlan {
  std::chrono::milliseconds now{0};
  // Of each polygon of the plan: before `now` as it was, from then on as early as it can be by now
  // (Retiming::earliest).
  std::vector<VehicleTimes> times;
};

struct NewStop {
  StopKind kind = StopKind::Park;
  std::string location;
  geometry::Pose pose;
  std::chrono::milliseconds service{0};
  std::string goal{};
  std::uint32_t amount = 0;
};

struct NewMission {
  std::vector<NewStop> stops;                // at least one
  std::vector<std::uint32_t> vehicles = {};  // one of these drives it; empty: any that has a path
};

struct AddOptions {
  Mode mode = Mode::Strict;
  EnvelopeOptions envelope{};
  // Paths are proved to cost at most so many times the least. In mines they are a few percent longer; the
  // search is four times as quick as with 2.
  double path_factor = 5.0;
  std::uint32_t alternatives = 4;             // paths around vehicles that stand in the way
  std::chrono::milliseconds time{1'000};      // of the search for orders; zero: no limit
  const std::atomic<bool>* cancel = nullptr;  // not owned; may be null
};

struct AddedMission {
  Verdict verdict = Verdict::Exhausted;
  std::uint32_t vehicle = 0;
  FleetPlan plan;  // Scheduled only; its constraints are those of the plan before
  std::string reason;
  std::uint32_t alternatives = 0;  // that were tried
  double paths_ms = 0.0;
  double envelopes_ms = 0.0;
  double schedule_ms = 0.0;
  double total_ms = 0.0;
};

// Requires missions whose models the floor has, times of all polygons of the plan, and vehicles that have
// paths. Who could be at the first stop soonest drives. Where there is no path the verdict is Infeasible,
// with the reason.
AddedMission add_mission(FleetFloor& floor, const FleetPlan& plan, const RunningPlan& running,
                         const NewMission& mission, const AddOptions& options);

}  // namespace stepwright::fleet
