#pragma once

// Rows of a linear program, with one column per operator, that hold for the operator counts of every plan
// from a state (Pommerening, Roeger, Helmert, Bonet 2014, "LP-based heuristics for cost-optimal planning").
//
// Facts: who makes a fact true and who makes it false balance, up to what the state has and the goal wants
// (state equation, lower bounds of net change). Numbers: what the operators add to an expression at most must
// cover the way from its value to what the goal wants, or to the least value that it ever has. For effects
// that depend on the state, intervals over all reachable states stand.
//
// Thread rule: immutable. Only the lower ends of rows depend on the state.

#include <functional>
#include <vector>

#include "supervisor/pddl/search/lp/lp_program.h"
#include "supervisor/pddl/search/relaxation/relaxed_task.h"

namespace stepwright::pddl {

class CountingRows {
 public:
  // When `stop` says so, only rows that are ready: what they say is true all the same.
  CountingRows(const RelaxedTask& task, const std::function<bool()>& stop);

  const std::vector<LpRow>& rows() const { return rows_; }

  // Lower bound of the row from the state; -kInfinity if it has none there.
  double low(std::size_t row, const Word* state) const;

 private:
  // A row is about a literal, or, with literal -1, about an expression.
  struct Subject {
    int literal = -1;
    GroundExpression expression;
    double final = 0.0;  // 1 if the literal holds in every goal; the least that the expression can end with
    double slack = 0.0;  // for rounding
  };

  const StateSpace& space_;
  std::vector<LpRow> rows_;
  std::vector<Subject> subjects_;
};

}  // namespace stepwright::pddl
