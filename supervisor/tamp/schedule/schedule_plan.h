#pragma once

// Makes a schedule of a plan: corners of paths are rounded where the bodies allow it, motions get the
// shortest time within limits of velocity, acceleration and jerk, and what could bring arms into each other
// is locked (arm_locks.h).
//
// A function without state; any thread. The same plan gives the same schedule on every machine.
//
//   auto made = schedule_plan(cell, initial_state(cell), *outcome.plan);
//   if (!made) ...
//   made->makespan_s;

#include <cstdint>

#include "runtime/ground/result/result.h"
#include "supervisor/motion/timing/limits.h"
#include "supervisor/tamp/scene/robot_cell.h"
#include "supervisor/tamp/schedule/arm_schedule.h"

namespace stepwright::tamp::schedule {

struct ScheduleOptions {
  // Of each joint of an arm; velocities above those of the robot's file are brought down to them, and none
  // given are theirs. Half of what the simulated drives can do, so that stops have room.
  motion::JointLimits limits{
      .velocity = {}, .acceleration = {4, 4, 5, 5, 8, 8, 8}, .jerk = {40, 40, 50, 50, 80, 80, 80}};
  double velocity_share = 0.8;                      // of the robot's velocities
  double stop_acceleration = 1.5, stop_jerk = 3.0;  // times the planned, while the override changes
  double blend_rad = 0.08;                          // most that a joint leaves the path at a corner
  double line_m = 0.0016;                           // most that the tool leaves its straight line
  std::size_t most_rows = 400;                      // of a motion; one that has more stops in its way-points
  double clear_m =
      0.09;              // kept from the other arm's capsules on ways through the air, if there is such a way
  double room_m = 0.06;  // motions are slower where they leave the interlock less than this, if that helps
  double apart_m = 0.12;    // arms whose capsules may come nearer than this are locked
  double piece_rad = 0.08;  // of a path: what locks are made of
  double grip_s = 0.5, release_s = 0.3, fingers_s = 0.3;  // as planned
  std::uint64_t seed = 1;                                 // of ways that keep clear
};

// G0201: a motion that cannot be timed, with the reason (A0501 to A0510); G0202: actions that do not belong
// together: a motion does not begin where its arm is, somebody grasps what he holds; G0203: limits that are
// none.
[[nodiscard]] result::Result<CellSchedule> schedule_plan(const scene::RobotCell& cell,
                                                         const scene::GeometricState& start,
                                                         const scene::TampPlan& plan,
                                                         const ScheduleOptions& options = {});

}  // namespace stepwright::tamp::schedule
