#pragma once

// The relaxed-plan heuristic over intervals, in the manner of Metric-FF (Hoffmann 2003, sections 4 and 5):
// layers of facts that can hold and of ranges that variables can have, then a plan read off backwards.
//
// Thread rule: one search, one object: it reuses its memory.
//
//   RelaxedPlan heuristic(space);
//   if (heuristic.evaluate(state)) use(heuristic.steps(), heuristic.helpful());

#include <cstdint>
#include <vector>

#include "supervisor/pddl/search/relaxation/relaxed_layers.h"

namespace stepwright::pddl {

class RelaxedPlan {
 public:
  explicit RelaxedPlan(const StateSpace& space);

  // False if no plan exists from the state (proved).
  bool evaluate(const Word* state);

  // Of the last evaluation: the size and the least cost of the relaxed plan, and those of its operators that
  // are applicable at once.
  int steps() const { return steps_; }
  double cost() const { return cost_; }
  const std::vector<int>& helpful() const { return helpful_; }

 private:
  struct NumericGoal {
    GroundExpression difference;
    Relation relation{};
  };

  void extract();
  void require(const Condition& condition, int layer);
  int first_layer(const Condition& condition, int limit) const;
  int first_layer(const GroundExpression& difference, Relation relation, int limit) const;
  void require_number(GroundExpression difference, Relation relation, int layer);
  void achieve_literals(int layer);
  void achieve(NumericGoal goal, int layer);
  void achieve_nonlinear(const NumericGoal& goal, int layer);
  double contribution(const Unit& unit, const NumericGoal& goal, bool upwards, int layer) const;
  void select(int unit, int layer);

  const StateSpace& space_;
  RelaxedLayers layers_;
  std::vector<std::vector<int>> literal_goals_;
  std::vector<std::vector<NumericGoal>> numeric_goals_;
  std::vector<std::vector<int>> changers_;  // units by the variable that they change
  std::vector<std::int32_t> literal_mark_;  // evaluation in which the literal became a goal
  std::vector<std::int64_t> unit_mark_;     // evaluation and layer in which the unit was selected last
  std::vector<std::int32_t> helpful_mark_;
  std::vector<int> helpful_;
  std::int32_t evaluation_ = 0;
  int steps_ = 0;
  double cost_ = 0.0;
};

}  // namespace stepwright::pddl
