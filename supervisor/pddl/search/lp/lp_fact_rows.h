#pragma once

// The state equation: for every literal, those who make it true less those who make it false.
//
// Thread rule: pure function.

#include <functional>
#include <vector>

#include "supervisor/pddl/search/lp/lp_program.h"
#include "supervisor/pddl/search/relaxation/relaxed_task.h"

namespace stepwright::pddl {

struct FactRow {
  int literal = 0;
  bool in_goal = false;
  LpRow row;  // by how much each operator changes the literal's truth at most: 1, 0 or -1
};

// One row per fact that is not derived, and per negative literal that some condition asks for. Rows that hold
// of any numbers are left out. None when `stop` says so.
std::vector<FactRow> fact_rows(const RelaxedTask& task, const std::function<bool()>& stop);

}  // namespace stepwright::pddl
