#pragma once

// Plans of the tree's robot cell and their schedules: the paper's problems, and one with two cups, in which
// both arms have work at the same time. Functions without state; any thread.
//
//   const PlannedArms& p1 = planned_once("p1");
//   p1.schedule.makespan_s;

#include <cstdint>
#include <string>

#include "supervisor/tamp/scene/tamp_plan.h"
#include "supervisor/tamp/schedule/schedule_plan.h"

namespace stepwright::tamp::test {

struct PlannedArms {
  scene::RobotCell cell;
  scene::TampPlan plan;
  schedule::CellSchedule schedule;
};

// "p1" to "p6", "two_cups": tests/cells/robot_cell/tamp_NAME.toml. Throws std::runtime_error with the reason.
PlannedArms planned_arms(const std::string& problem, std::uint64_t seed = 0,
                         const schedule::ScheduleOptions& options = {});

// The same, with what is usual; kept for the tests of a process. One thread.
const PlannedArms& planned_once(const std::string& problem);

}  // namespace stepwright::tamp::test
