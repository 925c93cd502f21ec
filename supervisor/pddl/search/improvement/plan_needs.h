#pragma once

// Needs of the rest of a plan: the literals that it reads before it makes them true itself, comparisons of
// numbers as they are before it changes them, and the variables whose very values count because something
// looks at them that is not linear or a condition of an effect. In any state that has those, the rest runs
// and costs no more.
//
// Thread rule: plain values.

#include <map>
#include <vector>

#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl {

class PlanNeeds {
 public:
  // Begins with the needs of goal and metric, after the plan's last state.
  PlanNeeds(const StateSpace& space, const Word* last);

  // Puts one operator, which is applied in `before`, ahead of the rest.
  void prepend(int op, const Word* before);

  // Ascending.
  std::vector<int> literals() const;
  // Variables that are to keep their values are compared with those in `state`.
  std::vector<Comparison> comparisons(const Word* state) const;

 private:
  // A linear sum over variables that shall not be less than a number, or shall be it.
  struct Sum {
    Relation relation{};  // Greater, GreaterEqual or Equal
    std::vector<LinearTerm> terms;
    bool operator<(const Sum& other) const;
  };

  void need(const Condition& condition, const Word* state);
  void need(Comparison comparison);
  void need_all(const Condition& condition, const Word* state);
  void need_variables(const GroundExpression& expression);
  void need_at_most(const GroundExpression& cost, const Word* state);
  void regress_numbers(const std::vector<const NumericEffect*>& effects);

  const StateSpace& space_;
  std::vector<bool> literals_, variables_;
  std::map<Sum, double> sums_;  // with the least or the only number
};

}  // namespace stepwright::pddl
