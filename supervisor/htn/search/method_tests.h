#pragma once

// A method prepared for the search: which of its variables the task binds, in which order the others are
// bound, and what is tested as soon as it can be.
//
// Beside its own condition a method is tested for what its subtasks will ask for in any case: what the first
// one needs, if it is an action, and what any of its actions needs that no action changes.
//
// Thread rule: immutable after making.

#include <cstdint>
#include <vector>

#include "supervisor/htn/task/planning_task.h"

namespace stepwright::htn {

// A variable that the task leaves open: its objects come from the facts of an atom that must hold, or else
// from its type.
struct OpenVariable {
  int slot = 0;
  int type = 0;
  int predicate = -1;         // of the atom; -1: none
  std::vector<Term> terms;    // of the atom
  std::vector<bool> bound;    // which of them are bound by then
  std::uint64_t columns = 0;  // the same as bits
  std::size_t column = 0;     // the first one of the variable
  std::vector<Condition> tests;
};

struct MethodTests {
  std::vector<Condition> first;    // once the task is bound
  std::vector<OpenVariable> open;  // in the order of the parameters
};

MethodTests tests_of(const PlanningTask& task, const Method& method);

}  // namespace stepwright::htn
