#pragma once

// Missions along lines and arcs on an empty floor of 60 x 60 m, and plans of them.
//
//   MadeMission west("v1", {5, 30, 0});
//   west.drive(20.0).stop(StopKind::PickUp, "dock").drive(20.0);
//   const FleetPlan plan = scheduled({west.mission(), ...});

#include <cstdint>
#include <string>
#include <vector>

#include "supervisor/fleet/plan/fleet_plan.h"

namespace stepwright::support {

class MadeMission {
 public:
  MadeMission(std::string vehicle, geometry::Pose start, geometry::Travel travel = geometry::Travel::Forward);

  // Positive curvature: to the left, driving forwards.
  MadeMission& drive(double length_m, double curvature_1pm = 0.0,
                     geometry::Travel travel = geometry::Travel::Forward);
  MadeMission& stop(fleet::StopKind kind, const std::string& location, const std::string& goal = {});

  const geometry::Path& path() const { return mission_.path; }
  // With its envelope. Requires a path on the floor.
  fleet::VehicleMission mission() const;

 private:
  fleet::VehicleMission mission_;
};

// Mode::Strict. The verdict is the scheduler's.
fleet::FleetPlan scheduled(std::vector<fleet::VehicleMission> missions);

// A plan of vehicles that cross, meet and follow each other; the same for the same seed. Always scheduled.
fleet::FleetPlan random_plan(std::uint32_t vehicles, std::uint64_t seed);

}  // namespace stepwright::support
