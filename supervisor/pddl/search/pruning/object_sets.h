#pragma once

// Sets of objects of which one can take another's place, read off a ground task: exchanging two of them in
// all facts, fluents, operators, axioms and the goal gives the same task again.
//
// Where only some operators tell objects apart, and each of these asks for a value that never comes again
// once it is left, the objects become exchangeable then: tanks that are taken from a store in a fixed order
// are alike once they are out of it. Such operators part the objects that they mention.
//
// Only sets of which no fact and no fluent mentions two are looked for.
//
// Thread rule: pure function.

#include <vector>

#include "supervisor/pddl/search/pruning/exchange_text.h"
#include "supervisor/pddl/search/pruning/value_order.h"

namespace stepwright::pddl {

// Larger tasks are not looked into.
struct SetLimits {
  std::size_t operators = 3'000;
  std::size_t facts = 2'000;
  std::size_t checks = 20'000;  // operators that are looked at for all pairs of objects together
};

struct ExchangeMember {
  int object = 0;  // index into the definition's objects
  // Facts and variables that mention the object, in the same order for all objects of a set.
  std::vector<int> facts, variables;
  // As long as one of these can still come, an operator may tell the object apart.
  std::vector<VariableValue> parted_by;
};

struct ExchangeSet {
  std::vector<ExchangeMember> members;  // by object, ascending
  // In the delete relaxation an earlier object with the same facts in the state reaches all that a later one
  // does, and the goal mentions neither.
  bool first_is_enough = false;
};

std::vector<ExchangeSet> find_exchange_sets(const StateSpace& space, ValueOrder& order,
                                            const SetLimits& limits);

}  // namespace stepwright::pddl
