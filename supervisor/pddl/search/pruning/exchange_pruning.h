#pragma once

// Pruning of a search for some plan, where objects can change places: left out are states that differ from
// one it has met by exchanges only, and of operators that differ by objects of which the state says the same
// all but the first (symmetry reduction, interchangeable.h). Costs of ways are not compared.
//
// Thread rule: one search, one object; `objects` is copied.
//
//   ExchangePruning pruning(space, objects);
//   pruning.look_at(state);
//   pruning.leave_out(applicable);
//   heuristic.evaluate(state, pruning.needless_facts());
//   if (!pruning.meet(next)) ...   // one like it was met before

#include <vector>

#include "supervisor/pddl/search/pruning/interchangeable.h"
#include "supervisor/pddl/search/space/packed_lists.h"
#include "supervisor/pddl/search/space/state_table.h"

namespace stepwright::pddl {

class ExchangePruning {
 public:
  ExchangePruning(const StateSpace& space, const Interchangeable& objects);

  // Finds the twins of the state; what follows is about it.
  void look_at(const Word* state);
  void leave_out(std::vector<int>& operators) const;
  // By word of facts: those that need not be looked at to see what can be reached. Null if there are none.
  const Word* needless_facts() const { return any_needless_ ? needless_.data() : nullptr; }

  // False if a state that it can be exchanged with was met before, or the state itself.
  bool meet(const Word* state);

  std::size_t memory() const { return met_.memory(); }

 private:
  bool needless(int op) const;

  const Interchangeable objects_;
  PackedLists<int> mentions_;  // by operator: objects of the sets
  std::vector<Twin> twins_;
  std::vector<int> first_;  // by object: its first twin, or -1
  std::vector<Word> needless_, arranged_;
  bool any_needless_ = false;
  StateTable met_;  // arranged
};

}  // namespace stepwright::pddl
