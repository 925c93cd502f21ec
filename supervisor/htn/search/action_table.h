#pragma once

// Ground actions, each prepared at its first use: numbers of facts that it needs, forbids, adds and deletes.
//
// Thread rule: one search, one table.

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "supervisor/htn/search/evaluate.h"
#include "supervisor/htn/search/state.h"
#include "supervisor/htn/task/planning_task.h"

namespace stepwright::htn {

struct GroundAction {
  const Action* action = nullptr;
  bool possible = true;  // false: no state allows it
  std::vector<int> objects;
  std::vector<int> needs;
  std::vector<int> forbids;
  std::vector<const Condition*> conditions;  // all others
  std::vector<int> adds;
  std::vector<int> deletes;            // without those that it adds
  std::vector<const Effect*> effects;  // with conditions or quantifiers; then all effects are here
  double cost = 0.0;
};

class ActionTable {
 public:
  ActionTable(const PlanningTask& task, State& state, Interrupt& interrupt)
      : task_(task), state_(state), interrupt_(interrupt) {}

  // `ground` numbers the action with its objects.
  const GroundAction& get(int ground, int action, std::span<const int> objects);

  // Of an action that was got before.
  double cost(int ground) const {
    return actions_[static_cast<std::size_t>(place_[static_cast<std::size_t>(ground)])].cost;
  }

  bool applicable(const GroundAction& action);
  void apply(const GroundAction& action);

  // What keeps the action from being applied now, "(empty left)"; empty if nothing does.
  std::string obstacle(const GroundAction& action);

 private:
  GroundAction prepare(int action, std::span<const int> objects);
  void add_condition(const Condition& condition, GroundAction& ground);
  void add_effects(GroundAction& ground);
  int fact_of(int predicate, const std::vector<Term>& terms);
  double cost_of(const Action& action, bool& defined) const;
  void bind(const GroundAction& ground);
  std::string text_of(int fact) const;
  Evaluation evaluation() const { return {task_, state_, interrupt_}; }

  const PlanningTask& task_;
  State& state_;
  Interrupt& interrupt_;
  std::vector<int> place_;  // of each ground number in `actions_`; -1: none
  std::vector<GroundAction> actions_;
  std::vector<int> binding_;
  std::vector<int> row_;
  std::vector<std::pair<int, bool>> changes_;
};

}  // namespace stepwright::htn
