#include "supervisor/tamp/predicates/grounding.h"

#include <algorithm>

namespace stepwright::tamp::predicates {

const std::vector<std::string>& geometric_predicates() {
  static const std::vector<std::string> names = {"can-move-pick", "is-picked",     "can-move-place",
                                                 "is-placed",     "can-move-away", "is-away"};
  return names;
}

std::optional<scene::ActionSpec> action_of(const scene::RobotCell& cell, const std::string& predicate,
                                           const std::vector<std::string>& names) {
  const bool pick = predicate == "can-move-pick" || predicate == "is-picked";
  const bool place = predicate == "can-move-place" || predicate == "is-placed";
  const bool away = predicate == "can-move-away" || predicate == "is-away";
  if (names.size() != (away ? 2u : 3u) || (!pick && !place && !away)) return std::nullopt;
  scene::ActionSpec action;
  action.kind = pick    ? scene::ActionKind::Pick
                : place ? scene::ActionKind::Place
                        : scene::ActionKind::MoveAway;
  action.arm = cell.arm(names.front());
  action.thing = cell.thing(names.back());
  if (place) {
    action.surface = cell.surface(names[1]);
    if (action.surface < 0) action.on = cell.thing(names[1]);
    if (action.on >= 0 && !cell.things[static_cast<std::size_t>(action.on)].carries) return std::nullopt;
  }
  if (action.arm < 0 || action.thing < 0 || (place && action.surface < 0 && action.on < 0))
    return std::nullopt;
  return action;
}

Grounding::Grounding(const htn::PlanningTask& task, const scene::RobotCell& cell)
    : task_(&task), cell_(&cell) {}

std::optional<scene::ActionSpec> Grounding::action_of(const htn::ExternalCall& atom) const {
  std::vector<std::string> names;
  for (const int object : atom.objects)
    names.push_back(task_->objects[static_cast<std::size_t>(object)].name);
  return predicates::action_of(*cell_, task_->predicates[static_cast<std::size_t>(atom.symbol)].name, names);
}

std::vector<scene::ActionSpec> Grounding::actions_of(const htn::Plan& plan,
                                                     std::vector<std::size_t>& steps) const {
  std::vector<scene::ActionSpec> actions;
  steps.clear();
  for (std::size_t k = 0; k < plan.steps.size(); ++k) {
    const htn::PlanNode& node = plan.nodes[plan.steps[k]];
    const auto action = std::find_if(task_->actions.begin(), task_->actions.end(),
                                     [&](const htn::Action& each) { return each.name == node.name; });
    if (action == task_->actions.end()) continue;
    for (const htn::ExternalLiteral& effect : action->external_effects) {
      std::vector<std::string> names;
      for (const htn::Term term : effect.terms)
        names.push_back(term < 0 ? task_->objects[static_cast<std::size_t>(~term)].name
                                 : node.arguments[static_cast<std::size_t>(term)]);
      if (const auto meant = predicates::action_of(
              *cell_, task_->predicates[static_cast<std::size_t>(effect.predicate)].name, names)) {
        actions.push_back(*meant);
        steps.push_back(k);
      }
    }
  }
  return actions;
}

}  // namespace stepwright::tamp::predicates
