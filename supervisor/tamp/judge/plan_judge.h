#pragma once

// An independent judge of plans with motions: drives through all of them, action by action, with nothing but
// the cell and the motions. Where things go follows from where hands carry them, not from what the planner
// says. It shares the cell and the exact checker with the planners, and neither their states, inverse
// kinematics nor tests of room.
//
// A pure function; any thread.
//
//   const Judgement judged = judge(cell, plan);
//   if (!judged.sound) puts(judged.reason.c_str());   // "action 3, right picks cup1: lower: right_hand meets
//   box"

#include <cstddef>
#include <string>

#include "supervisor/tamp/scene/tamp_plan.h"

namespace stepwright::tamp::judge {

struct Judgement {
  bool sound = false;
  std::size_t action = 0;  // where it fails
  std::string reason;
  std::size_t motions = 0;   // straight ones, that were shown to be free
  double worst_place_m = 0;  // of a thing: from where the plan says it stands
};

// Of each action: motions begin where the arm is, keep the limits, and are free for certain with all bodies,
// what is held included (its sides less by 0.2 mm); a hand hangs over the middle of what it grasps and its
// fingers go around it, and nothing stands on it; what is placed stands upright on its region, within it, or
// over the middle of the thing that it is put on, and meets nothing.
Judgement judge(const scene::RobotCell& cell, const scene::TampPlan& plan);

}  // namespace stepwright::tamp::judge
