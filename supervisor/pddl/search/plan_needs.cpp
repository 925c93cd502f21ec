#include "supervisor/pddl/search/plan_needs.h"

namespace stepwright::pddl {

PlanNeeds::PlanNeeds(const StateSpace& space, const Word* last)
    : space_(space),
      literals_(2 * space.task().facts.size(), false),
      variables_(space.task().variables.size(), false) {
  need(space.task().goal, last);
  need_variables(space.task().potential);
}

void PlanNeeds::need_variables(const GroundExpression& expression) {
  for_each_variable(expression, [this](int v) { variables_[static_cast<std::size_t>(v)] = true; });
}

// Of a choice, every part is to stay as it is: which option was taken does not matter then.
void PlanNeeds::need(const Condition& condition, const Word* state) {
  for (const int literal : condition.literals) literals_[static_cast<std::size_t>(literal)] = true;
  for (const Comparison& comparison : condition.comparisons) need_variables(comparison.difference);
  for (const auto& options : condition.choices) {
    for (const Condition& option : options) need_all(option, state);
  }
}

void PlanNeeds::need_all(const Condition& condition, const Word* state) {
  for (const int literal : condition.literals) {
    const int fact = literal / 2;
    literals_[static_cast<std::size_t>(2 * fact + (space_.fact(state, fact) ? 0 : 1))] = true;
  }
  for (const Comparison& comparison : condition.comparisons) need_variables(comparison.difference);
  for (const auto& options : condition.choices) {
    for (const Condition& option : options) need_all(option, state);
  }
}

void PlanNeeds::prepend(int op, const Word* before) {
  const GroundOperator& whole = space_.task().operators[static_cast<std::size_t>(op)];
  for (const GroundEffect& effect : whole.effects) {
    if (!effect.when.always()) continue;
    for (const int fact : effect.deletes) literals_[2 * static_cast<std::size_t>(fact) + 1] = false;
    for (const NumericEffect& numeric : effect.numeric) {
      if (numeric.kind == ChangeKind::Assign) variables_[static_cast<std::size_t>(numeric.variable)] = false;
    }
  }
  for (const GroundEffect& effect : whole.effects) {
    if (!effect.when.always()) continue;
    for (const int fact : effect.adds) literals_[2 * static_cast<std::size_t>(fact)] = false;
  }
  need(whole.precondition, before);
  for (const GroundEffect& effect : whole.effects) {
    need_all(effect.when, before);
    need_variables(effect.cost);
    // What is only added to need not be looked at unless the rest looks at it: then it is needed already.
    for (const NumericEffect& numeric : effect.numeric) need_variables(numeric.amount);
  }
}

std::vector<int> PlanNeeds::literals() const {
  std::vector<int> list;
  for (std::size_t l = 0; l < literals_.size(); ++l) {
    if (literals_[l]) list.push_back(static_cast<int>(l));
  }
  return list;
}

std::vector<int> PlanNeeds::variables() const {
  std::vector<int> list;
  for (std::size_t v = 0; v < variables_.size(); ++v) {
    if (variables_[v]) list.push_back(static_cast<int>(v));
  }
  return list;
}

}  // namespace stepwright::pddl
