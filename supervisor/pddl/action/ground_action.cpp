#include "supervisor/pddl/action/ground_action.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "supervisor/pddl/action/instantiate_action.h"
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

// "(on a b)" as its words, without the parentheses.
std::vector<std::string> words_of(const std::string& fact) {
  std::istringstream text(fact.substr(1, fact.size() - 2));
  return {std::istream_iterator<std::string>(text), {}};
}

// Whoever reads a derived fact reads what its axioms read, down to facts and fluents that actions change.
class DerivedReads {
 public:
  DerivedReads(const Definition& definition, ActionInstantiator& instantiator)
      : definition_(definition), instantiator_(instantiator) {}

  void complete(std::set<std::string>& names) {
    if (definition_.axioms.empty()) return;
    std::vector<std::string> open(names.begin(), names.end());
    while (!open.empty() && !instantiator_.time_to_stop()) {
      const std::vector<std::string> words = words_of(open.back());
      open.pop_back();
      std::set<std::string> found;
      for (const Axiom& axiom : definition_.axioms) {
        if (axiom.name == words[0]) read_body(axiom, words, found);
      }
      for (const std::string& name : found) {
        if (names.insert(name).second) open.push_back(name);
      }
    }
  }

 private:
  void read_body(const Axiom& axiom, const std::vector<std::string>& words, std::set<std::string>& found) {
    if (words.size() != axiom.parameters.size() + 1) return;  // a fluent of the same name
    Binding binding(static_cast<std::size_t>(axiom.slots), -1);
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
      const int object = definition_.object_ids.at(words[i + 1]);
      if (!definition_.is_of_type(object, axiom.parameters[i].type)) return;
      binding[i] = object;
    }
    std::vector<Requirement> requirements;
    instantiator_.conjuncts(axiom.body, binding, requirements);
    for (const Requirement& requirement : requirements) read(requirement, found);
  }

  const Definition& definition_;
  ActionInstantiator& instantiator_;
};

// A fluent only counts for the metric if every change of it here adds or subtracts.
void find_counts(const Definition& definition, const std::set<int>& pure, GroundActionInfo& info) {
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

struct ActionInspector::Parts {
  const Definition& definition;
  ActionInstantiator instantiator;
  std::set<int> metric_only = metric_only_functions(definition);
};

ActionInspector::ActionInspector(const Task& task, std::function<bool()> stop)
    : parts_(new Parts{task.definition(), ActionInstantiator(task.definition(), std::move(stop))}) {}

ActionInspector::~ActionInspector() = default;

result::Result<GroundActionInfo> ActionInspector::inspect(const model::GroundAction& action) {
  const Definition& definition = parts_->definition;
  ActionInstantiator& instantiator = parts_->instantiator;
  Failure failure;
  auto bound = bind(definition, action, failure);
  if (!bound) {
    return result::fail(failure.code, {"plan", 0, 0}, model::to_string(action) + ": " + failure.message,
                        failure.hint);
  }
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
  DerivedReads(definition, instantiator).complete(info.reads);
  find_counts(definition, parts_->metric_only, info);
  if (instantiator.time_to_stop()) {
    return result::fail("P0311", {"plan", 0, 0}, model::to_string(action) + ": the budget ended",
                        "what it reads and changes was not worked out");
  }
  return info;
}

result::Result<GroundActionInfo> inspect_action(const Task& task, const model::GroundAction& action) {
  return ActionInspector(task).inspect(action);
}

}  // namespace stepwright::pddl
