#pragma once

// The forward half of the relaxed-plan heuristic: when every literal can first hold, and between which ends
// every variable lies in every layer. Deletes are ignored; in each layer every applicable change of a
// variable adds to its range.
//
// Thread rule: one search, one object.

#include <cstdint>
#include <vector>

#include "supervisor/pddl/ground_task/relaxed_bounds.h"
#include "supervisor/pddl/search/space/state_space.h"

namespace stepwright::pddl {

// One effect of an operator with everything it needs, or an axiom: what the relaxation treats as an action.
struct Unit {
  int op = 0;                 // -1: an axiom
  Condition condition;        // the precondition and the effect's own
  std::vector<int> literals;  // that it makes true
  std::vector<NumericEffect> numeric;
};

class RelaxedLayers {
 public:
  explicit RelaxedLayers(const StateSpace& space);

  // Builds layers from the state until the goal can hold. False if it never can.
  bool build(const Word* state);

  // The layer in which the goal can hold; layer 0 is the state itself.
  int last() const { return last_; }
  int literal_layer(int literal) const { return literal_layer_[static_cast<std::size_t>(literal)]; }
  int unit_layer(int unit) const { return unit_layer_[static_cast<std::size_t>(unit)]; }
  int achiever(int literal) const { return achiever_[static_cast<std::size_t>(literal)]; }
  const std::vector<Interval>& values(int layer) const { return values_[static_cast<std::size_t>(layer)]; }
  const std::vector<Unit>& units() const { return units_; }

  static constexpr int kNever = INT32_MAX;

 private:
  bool can_hold_now(const Condition& condition) const;
  bool numbers_can_hold(const Condition& condition) const;
  void start(const Word* state);
  void reach(int literal, int unit, int layer);
  void enable(int unit, int layer);
  bool step(int layer);
  bool grow(int layer, std::vector<Interval>& next);
  bool widened_helps();

  const StateSpace& space_;
  std::vector<Unit> units_;
  std::vector<std::vector<int>> waiting_;  // units by a literal of their condition
  std::vector<int> missing_;               // literals that a unit still lacks
  std::vector<int> candidates_;            // units that lack no literal but are not enabled
  std::vector<int> numeric_units_;         // enabled units that change variables
  std::vector<int> literal_layer_, unit_layer_, achiever_;
  std::vector<int> fresh_;  // literals reached in the layer before
  std::vector<std::vector<Interval>> values_;
  int current_ = 0;
  int last_ = 0;
};

}  // namespace stepwright::pddl
