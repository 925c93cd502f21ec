#pragma once

// Problem files of the fleet: JSON with a ROS map beside it (supervisor/doc/fleet_problems.md).
//
// Functions without state; any thread. The files are not trusted. All that is wrong is said at once, each
// with file, line, column and key. What is read is sound: names differ and are known, models hold together,
// where a vehicle begins and where it stops it can stand. Whether there are ways, and times, is for
// plan_fleet to say.
//
//   auto problem = read_mission_problem(text, "mine/problem.json");
//   if (!problem) print(to_string(problem.error()));

#include <filesystem>
#include <string_view>

#include "runtime/ground/result/result.h"
#include "supervisor/fleet/mission/mission_problem.h"

namespace stepwright::fleet {

// Codes: F0701 no JSON, F0702 shape (a member that is missing, unknown, twice or of the wrong kind), F0703 a
// value out of range, F0704 a name that is unknown, F0705 a name that is used twice, F0706 parts that
// contradict each other, F0707 a place where no vehicle can stand, F0708 a load that no vehicle carries,
// F0709 a path; and those of maps (F01), vehicles (F02), speeds (F0502) and given envelopes (F06).
[[nodiscard]] result::Result<MissionProblem> read_mission_problem(std::string_view text,
                                                                  const std::filesystem::path& file);

// Whether this is a problem of the scheduler alone, for `read_problem` (supervisor/doc/fleet_scheduling.md):
// no map, and vehicles that have polygons.
bool is_scheduling_problem(std::string_view text);

}  // namespace stepwright::fleet
