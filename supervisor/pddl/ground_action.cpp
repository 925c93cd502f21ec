#include "supervisor/pddl/ground_action.h"

#include <algorithm>

#include "supervisor/pddl/lifted/instantiate_action.h"
#include "supervisor/pddl/lifted/usage.h"

namespace stepwright::pddl {
namespace {

void read(const NumericNode& node, std::set<std::string>& names) {
  if (node.kind == NumericKind::Fluent) names.insert(node.fluent);
  for (const NumericNode& operand : node.operands) read(operand, names);
}

void read(const Requirement& requirement, std::set<std::string>& names) {
  if (requirement.kind == RequirementKind::Fact) names.insert(requirement.fact);
  if (requirement.kind == RequirementKind::Comparison) {
    read(requirement.left, names);
    read(requirement.right, names);
  }
  for (const Requirement& part : requirement.parts) read(part, names);
}

// A fluent only counts for the metric if every change of it here adds or subtracts.
void find_counts(const Definition& definition, GroundActionInfo& info) {
  const std::set<int> pure = metric_only_functions(definition);
  for (const Change& change : info.changes) {
    const std::string name = change.target.substr(1, change.target.find_first_of(" )") - 1);
    const auto function = definition.function_ids.find(name);
    const bool numeric = change.kind != ChangeKind::Add && change.kind != ChangeKind::Delete;
    if (numeric && function != definition.function_ids.end() && pure.count(function->second) != 0) {
      info.counts.insert(change.target);
    }
  }
  for (const Change& change : info.changes) {
    if (change.kind != ChangeKind::Increase && change.kind != ChangeKind::Decrease) {
      info.counts.erase(change.target);
    }
  }
}

}  // namespace

result::Result<GroundActionInfo> inspect_action(const Task& task, const model::GroundAction& action) {
  const Definition& definition = task.definition();
  Failure failure;
  auto bound = bind(definition, action, failure);
  if (!bound) {
    return result::fail(failure.code, {"plan", 0, 0}, model::to_string(action) + ": " + failure.message,
                        failure.hint);
  }
  ActionInstantiator instantiator(definition);
  GroundActionInfo info;
  info.action = action;
  instantiator.conjuncts(bound->action->precondition, bound->binding, info.preconditions);
  instantiator.changes(bound->action->effect, bound->binding, {}, info.changes);
  for (const Requirement& requirement : info.preconditions) read(requirement, info.reads);
  for (const Change& change : info.changes) {
    for (const Requirement& requirement : change.when) read(requirement, info.reads);
    read(change.amount, info.reads);
    info.writes.insert(change.target);
  }
  find_counts(definition, info);
  return info;
}

}  // namespace stepwright::pddl
