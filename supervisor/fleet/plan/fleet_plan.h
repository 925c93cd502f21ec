#pragma once

// Plan of a fleet: for each vehicle its mission as path, envelope and stops, and the schedule of all of them.
// Allocation, traffic, programs and messages read it; only `mission` makes one.
//
// Values; any thread may read. Vehicles are in the same order in `missions`, in the schedule's times and in
// its precedences. A vehicle without anything to do is in the plan as well: its path has one pose, its
// envelope one polygon.
//
//   for (const Precedence& wait : plan.schedule.precedences) ...   // polygon `second` only after `first`

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/fleet/envelope/grow_envelope.h"
#include "supervisor/fleet/lattice/vehicle_model.h"
#include "supervisor/fleet/schedule/schedule.h"
#include "supervisor/geometry/path.h"

namespace stepwright::fleet {

enum class StopKind : std::uint8_t {
  PickUp,
  SetDown,
  Park,     // nothing is moved; the mission may end here
  GiveWay,  // as Park, where it is in nobody's way: nobody has asked for it but the planner
};

// Whether the forks have something to do.
inline bool moves_load(StopKind kind) {
  return kind == StopKind::PickUp || kind == StopKind::SetDown;
}

// A place on the path where the vehicle comes to rest.
struct Stop {
  StopKind kind = StopKind::Park;
  std::string location;                  // as the problem names it
  std::string goal;                      // the transport that it serves; empty where no load is moved
  std::uint32_t amount = 0;              // units of load taken or left
  std::uint32_t aboard = 0;              // units on the vehicle when it drives on
  std::size_t pose = 0;                  // index into the path
  double arc_m = 0.0;                    // of that pose
  std::chrono::milliseconds service{0};  // it stands for at least so long
};

struct VehicleMission {
  std::string vehicle;
  VehicleModel model;
  SpeedLimits speed;
  geometry::Path path;      // from where it stands through all stops
  GrownEnvelope grown;      // along the path; service times are part of the stays
  std::vector<Stop> stops;  // in the order of the way
};

struct FleetPlan {
  std::vector<VehicleMission> missions;
  std::vector<TemporalConstraint> constraints;  // the problem's own
  Schedule schedule;                            // Mode::Strict unless asked otherwise
};

// Envelopes for the scheduler, in the order of the missions.
std::vector<TrajectoryEnvelope> envelopes_of(const FleetPlan& plan);

}  // namespace stepwright::fleet
