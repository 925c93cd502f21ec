#pragma once

// Small problems on floors drawn cell by cell, for tests of the chain.

#include <string>

#include "supervisor/fleet/mission/plan_fleet.h"

namespace stepwright::fleet {

// 40 x 24 m of free floor with cells of 0.2 m.
MissionProblem empty_problem();
// Blocks the rectangle from (x0, y0) to (x1, y1), in metres.
void wall(MissionProblem& problem, double x0, double y0, double x1, double y1);
std::size_t add_vehicle(MissionProblem& problem, const std::string& name, const geometry::Pose& start);
std::size_t add_location(MissionProblem& problem, const std::string& name, const geometry::Pose& pose,
                         std::chrono::milliseconds service = {});
void add_task(MissionProblem& problem, std::size_t vehicle, std::size_t location);

// With a look-up table that is built quickly.
FleetFloor floor_of(const MissionProblem& problem);
FleetAnswer planned(const MissionProblem& problem, const FleetOptions& options = {});

// No fault at the earliest, the latest and some random times; every path free by the exact outline.
void expect_sound(const MissionProblem& problem, const FleetPlan& plan, Mode mode = Mode::Strict);

}  // namespace stepwright::fleet
