#pragma once

// Which values of a finite-domain variable can follow which, as far as the operators say that are about the
// variable itself: a tank that has left the store never comes back to it. What cannot follow by this never
// does; what can, may still not.
//
// Thread rule: `passing_needs` works out what it is asked for the first time; the rest only reads.
//
//   ValueOrder order(space);
//   for (const VariableValue& need : order.passing_needs(op))
//     if (!order.can_follow(need.variable, now, need.value)) ...   // the operator never again

#include <optional>
#include <vector>

#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl {

// `value` as in FiniteDomains: the last one stands for none of the facts.
struct VariableValue {
  int variable = 0;
  int value = 0;
  friend auto operator<=>(const VariableValue&, const VariableValue&) = default;
};

class ValueOrder {
 public:
  explicit ValueOrder(const StateSpace& space);

  // The values that the operator asks for and that, once they are left for certain others, never come again.
  std::vector<VariableValue> passing_needs(const GroundOperator& op);

  // From the value `now`; every value follows itself. Of a variable of a passing need.
  bool can_follow(int variable, int now, int value) const;

  // The fact that the value stands for; -1 if that is none.
  int fact_of(const VariableValue& value) const;

 private:
  // From x to, as numbers of values. No table: everything may follow.
  struct Table {
    std::vector<bool> follows;
    bool complete = false;  // also over others in between
  };

  void enter_all();
  void enter(const GroundOperator& op);
  void add_edge(int variable, int from, int to);
  void complete(int variable);
  std::optional<VariableValue> need(int literal) const;
  bool passes(const VariableValue& asked);

  const GroundTask& task_;
  const FiniteDomains& domains_;
  std::vector<Table> tables_;  // by variable; empty before the first question
};

}  // namespace stepwright::pddl
