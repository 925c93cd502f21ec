#pragma once

// Change of a level by an action, apart from what was wrong with the level before it began. An action that
// stops at an absolute level has the way to it from where the level is; all others are held against their
// change.
//
// Pure functions.

#include <string>
#include <vector>

#include "cell/trial/action_run.h"

namespace stepwright::trial {

// Of a reading; 0 for what it does not have.
double value_of(const Reading& reading, const std::string& atom);

// Means over runs of one action from one start, in the unit of the level.
struct LevelChange {
  double moved = 0.0;    // by the plant
  double claimed = 0.0;  // by the domain, from where the plan has it
  double off = 0.0;      // what the action is to blame for: more (or less) than it should
};

// Requires a run, and a sensor of `level`. `until`: the level that ends the action; empty: a fact does.
LevelChange level_change(const translate::Binding& binding, const std::vector<const ActionRun*>& runs,
                         const std::string& level, const std::string& until);

// From where `level` was shown to where the plan has it behind the action; the planned change where the level
// was there or beyond already.
double way_left(const ActionRun& run, const std::string& level);

// Whether the action had another amount to move than the plan says: the level that ends it, or that its
// duration is counted by, was shown farther than its tolerance from where the plan has it.
bool began_elsewhere(const translate::Binding& binding, const ActionRun& run);

}  // namespace stepwright::trial
