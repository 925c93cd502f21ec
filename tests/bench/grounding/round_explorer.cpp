#include "tests/bench/grounding/round_explorer.h"

namespace stepwright::pddl::baseline {
namespace {

// Rounds of exact growth: enough for the capacities of usual problems to be found by stepping.
constexpr int kExactRounds = 48;

class Explorer {
 public:
  Explorer(const std::vector<GroundOperator>& operators, const std::vector<GroundAxiom>& axioms,
           RelaxedState start)
      : operators_(operators), axioms_(axioms) {
    reachable_.state = std::move(start);
    reachable_.operators.assign(operators.size(), false);
  }

  // False if stopped.
  bool run(const std::function<bool()>& stop, Reachable& found) {
    for (changed_ = true; changed_; ++round_) {
      changed_ = false;
      for (std::size_t i = 0; i < operators_.size(); ++i) {
        if (i % 1024 == 0 && stop()) return false;
        visit(i);
      }
      for (const GroundAxiom& axiom : axioms_) {
        if (can_hold(axiom.body, reachable_.state)) reach(2 * axiom.fact);
      }
    }
    found = std::move(reachable_);
    return true;
  }

 private:
  void visit(std::size_t i) {
    const GroundOperator& op = operators_[i];
    if (!reachable_.operators[i]) {
      if (!can_hold(op.precondition, reachable_.state)) return;
      reachable_.operators[i] = true;
      changed_ = true;
    }
    for (const GroundEffect& effect : op.effects) {
      if (!effect.when.always() && !can_hold(effect.when, reachable_.state)) continue;
      for (const int fact : effect.adds) reach(2 * fact);
      for (const int fact : effect.deletes) reach(2 * fact + 1);
      for (const NumericEffect& numeric : effect.numeric) grow(numeric, {&op.precondition, &effect.when});
    }
  }

  void reach(int literal) {
    const auto place = static_cast<std::size_t>(literal);
    if (reachable_.state.literals[place]) return;
    reachable_.state.literals[place] = true;
    changed_ = true;
  }

  void grow(const NumericEffect& effect, const std::vector<const Condition*>& conditions) {
    std::vector<Interval>& values = reachable_.state.values;
    Interval& value = values[static_cast<std::size_t>(effect.variable)];
    const GroundExpression result = result_of(effect);
    Interval after = implied_interval(result, conditions, values);
    if (after.empty()) return;
    Interval grown = hull(value, after);
    if (grown == value) return;
    if (round_ >= kExactRounds && !value.empty()) {
      const Interval before = value;
      if (grown.high > before.high) value.high = kInfinity;
      if (grown.low < before.low) value.low = -kInfinity;
      after = implied_interval(result, conditions, values);
      value = before;
      grown = hull(before, after);
      // Variables that bound each other could go on like this for ever.
      if (round_ >= 2 * kExactRounds && grown.high > before.high) grown.high = kInfinity;
      if (round_ >= 2 * kExactRounds && grown.low < before.low) grown.low = -kInfinity;
    }
    value = {snap(grown.low), snap(grown.high)};
    changed_ = true;
  }

  const std::vector<GroundOperator>& operators_;
  const std::vector<GroundAxiom>& axioms_;
  Reachable reachable_;
  bool changed_ = true;
  int round_ = 0;
};

}  // namespace

bool explore(RawTask& raw, RelaxedState start, const std::function<bool()>& stop) {
  return Explorer(raw.operators, raw.axioms, std::move(start)).run(stop, raw.reachable);
}

}  // namespace stepwright::pddl::baseline
