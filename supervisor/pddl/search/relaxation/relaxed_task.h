#pragma once

// The delete relaxation of a task in one flat form that all heuristics read: atoms that can be reached, units
// that reach them. An atom is a literal that some condition asks for, a comparison of numbers, or a choice
// (which one unit per option reaches). A unit is one effect of an operator with all that it needs; a unit
// without an operator is an option of a choice or the rule of a derived fact, and is free.
//
// Thread rule: immutable: any number of heuristics may share one.

#include <vector>

#include "supervisor/pddl/search/space/packed_lists.h"
#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl {

// A unit that may bring a comparison nearer to holding.
struct Mover {
  int unit = 0;
  int atom = 0;
  Interval gain;  // by how much the difference grows at one application, over all reachable states
  bool constant() const { return gain.low == gain.high; }
};

// How far a difference is from standing in its relation to zero, and the side that must grow.
struct Gap {
  double distance = 0.0;  // kInfinity: undefined
  bool upwards = true;
};
Gap gap_of(Relation relation, double difference);

class RelaxedTask {
 public:
  explicit RelaxedTask(const StateSpace& space);

  const StateSpace& space() const { return space_; }
  std::size_t atoms() const { return atoms_; }
  std::size_t units() const { return unit_operator_.size(); }

  // -1 for a free unit.
  int operator_of(std::size_t unit) const { return unit_operator_[unit]; }
  std::span<const int> needs(std::size_t unit) const { return needs_[unit]; }  // atoms, each once
  std::span<const int> adds(std::size_t unit) const { return adds_[unit]; }    // atoms that it makes true
  std::span<const int> needed_by(std::size_t atom) const { return needed_by_[atom]; }  // units
  std::span<const int> added_by(std::size_t atom) const { return added_by_[atom]; }    // units
  const std::vector<int>& without_needs() const { return without_needs_; }             // units
  const std::vector<int>& goal() const { return goal_; }                               // atoms

  // Comparisons are the atoms from `first_comparison` on, then come the choices.
  std::size_t first_comparison() const { return first_comparison_; }
  std::size_t comparisons() const { return comparisons_.size(); }
  const Comparison& comparison(std::size_t i) const { return comparisons_[i]; }
  std::span<const Mover> moved_by(std::size_t unit) const { return moved_by_[unit]; }  // one per comparison
  std::span<const Mover> movers_of(std::size_t comparison) const { return movers_of_[comparison]; }

  // The units that may bring a comparison nearer to holding, one that no condition of the task need ask for;
  // its atom gets that number.
  std::vector<Mover> movers_towards(const Comparison& comparison, int atom) const;

  // By how much the unit makes the comparison's difference grow in a state. NaN if that is undefined there.
  double gain(const Mover& mover, const Comparison& comparison, const Word* state) const;

  // The literal of an atom; -1 for comparisons and choices.
  int literal_of(std::size_t atom) const { return atom < first_comparison_ ? literals_[atom] : -1; }
  int atom_of_literal(int literal) const { return atom_of_literal_[static_cast<std::size_t>(literal)]; }

  // Calls `visit` with every atom that holds in the state, choices left out: their options lead to them. That
  // a derived fact does not hold counts as reached: what would undo it is not looked into. `without`: facts
  // that are passed over where they hold, or null.
  template <typename Visit>
  void for_each_holding(const Word* state, const Visit& visit, const Word* without = nullptr) const {
    for (std::size_t w = 0; w < asked_true_.size(); ++w) {
      const Word passed_over = without == nullptr ? Word{0} : without[w];
      for (Word bits = state[w] & asked_true_[w] & ~passed_over; bits != 0; bits &= bits - 1) {
        visit(atom_of_literal_[2 * (64 * w + static_cast<std::size_t>(std::countr_zero(bits)))]);
      }
      for (Word bits = (~state[w] | derived_[w]) & asked_false_[w]; bits != 0; bits &= bits - 1) {
        visit(atom_of_literal_[2 * (64 * w + static_cast<std::size_t>(std::countr_zero(bits))) + 1]);
      }
    }
    for (std::size_t c = 0; c < comparisons_.size(); ++c) {
      if (space_.holds(comparisons_[c], state)) visit(static_cast<int>(first_comparison_ + c));
    }
  }

 private:
  friend class RelaxedTaskBuilder;

  void add_mover(int unit, const GroundEffect& effect, const Comparison& comparison, int atom,
                 std::vector<Mover>& movers) const;
  Interval gain_range(const Comparison& comparison, const GroundEffect& effect) const;

  const StateSpace& space_;
  std::size_t atoms_ = 0, first_comparison_ = 0;
  std::vector<int> literals_, atom_of_literal_;
  std::vector<Word> asked_true_, asked_false_;  // per word of facts: those whose literal is an atom
  std::vector<Word> derived_;                   // per word of facts
  std::vector<Comparison> comparisons_;
  std::vector<int> unit_operator_;
  std::vector<const GroundEffect*> unit_effect_;  // null for a free unit
  PackedLists<int> needs_, adds_, needed_by_, added_by_;
  PackedLists<Mover> moved_by_, movers_of_;
  PackedLists<int> changers_;  // units by the variable that they change
  std::vector<int> without_needs_;
  std::vector<int> goal_;
};

}  // namespace stepwright::pddl
