#pragma once

// Partial-order reduction: of operators that can be applied in any order, one order is enough. A strong
// stubborn set of a state holds, for one thing that the goal still lacks, everything that may bring it about;
// with every operator that is applicable all that get in its way, with every other one all that may bring
// about one thing that it lacks. If there is a plan from the state, then one at the same cost with as many
// steps begins in the set (Wehrle, Helmert 2014, "Efficient stubborn sets: generalized algorithms and
// selection strategies"). Numbers take part: changes by amounts commute, and disturb a comparison only if
// they move it away from holding.
//
// Where derived facts are, nothing is pruned; nor any more after a while in which hardly anything was.
//
// Thread rule: one search, one object. Costs of operators must not be negative.
//
//   StubbornSets stubborn(space);
//   space.applicable(state, operators);   stubborn.prune(state, operators);

#include <cstdint>
#include <vector>

#include "supervisor/pddl/search/pruning/operator_footprint.h"

namespace stepwright::pddl {

class StubbornSets {
 public:
  explicit StubbornSets(const StateSpace& space);

  // False once it prunes nothing any more.
  bool useful() const { return useful_; }

  // Keeps of the operators that are applicable in the state those in a stubborn set, in their order.
  void prune(const Word* state, std::vector<int>& applicable);

  // Bytes held.
  std::size_t memory() const { return footprints_.memory(); }

 private:
  // Operators that achieve the unsatisfied parts of a condition, part by part.
  using Achievers = std::vector<int>;

  bool close(const Word* state, const Achievers& seed, std::size_t most_applicable);
  void list_lacking(const Condition& condition, const Word* state);
  std::size_t missing(const Achievers& operators) const;
  void include(const Achievers& operators);
  void judge_usefulness();

  const StateSpace& space_;
  OperatorFootprints footprints_;
  bool useful_;
  std::uint32_t call_ = 0, set_ = 0;
  std::vector<std::uint32_t> applicable_;  // by operator: the last call in which it was
  std::vector<std::uint32_t> included_;    // by operator: the last set that it belonged to
  std::vector<int> queue_, kept_operators_;
  std::vector<const Achievers*> lacking_;
  std::vector<Achievers> collected_;  // what `lacking_` points to where no list stands ready
  std::size_t included_applicable_ = 0;
  std::uint64_t states_ = 0, kept_ = 0, met_ = 0;
};

}  // namespace stepwright::pddl
