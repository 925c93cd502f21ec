#include "supervisor/pddl/plan/regression.h"

#include <algorithm>
#include <set>
#include <utility>

#include "supervisor/pddl/action/instantiate_action.h"
#include "supervisor/pddl/action/requirement_algebra.h"

namespace stepwright::pddl {
namespace {

// A goal that is larger costs more to reach than to plan anew.
constexpr std::size_t kLargest = 2000;
// Numeric effects under different conditions that one comparison may split into cases.
constexpr std::size_t kMostCases = 4;

bool is_numeric(const Change& change) {
  return change.kind != ChangeKind::Add && change.kind != ChangeKind::Delete;
}

void collect_fluents(const NumericNode& node, std::set<std::string>& fluents) {
  if (node.kind == NumericKind::Fluent) fluents.insert(node.fluent);
  for (const NumericNode& operand : node.operands) collect_fluents(operand, fluents);
}

// What a fluent is after `change`, in terms of what it was before.
NumericNode after_change(const Change& change, NumericNode before) {
  switch (change.kind) {
    case ChangeKind::Increase:
      return operation(NumericKind::Add, std::move(before), change.amount);
    case ChangeKind::Decrease:
      return operation(NumericKind::Subtract, std::move(before), change.amount);
    case ChangeKind::ScaleUp:
      return operation(NumericKind::Multiply, std::move(before), change.amount);
    case ChangeKind::ScaleDown:
      return operation(NumericKind::Divide, std::move(before), change.amount);
    default:
      return change.amount;
  }
}

class Regression {
 public:
  explicit Regression(const GroundActionInfo& action) : action_(action) {}

  // Nothing if a comparison has too many cases.
  std::optional<Requirement> before(const Requirement& after) {
    switch (after.kind) {
      case RequirementKind::Fact:
        return fact(after);
      case RequirementKind::Comparison:
        return compare(after);
      case RequirementKind::Any:
      case RequirementKind::All:
        break;
    }
    std::vector<Requirement> parts;
    for (const Requirement& part : after.parts) {
      auto regressed = before(part);
      if (!regressed) return std::nullopt;
      parts.push_back(std::move(*regressed));
    }
    return after.kind == RequirementKind::Any ? any_of(std::move(parts)) : all_of(std::move(parts));
  }

 private:
  static Requirement condition_of(const Change& change) {
    std::vector<Requirement> parts;
    for (const Requirement& part : change.when) parts.push_back(normalized(part));
    return all_of(std::move(parts));
  }

  // It holds if it is added, or held and is not deleted; an add wins over a delete.
  Requirement fact(const Requirement& after) const {
    std::vector<Requirement> added;
    std::vector<Requirement> stays{fact_is(after.fact, true)};
    for (const Change& change : action_.changes) {
      if (change.target != after.fact) continue;
      if (change.kind == ChangeKind::Add) added.push_back(condition_of(change));
      if (change.kind == ChangeKind::Delete) stays.push_back(negation(condition_of(change)));
    }
    added.push_back(all_of(std::move(stays)));
    const Requirement holds = any_of(std::move(added));
    return after.positive ? holds : negation(holds);
  }

  std::optional<Requirement> compare(const Requirement& after) const {
    std::set<std::string> fluents;
    collect_fluents(after.left, fluents);
    collect_fluents(after.right, fluents);
    std::vector<const Change*> always;
    std::vector<const Change*> sometimes;
    for (const Change& change : action_.changes) {
      if (!is_numeric(change) || !fluents.contains(change.target)) continue;
      (change.when.empty() ? always : sometimes).push_back(&change);
    }
    if (sometimes.size() > kMostCases) return std::nullopt;
    std::vector<Requirement> cases;
    for (std::size_t chosen = 0; chosen < (std::size_t{1} << sometimes.size()); ++chosen) {
      std::vector<const Change*> changes = always;
      std::vector<Requirement> parts;
      for (std::size_t i = 0; i < sometimes.size(); ++i) {
        const bool applies = (chosen >> i & 1U) != 0;
        const Requirement condition = condition_of(*sometimes[i]);
        parts.push_back(applies ? condition : negation(condition));
        if (applies) changes.push_back(sometimes[i]);
      }
      parts.push_back(with(after, changes));
      cases.push_back(all_of(std::move(parts)));
    }
    return any_of(std::move(cases));
  }

  static Requirement with(const Requirement& after, const std::vector<const Change*>& changes) {
    std::map<std::string, NumericNode> values;
    for (const Change* change : changes) {
      const auto entry = values.try_emplace(change->target, fluent_node(change->target)).first;
      entry->second = after_change(*change, entry->second);
    }
    return comparison(substituted(after.left, values), after.relation, substituted(after.right, values));
  }

  const GroundActionInfo& action_;
};

Requirement goal_of(const Task& task) {
  const Definition& definition = task.definition();
  ActionInstantiator instantiator(definition);
  Binding binding(static_cast<std::size_t>(definition.goal_slots), -1);
  std::vector<Requirement> conjuncts;
  instantiator.conjuncts(definition.goal, binding, conjuncts);
  for (Requirement& part : conjuncts) part = normalized(part);
  return all_of(std::move(conjuncts));
}

std::optional<std::string> formula_of(const std::optional<Requirement>& requirement) {
  if (!requirement) return std::nullopt;
  return is_true(*requirement) ? "(and)" : requirement->text;
}

}  // namespace

result::Result<std::vector<std::optional<std::string>>> weakest_preconditions(
    const Task& task, const std::vector<model::GroundAction>& actions) {
  std::vector<std::optional<std::string>> formulas(actions.size() + 1);
  ActionInspector inspector(task);
  std::optional<Requirement> needed = goal_of(task);
  formulas.back() = formula_of(needed);
  for (std::size_t i = actions.size(); i-- > 0;) {
    auto info = inspector.inspect(actions[i]);
    if (!info) return result::forward(info);
    if (needed) needed = Regression(*info).before(*needed);
    if (!needed) continue;
    std::vector<Requirement> parts;
    for (const Requirement& precondition : info->preconditions) parts.push_back(normalized(precondition));
    parts.push_back(std::move(*needed));
    needed = all_of(std::move(parts));
    if (is_false(*needed) || size_of(*needed) > kLargest) needed.reset();
    formulas[i] = formula_of(needed);
  }
  return formulas;
}

}  // namespace stepwright::pddl
