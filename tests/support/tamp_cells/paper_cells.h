#pragma once

// Problems P1 to P6 of Karlsson et al. 2012 in the tree's own cell, with things moved a little for a seed,
// and trays with another slack. Functions without state; any thread.

#include <cstdint>
#include <optional>
#include <string>

#include "supervisor/htn/task/planning_task.h"
#include "supervisor/lisp/place.h"
#include "supervisor/pddl/task/outside.h"
#include "supervisor/tamp/scene/robot_cell.h"

namespace stepwright::tamp::test {

struct PaperProblem {
  scene::RobotCell cell;
  htn::PlanningTask task;
  lisp::Source domain, problem;
};

// "p1" to "p6", and "tower". Nothing, with the reason on stderr, if the files are wrong.
std::optional<PaperProblem> paper_problem(const std::string& name);

// A cell whose goal is PDDL: "p1_pddl", "tower_pddl".
struct SkeletonProblem {
  scene::RobotCell cell;
  pddl::OutsideTask task;
};
std::optional<SkeletonProblem> skeleton_problem(const std::string& name);

// Each thing's start moves by up to so much in x and y. Seed 0: not at all.
void move_things(scene::RobotCell& cell, std::uint64_t seed, double most_m = 0.015);

// The tray of P2 to P6 takes its cans with so much to spare each way.
void set_slack(scene::RobotCell& cell, double slack_m);

}  // namespace stepwright::tamp::test
