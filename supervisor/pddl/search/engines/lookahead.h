#pragma once

// From a state along its relaxed plan as far as that can really be executed (Vidal 2004, "A lookahead
// strategy for heuristic search planning"): often most of the way to the goal for the price of one
// evaluation.
//
// Thread rule: one search, one object.

#include <functional>
#include <vector>

#include "supervisor/pddl/search/control/search_control.h"
#include "supervisor/pddl/search/relaxation/additive_heuristic.h"

namespace stepwright::pddl {

class Lookahead {
 public:
  Lookahead(const RelaxedTask& task, SearchControl& control);

  // Takes the step of the operator to the next state; false if that leads nowhere.
  using Enter = std::function<bool(int op, double cost, const std::vector<Word>& next)>;

  // Applies the operators of the relaxed plan, those with cheaper needs first, again and again while any can
  // be applied; where none can, one that reaches the same for another takes its place. `state` is where it
  // begins before and where it ends after. Ends earlier if the control says stop.
  void follow(std::vector<Word>& state, const std::vector<AdditiveHeuristic::Use>& plan, const Enter& enter);

 private:
  bool apply(std::vector<Word>& state, int op, const Enter& enter);
  bool pass(std::vector<Word>& state, const Enter& enter);
  bool replace(const std::vector<Word>& state);
  int substitute(const std::vector<Word>& state, int supplier, int user);

  const RelaxedTask& task_;
  const StateSpace& space_;
  SearchControl& control_;
  PackedLists<int> units_of_;  // by operator
  std::vector<AdditiveHeuristic::Use> rest_;
  std::vector<Word> next_;
  int patience_ = 0;  // looks that are left for replacements
  std::uint32_t steps_ = 0;
  bool stopped_ = false;
};

}  // namespace stepwright::pddl
