#pragma once

// The validator, in the sense of VAL (Howey, Long, Fox 2004): executes a plan on the action schemas and says
// where and why the plan fails. Shares nothing with the planner but the parser.
//
// Thread rule: pure functions.

#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/pddl/plan/plan_file.h"
#include "supervisor/pddl/plan/simulate.h"

namespace stepwright::pddl {

// All states of a long plan of a large problem take much memory: steps times facts.
enum class KeepStates { All, Last };

struct Validation {
  bool valid = false;
  Trace trace;                      // up to the failing step; KeepStates::Last: one state, but every cost
  std::vector<GoalStatus> goals;    // in the last state
  std::size_t failed_step = 0;      // from 1; 0 = every step could be executed
  std::string failed_condition;     // "(is-at v1 a2)"
  std::string failed_values;        // what the condition met, e.g. "(lev v1) = 4"; may be empty
  result::Diagnostics diagnostics;  // empty if valid
  double cost() const { return trace.cost.empty() ? 0.0 : trace.cost.back(); }
};

// A plan that is wrong gives a Validation with valid == false, not a failure.
Validation validate(const Task& task, const PlanText& plan, KeepStates keep = KeepStates::All);

// The fluents and facts that change in the plan, a row per step: what `stepwright validate` prints. Of a
// validation that kept all states.
std::string table(const PlanText& plan, const Validation& validation);

}  // namespace stepwright::pddl
