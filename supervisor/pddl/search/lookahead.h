#pragma once

// From a state along its relaxed plan as far as that can really be executed (Vidal 2004, "A lookahead
// strategy for heuristic search planning"): often most of the way to the goal for the price of one
// evaluation.
//
// Thread rule: one search, one object.

#include <vector>

#include "supervisor/pddl/search/additive_heuristic.h"
#include "supervisor/pddl/search/state_table.h"

namespace stepwright::pddl {

class Lookahead {
 public:
  explicit Lookahead(const RelaxedTask& task);

  // Applies the operators of the relaxed plan, those with cheaper needs first, again and again while any can
  // be applied; where none can, one that reaches the same for another takes its place. Every state on the way
  // is a node. `state` is the node's before and the last one's after. Returns the last node.
  std::uint32_t follow(StateTable& states, std::uint32_t node, std::vector<Word>& state,
                       const std::vector<AdditiveHeuristic::Use>& plan);

 private:
  bool apply(StateTable& states, std::uint32_t& node, std::vector<Word>& state, int op);
  bool pass(StateTable& states, std::uint32_t& node, std::vector<Word>& state);
  bool replace(const std::vector<Word>& state);
  int substitute(const std::vector<Word>& state, int supplier, int user);

  const RelaxedTask& task_;
  const StateSpace& space_;
  PackedLists<int> units_of_;  // by operator
  std::vector<AdditiveHeuristic::Use> rest_;
  std::vector<Word> next_;
  int patience_ = 0;  // looks that are left for replacements
};

}  // namespace stepwright::pddl
