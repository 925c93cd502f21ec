#pragma once

// Changes that actions should make when they end where the binding says, from a start that was measured and
// not rounded: a pump that stops at an absolute level evens out the rounding of that level and moves the
// difference to where the liquid came from or went to.
//
// Pure functions; use from any thread.

#include <map>
#include <string>
#include <vector>

#include "supervisor/model/planned_run.h"
#include "supervisor/translate/guard.h"

namespace stepwright::translate {

// Changes of one action. Changes of different actions add up in any order that the plan allows.
struct Change {
  std::vector<std::string> made_true;
  std::vector<std::string> made_false;
  std::map<std::string, double> increase;
};

struct ExpectedChanges {
  std::vector<Change> of_action;
  std::vector<Offsets> before;  // offsets when the action starts
};

// Requires an entry of the binding for every action.
ExpectedChanges expected_changes(const model::PlannedRun& run, const Binding& binding, Offsets offsets);

void apply(const Change& change, model::NamedState& state);

// The facts and fluents that an action changes, by its states before and after.
std::set<std::string> changed_atoms(const model::PlannedAction& action);

}  // namespace stepwright::translate
