#include "supervisor/pddl/search/state_space.h"

#include <algorithm>
#include <cmath>

namespace stepwright::pddl {

StateSpace::StateSpace(const GroundTask& task)
    : task_(task),
      axioms_(task),
      fact_words_((task.facts.size() + 63) / 64),
      words_(fact_words_ + task.variables.size()) {
  // Every operator waits under its rarest literal, so that a state looks at few operators that it cannot
  // apply.
  std::vector<std::size_t> uses(2 * task.facts.size(), 0);
  for (const GroundOperator& op : task.operators) {
    for (const int literal : op.precondition.literals) ++uses[static_cast<std::size_t>(literal)];
  }
  by_literal_.resize(uses.size());
  for (std::size_t i = 0; i < task.operators.size(); ++i) {
    const std::vector<int>& literals = task.operators[i].precondition.literals;
    const auto rarest = std::min_element(literals.begin(), literals.end(), [&](int a, int b) {
      return uses[static_cast<std::size_t>(a)] < uses[static_cast<std::size_t>(b)];
    });
    auto& list = rarest == literals.end() ? without_literal_ : by_literal_[static_cast<std::size_t>(*rarest)];
    list.push_back(static_cast<int>(i));
  }
}

std::vector<Word> StateSpace::initial() const {
  std::vector<Word> state(words_, 0);
  for (std::size_t f = 0; f < task_.facts.size(); ++f) {
    if (task_.initial_facts[f]) state[f >> 6] |= Word{1} << (f & 63);
  }
  for (std::size_t v = 0; v < task_.variables.size(); ++v) {
    state[fact_words_ + v] = std::bit_cast<Word>(task_.initial_values[v]);
  }
  derive(state.data());
  return state;
}

bool StateSpace::holds(const Condition& condition, const Word* state) const {
  if (condition.impossible) return false;
  for (const int l : condition.literals) {
    if (!literal(state, l)) return false;
  }
  for (const Comparison& comparison : condition.comparisons) {
    if (!compare(comparison.relation, evaluate(comparison.difference, state))) return false;
  }
  for (const auto& options : condition.choices) {
    if (std::none_of(options.begin(), options.end(), [&](const Condition& o) { return holds(o, state); })) {
      return false;
    }
  }
  return true;
}

void StateSpace::applicable(const Word* state, std::vector<int>& operators) const {
  operators.clear();
  const auto collect = [&](const std::vector<int>& list) {
    for (const int i : list) {
      const GroundOperator& op = task_.operators[static_cast<std::size_t>(i)];
      if (holds(op.precondition, state)) operators.push_back(i);
    }
  };
  collect(without_literal_);
  for (std::size_t l = 0; l < by_literal_.size(); ++l) {
    if (!by_literal_[l].empty() && literal(state, static_cast<int>(l))) collect(by_literal_[l]);
  }
  std::sort(operators.begin(), operators.end());
}

bool StateSpace::apply_effect(const GroundEffect& effect, const Word* from, Word* to, double& cost) const {
  for (const NumericEffect& numeric : effect.numeric) {
    const double amount = evaluate(numeric.amount, from);
    Word& place = to[fact_words_ + static_cast<std::size_t>(numeric.variable)];
    double result = std::bit_cast<double>(place);
    switch (numeric.kind) {
      case ChangeKind::Increase:
        result += amount;
        break;
      case ChangeKind::Decrease:
        result -= amount;
        break;
      case ChangeKind::ScaleUp:
        result *= amount;
        break;
      case ChangeKind::ScaleDown:
        result /= amount;
        break;
      default:
        result = amount;
        break;
    }
    if (!std::isfinite(result)) return false;
    place = std::bit_cast<Word>(snap(result));
  }
  const double accumulated = evaluate(effect.cost, from);
  if (!std::isfinite(accumulated)) return false;
  cost += accumulated;
  return true;
}

// Of several effects on one variable that fire together, all must add or subtract.
bool StateSpace::consistent(const GroundOperator& op, const Word* from) const {
  std::vector<int> added, replaced;
  for (const GroundEffect& effect : op.effects) {
    if (!effect.when.always() && !holds(effect.when, from)) continue;
    for (const NumericEffect& numeric : effect.numeric) {
      const bool additive = numeric.kind == ChangeKind::Increase || numeric.kind == ChangeKind::Decrease;
      const auto seen = [&](const std::vector<int>& list) {
        return std::find(list.begin(), list.end(), numeric.variable) != list.end();
      };
      if (seen(replaced) || (!additive && seen(added))) return false;
      (additive ? added : replaced).push_back(numeric.variable);
    }
  }
  return true;
}

bool StateSpace::apply(const GroundOperator& op, const Word* from, Word* to, double& cost) const {
  if (op.may_conflict && !consistent(op, from)) return false;
  std::copy(from, from + words_, to);
  for (const GroundEffect& effect : op.effects) {
    if (!effect.when.always() && !holds(effect.when, from)) continue;
    if (!apply_effect(effect, from, to, cost)) return false;
    for (const int fact : effect.deletes) to[fact >> 6] &= ~(Word{1} << (fact & 63));
  }
  // Adds come last: they win over the deletes of every effect.
  for (const GroundEffect& effect : op.effects) {
    if (effect.adds.empty() || (!effect.when.always() && !holds(effect.when, from))) continue;
    for (const int fact : effect.adds) to[fact >> 6] |= Word{1} << (fact & 63);
  }
  derive(to);
  return true;
}

}  // namespace stepwright::pddl
