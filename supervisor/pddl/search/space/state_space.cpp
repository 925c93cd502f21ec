#include "supervisor/pddl/search/space/state_space.h"

#include <algorithm>
#include <cmath>

namespace stepwright::pddl {
namespace {

bool undefined_possible(const GroundExpression& expression) {
  return !expression.linear() || !expression.terms.empty() || !std::isfinite(expression.constant);
}

}  // namespace

StateSpace::StateSpace(const GroundTask& task)
    : task_(task),
      domains_(task),
      tree_(task, domains_),
      axioms_(task),
      fact_words_((task.facts.size() + 63) / 64),
      words_(fact_words_ + task.variables.size()) {
  operators_.reserve(task.operators.size());
  for (const GroundOperator& op : task.operators) compile(op);
}

// What always happens becomes one mask per word; adds win over deletes.
void StateSpace::compile(const GroundOperator& op) {
  OperatorChanges entry{static_cast<int>(changes_.size()), 0, false, false, op.may_conflict};
  const auto change_at = [&](int fact) -> WordChange& {
    const auto word = static_cast<std::uint32_t>(fact >> 6);
    const auto first = changes_.begin() + entry.first_change;
    const auto place =
        std::find_if(first, changes_.end(), [&](const WordChange& c) { return c.word == word; });
    if (place != changes_.end()) return *place;
    return changes_.emplace_back(WordChange{word, ~Word{0}, 0});
  };
  for (const GroundEffect& effect : op.effects) {
    entry.numeric = entry.numeric || !effect.numeric.empty() || undefined_possible(effect.cost) ||
                    effect.cost.constant != 0.0;
    if (!effect.when.always()) {
      entry.conditional = true;
      continue;
    }
    for (const int fact : effect.deletes) change_at(fact).keep &= ~(Word{1} << (fact & 63));
    for (const int fact : effect.adds) change_at(fact).set |= Word{1} << (fact & 63);
  }
  entry.last_change = static_cast<int>(changes_.size());
  operators_.push_back(entry);
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
    if (!holds(comparison, state)) return false;
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
  tree_.for_each(state, domains_, [&](int op) {
    if (!tree_.undecided(op) || holds(task_.operators[static_cast<std::size_t>(op)].precondition, state)) {
      operators.push_back(op);
    }
  });
}

bool StateSpace::apply_numbers(const GroundEffect& effect, const Word* from, Word* to, double& cost) const {
  for (const NumericEffect& numeric : effect.numeric) {
    const double amount = evaluate(numeric.amount, from);
    Word& place = to[fact_words_ + static_cast<std::size_t>(numeric.variable)];
    const double result = new_value(numeric.kind, std::bit_cast<double>(place), amount);
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
    if (!fires(effect, from)) continue;
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

// The effects with conditions, and what any effect does to numbers. The adds of every effect win over the
// deletes of all.
bool StateSpace::apply_conditional(const GroundOperator& op, const Word* from, Word* to, double& cost) const {
  for (const GroundEffect& effect : op.effects) {
    if (!fires(effect, from)) continue;
    if (!apply_numbers(effect, from, to, cost)) return false;
    for (const int fact : effect.deletes) to[fact >> 6] &= ~(Word{1} << (fact & 63));
  }
  for (const GroundEffect& effect : op.effects) {
    if (effect.adds.empty() || !fires(effect, from)) continue;
    for (const int fact : effect.adds) to[fact >> 6] |= Word{1} << (fact & 63);
  }
  return true;
}

bool StateSpace::apply(int op, const Word* from, Word* to, double& cost) const {
  const OperatorChanges& entry = operators_[static_cast<std::size_t>(op)];
  const GroundOperator& whole = task_.operators[static_cast<std::size_t>(op)];
  if (entry.conflicts && !consistent(whole, from)) return false;
  std::copy(from, from + words_, to);
  if (entry.conditional) {
    if (!apply_conditional(whole, from, to, cost)) return false;
  } else {
    for (int i = entry.first_change; i < entry.last_change; ++i) {
      const WordChange& change = changes_[static_cast<std::size_t>(i)];
      to[change.word] = (to[change.word] & change.keep) | change.set;
    }
    if (entry.numeric) {
      for (const GroundEffect& effect : whole.effects) {
        if (!apply_numbers(effect, from, to, cost)) return false;
      }
    }
  }
  derive(to);
  return true;
}

}  // namespace stepwright::pddl
