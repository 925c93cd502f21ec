#pragma once

// The relaxed planning graph of a textbook (Hoffmann, Nebel 2001; with intervals for numbers: Hoffmann 2003):
// layers without deletes, then a relaxed plan read off from the back. Its length is the estimate, and the
// operators of the first layer that serve a subgoal of the second are helpful.
//
// Thread rule: one search, one graph: it reuses its memory.

#include <optional>
#include <vector>

#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::bench {

class RelaxedGraph {
 public:
  explicit RelaxedGraph(const pddl::StateSpace& space);

  // Operators in the relaxed plan; nothing if the graph never reaches the goal.
  std::optional<int> estimate(const pddl::Word* state);

  // Of the last estimate, ascending.
  const std::vector<int>& helpful() const { return helpful_; }

 private:
  using Values = std::vector<pddl::Interval>;

  // One effect of an operator, with all that it needs.
  struct Unit {
    int op = 0;
    pddl::Condition condition;
    std::vector<int> literals;  // made true
    std::vector<pddl::NumericEffect> numeric;
  };
  struct Goal {
    pddl::GroundExpression difference;  // compared with zero
    pddl::Relation relation{};
  };

  void add_units(const pddl::GroundOperator& op, int index);
  bool build(const pddl::Word* state);
  void reach(int literal, int layer, int unit);
  bool possible_at(const pddl::Condition& condition, int layer) const;
  bool possible_at(const Goal& goal, int layer) const;
  bool widen(int layer);
  bool growth_helps(int layer);
  pddl::Interval changed(const pddl::NumericEffect& effect, const Values& values) const;

  int extract();
  void want(const pddl::Condition& condition, int layer);
  void want_literal(int literal);
  void want_number(Goal goal, int layer);
  void achieve(Goal goal, int layer);
  double gain(const Unit& unit, const Goal& goal, bool up, int layer) const;
  void select(int unit);

  const pddl::StateSpace& space_;
  std::vector<Unit> units_;
  std::vector<std::vector<int>> waiting_;  // units by a literal of their condition
  std::vector<int> missing_;               // literals that a unit lacks
  std::vector<int> ready_;                 // units that lack only numbers or choices
  std::vector<int> literal_layer_, unit_layer_, achiever_;
  std::vector<int> numeric_;  // enabled units that change numbers
  std::vector<int> fresh_;
  std::vector<Values> values_;  // by layer
  int last_ = 0;
  std::vector<std::vector<int>> wanted_;    // literals by layer
  std::vector<std::vector<Goal>> numbers_;  // by layer
  std::vector<char> is_wanted_, selected_;
  std::vector<int> helpful_;
  int steps_ = 0;
};

}  // namespace stepwright::bench
