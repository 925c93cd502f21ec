#include "supervisor/pddl/action/instantiate_action.h"

#include "supervisor/pddl/definition/numeric.h"
#include "supervisor/pddl/lifted/static_truth.h"

namespace stepwright::pddl {
namespace {

constexpr std::uint64_t kStepsBetweenChecks = 1024;

Requirement impossible(std::string text) {
  Requirement requirement;
  requirement.kind = RequirementKind::Any;
  requirement.text = std::move(text);
  return requirement;
}

bool constant(const NumericNode& node) {
  return node.kind == NumericKind::Constant;
}

}  // namespace

bool ActionInstantiator::time_to_stop() {
  if (!stopped_ && stop_ && ++steps_ % kStepsBetweenChecks == 0) stopped_ = stop_();
  return stopped_;
}

// Calls `visit` for every combination of objects for the quantifier's variables from `next` on, but for those
// for which static facts give its part the truth that is `needless`. False if `visit` or the clock says so.
bool ActionInstantiator::instances(const Formula& formula, std::size_t next, Binding& binding, bool needless,
                                   const std::function<bool()>& visit) {
  if (next == formula.variables.size()) return visit();
  const Typed& variable = formula.variables[next];
  int& place = binding[static_cast<std::size_t>(variable.slot)];
  bool goes_on = true;
  for (const int object : definition_.objects_by_type[static_cast<std::size_t>(variable.type)]) {
    place = object;
    const bool decided = static_truth(definition_, formula.parts[0], binding, initial_) == needless;
    goes_on = !time_to_stop() && (decided || instances(formula, next + 1, binding, needless, visit));
    if (!goes_on) break;
  }
  place = -1;
  return goes_on;
}

NumericNode ActionInstantiator::number(const Expression& expression, const Binding& binding) const {
  NumericNode node;
  node.kind = expression.kind;
  node.constant = expression.number;
  bool folded = true;
  if (expression.kind == NumericKind::Fluent) {
    node.fluent = fluent_name(definition_, ground(expression.call, binding));
    folded = !definition_.functions[static_cast<std::size_t>(expression.call.symbol)].changes;
  }
  for (const Expression& operand : expression.operands) {
    node.operands.push_back(number(operand, binding));
    folded = folded && constant(node.operands.back());
  }
  // Sums and products of more than two become nested pairs.
  while (node.operands.size() > 2) {
    NumericNode pair;
    pair.kind = node.kind;
    pair.operands = {std::move(node.operands[0]), std::move(node.operands[1])};
    node.operands.erase(node.operands.begin());
    node.operands[0] = std::move(pair);
  }
  if (!folded || expression.kind == NumericKind::Constant) return node;
  const auto value = evaluate(expression, binding, initial_);
  if (!value) return node;  // Undefined: it stays visible by its name.
  NumericNode folded_node;
  folded_node.constant = *value;
  return folded_node;
}

void ActionInstantiator::conjuncts(const Formula& formula, Binding& binding, std::vector<Requirement>& list) {
  collect(formula, binding, true, list);
}

void ActionInstantiator::atom(const Formula& formula, const Binding& binding, bool positive,
                              std::vector<Requirement>& list) {
  const Atom fact = ground(formula.call, binding);
  const std::string name = fact_name(definition_, fact);
  const std::string text = positive ? name : "(not " + name + ")";
  if (!definition_.predicates[static_cast<std::size_t>(fact.symbol)].changes) {
    if ((initial_.facts.count(fact) != 0) != positive) list.push_back(impossible(text));
    return;
  }
  Requirement requirement;
  requirement.text = text;
  requirement.fact = name;
  requirement.positive = positive;
  list.push_back(std::move(requirement));
}

void ActionInstantiator::comparison(const Formula& formula, Binding& binding, bool positive,
                                    std::vector<Requirement>& list) {
  Requirement requirement;
  requirement.kind = RequirementKind::Comparison;
  requirement.left = number(formula.sides[0], binding);
  requirement.right = number(formula.sides[1], binding);
  requirement.relation = positive ? formula.relation : opposite(formula.relation);
  requirement.text = print(definition_, formula, binding);
  if (!positive) requirement.text = "(not " + requirement.text + ")";
  if (constant(requirement.left) && constant(requirement.right)) {
    if (holds(definition_, formula, binding, initial_) != positive)
      list.push_back(impossible(requirement.text));
    return;
  }
  if (positive || formula.relation != Relation::Equal) {
    list.push_back(std::move(requirement));
    return;
  }
  // "Not equal" is "less or greater".
  Requirement either = impossible(requirement.text);
  requirement.relation = Relation::Less;
  either.parts.push_back(requirement);
  requirement.relation = Relation::Greater;
  either.parts.push_back(std::move(requirement));
  list.push_back(std::move(either));
}

// Calls collect for every part of a connective or every instance of a quantifier.
void ActionInstantiator::collect_parts(const Formula& formula, Binding& binding, bool positive,
                                       std::vector<Requirement>& list) {
  if (formula.variables.empty()) {
    for (std::size_t i = 0; i < formula.parts.size(); ++i) {
      const bool flip = formula.kind == FormulaKind::Imply && i == 0;
      collect(formula.parts[i], binding, positive != flip, list);
    }
    return;
  }
  instances(formula, 0, binding, positive, [&] {
    collect(formula.parts[0], binding, positive, list);
    return true;
  });
}

Requirement ActionInstantiator::any(const Formula& formula, Binding& binding, bool positive) {
  Requirement either = impossible(print(definition_, formula, binding));
  if (!positive) either.text = "(not " + either.text + ")";
  const auto alternative = [&](const Formula& part, bool sign) {
    Requirement all;
    all.kind = RequirementKind::All;
    all.text = print(definition_, part, binding);
    collect(part, binding, sign, all.parts);
    const bool holds_always = all.parts.empty();
    either.parts.push_back(all.parts.size() == 1 ? Requirement(all.parts[0]) : std::move(all));
    return !holds_always;
  };
  if (!formula.variables.empty()) {
    instances(formula, 0, binding, !positive, [&] { return alternative(formula.parts[0], positive); });
  } else {
    for (std::size_t i = 0; i < formula.parts.size(); ++i) {
      alternative(formula.parts[i], positive != (formula.kind == FormulaKind::Imply && i == 0));
    }
  }
  return either;
}

void ActionInstantiator::collect(const Formula& formula, Binding& binding, bool positive,
                                 std::vector<Requirement>& list) {
  switch (formula.kind) {
    case FormulaKind::Atom:
      return atom(formula, binding, positive, list);
    case FormulaKind::Compare:
      return comparison(formula, binding, positive, list);
    case FormulaKind::Not:
      return collect(formula.parts[0], binding, !positive, list);
    case FormulaKind::SameObject:
      if (holds(definition_, formula, binding, initial_) != positive) {
        list.push_back(impossible(print(definition_, formula, binding)));
      }
      return;
    default:
      break;
  }
  const bool conjunction = formula.kind == FormulaKind::And || formula.kind == FormulaKind::Forall;
  if (conjunction == positive) return collect_parts(formula, binding, positive, list);
  Requirement either = any(formula, binding, positive);
  for (const Requirement& part : either.parts) {
    if (part.kind == RequirementKind::All && part.parts.empty()) return;  // One alternative always holds.
  }
  std::erase_if(either.parts, [](const Requirement& part) {
    return part.kind == RequirementKind::Any && part.parts.empty();
  });
  list.push_back(std::move(either));
}

void ActionInstantiator::changes(const Effect& effect, Binding& binding, const std::vector<Requirement>& when,
                                 std::vector<Change>& list) {
  if (effect.kind == EffectKind::When) {
    std::vector<Requirement> conditions = when;
    conjuncts(effect.condition[0], binding, conditions);
    for (const Requirement& condition : conditions) {
      if (condition.kind == RequirementKind::Any && condition.parts.empty()) return;
    }
    return changes(effect.parts[0], binding, conditions, list);
  }
  if (effect.kind == EffectKind::Forall) {
    for_each_binding(definition_, effect.variables, binding, [&] {
      changes(effect.parts[0], binding, when, list);
      return !time_to_stop();
    });
    return;
  }
  for (const Effect& part : effect.parts) changes(part, binding, when, list);
  if (effect.kind == EffectKind::And) return;
  Change change;
  change.when = when;
  const Atom target = ground(effect.call, binding);
  if (effect.kind == EffectKind::Numeric) {
    change.kind = effect.change;
    change.target = fluent_name(definition_, target);
    change.amount = number(effect.amount[0], binding);
  } else {
    change.kind = effect.kind == EffectKind::Add ? ChangeKind::Add : ChangeKind::Delete;
    change.target = fact_name(definition_, target);
  }
  list.push_back(std::move(change));
}

}  // namespace stepwright::pddl
