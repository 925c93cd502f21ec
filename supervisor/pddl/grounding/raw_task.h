#pragma once

// Ground task before unreachable and irrelevant parts are left out.
//
// Thread rule: plain values; the definition outlives them.

#include <vector>

#include "supervisor/pddl/ground_task/memory_room.h"
#include "supervisor/pddl/ground_task/relaxed_bounds.h"

namespace stepwright::pddl {

// Result of relaxed reachability.
struct Reachable {
  RelaxedState state;
  std::vector<bool> operators;
};

struct RawGoal {
  Condition condition;
  const Formula* formula = nullptr;
};

struct RawTask {
  const Definition* definition = nullptr;
  std::vector<Atom> facts;
  std::vector<Atom> variables;
  std::vector<bool> initial_facts;
  std::vector<double> initial_values;  // NaN = undefined
  std::vector<GroundOperator> operators;
  std::vector<GroundAxiom> axioms;
  std::vector<RawGoal> goals;  // one per conjunct
  GroundExpression metric;     // to be minimized; empty without one
  Reachable reachable;

  bool derived(std::size_t fact) const {
    return definition->predicates[static_cast<std::size_t>(facts[fact].symbol)].derived;
  }
};

struct Invariant;

// Numbers what matters, folds what is constant, separates the accumulated cost from the variables, groups the
// facts that exclude each other. Marked cancelled if there is no room for the list of operators.
GroundTask simplify(RawTask raw, const std::vector<Invariant>& invariants, const RoomFor& room_for);

}  // namespace stepwright::pddl
