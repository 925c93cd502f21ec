#include "cell/binding/ground_actions.h"

#include <algorithm>
#include <string>
#include <utility>

#include "supervisor/pddl/definition/ast.h"

namespace stepwright::cell_binding {
namespace {

// No state can have it: a disjunction without parts.
bool is_impossible(const pddl::Requirement& requirement) {
  return requirement.kind == pddl::RequirementKind::Any && requirement.parts.empty();
}

// A comparison of constants that does not hold.
bool is_false(const pddl::Requirement& requirement) {
  if (requirement.kind != pddl::RequirementKind::Comparison) return false;
  const bool constant = requirement.left.kind == pddl::NumericKind::Constant &&
                        requirement.right.kind == pddl::NumericKind::Constant;
  if (!constant) return false;
  const double difference = requirement.left.constant - requirement.right.constant;
  constexpr double kEqual = 1e-9;
  switch (requirement.relation) {
    case pddl::Relation::Less:
      return difference >= -kEqual;
    case pddl::Relation::LessEqual:
      return difference > kEqual;
    case pddl::Relation::Equal:
      return difference > kEqual || difference < -kEqual;
    case pddl::Relation::GreaterEqual:
      return difference < -kEqual;
    case pddl::Relation::Greater:
      return difference <= kEqual;
  }
  return false;
}

// The next combination, the last parameter first; false behind the last one.
bool advance(std::vector<std::size_t>& chosen, const std::vector<const std::vector<int>*>& choices) {
  for (std::size_t i = chosen.size(); i-- > 0;) {
    if (++chosen[i] < choices[i]->size()) return true;
    chosen[i] = 0;
  }
  return false;
}

}  // namespace

GroundActions ground_actions(const pddl::Task& task, std::size_t most) {
  const pddl::Definition& definition = task.definition();
  pddl::ActionInspector inspector(task);
  GroundActions found;
  std::size_t combinations = 0;
  for (const pddl::Action& action : definition.actions) {
    std::vector<const std::vector<int>*> choices;
    for (const pddl::Typed& parameter : action.parameters)
      choices.push_back(&definition.objects_by_type[static_cast<std::size_t>(parameter.type)]);
    if (std::ranges::any_of(choices, [](const auto* each) { return each->empty(); })) continue;
    std::vector<std::size_t> chosen(choices.size(), 0);
    do {
      if (++combinations > most) {
        found.complete = false;
        return found;
      }
      model::GroundAction ground{action.name, {}};
      for (std::size_t i = 0; i < chosen.size(); ++i)
        ground.arguments.push_back(
            definition.objects[static_cast<std::size_t>((*choices[i])[chosen[i]])].name);
      auto info = inspector.inspect(ground);
      if (!info) continue;
      const auto excludes = [](const auto& each) { return is_impossible(each) || is_false(each); };
      if (std::ranges::none_of(info->preconditions, excludes)) found.actions.push_back(std::move(*info));
    } while (advance(chosen, choices));
  }
  return found;
}

std::string precondition_text(const pddl::GroundActionInfo& info) {
  std::string text = "(and";
  for (const pddl::Requirement& each : info.preconditions) text += " " + each.text;
  return text + ")";
}

}  // namespace stepwright::cell_binding
