#pragma once

// Small tasks for the planner's tests, and the bench's files.

#include <string>

#include "supervisor/pddl/task/task.h"

namespace stepwright::pddl::testing {

// Fails the test if the texts are not a task.
Task make_task(const std::string& domain, const std::string& problem);

// tests/cells/bench/domain<suffix>.pddl and problem<suffix>.pddl.
Task bench_task(const std::string& suffix = {});
std::string bench_file(const std::string& name);

// Count from 0 to the goal with +1 (cost 1) and +3 (cost 2).
Task counter_task(const std::string& goal, const std::string& metric = "(:metric minimize (effort))");

// Two packages, a truck, a chain of places p1 .. p<n>.
Task logistics_task(int places);

// A lamp whose switch toggles by conditional effects; all lamps must be on (forall) or some (exists).
Task lamps_task(const std::string& goal);

}  // namespace stepwright::pddl::testing
