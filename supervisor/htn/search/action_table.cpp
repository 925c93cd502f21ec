#include "supervisor/htn/search/action_table.h"

#include <algorithm>

namespace stepwright::htn {

const GroundAction& ActionTable::get(int ground, int action, std::span<const int> objects) {
  const auto at = static_cast<std::size_t>(ground);
  if (at >= place_.size()) place_.resize(at + 1, -1);
  if (place_[at] < 0) {
    GroundAction prepared = prepare(action, objects);
    place_[at] = static_cast<int>(actions_.size());
    actions_.push_back(std::move(prepared));
  }
  return actions_[static_cast<std::size_t>(place_[at])];
}

void ActionTable::bind(const GroundAction& ground) {
  binding_.assign(static_cast<std::size_t>(ground.action->slots), -1);
  std::ranges::copy(ground.objects, binding_.begin());
}

int ActionTable::fact_of(int predicate, const std::vector<Term>& terms) {
  row_.clear();
  for (const Term term : terms) row_.push_back(object_of(term, binding_));
  return state_.fact(predicate, row_);
}

GroundAction ActionTable::prepare(int action, std::span<const int> objects) {
  GroundAction ground;
  ground.action = &task_.actions[static_cast<std::size_t>(action)];
  ground.objects.assign(objects.begin(), objects.end());
  bind(ground);
  for (std::size_t i = 0; i < objects.size(); ++i)
    ground.possible = ground.possible && task_.is_of_type(objects[i], ground.action->parameters[i].type);
  for (const Condition& part : ground.action->condition.parts) add_condition(part, ground);
  bool defined = true;
  ground.cost = cost_of(*ground.action, defined);
  ground.possible = ground.possible && defined;
  add_effects(ground);
  return ground;
}

// What no action changes is decided now.
void ActionTable::add_condition(const Condition& condition, GroundAction& ground) {
  const bool negated = condition.kind == ConditionKind::Not;
  const Condition& atom = negated ? condition.parts[0] : condition;
  if (atom.kind == ConditionKind::Equal || atom.kind == ConditionKind::OfType) {
    ground.possible = ground.possible && holds(condition, binding_, evaluation());
  } else if (atom.kind == ConditionKind::Atom) {
    const int fact = fact_of(atom.symbol, atom.terms);
    if (task_.predicates[static_cast<std::size_t>(atom.symbol)].changes) {
      (negated ? ground.forbids : ground.needs).push_back(fact);
    } else {
      ground.possible = ground.possible && state_.holds(fact) != negated;
    }
  } else {
    ground.conditions.push_back(&condition);
  }
}

void ActionTable::add_effects(GroundAction& ground) {
  const std::vector<Effect>& effects = ground.action->effects;
  const bool plain = std::ranges::all_of(effects, [](const Effect& effect) {
    return effect.variables.empty() && effect.condition.parts.empty();
  });
  for (const Effect& effect : effects) {
    if (plain) {
      (effect.add ? ground.adds : ground.deletes).push_back(fact_of(effect.predicate, effect.terms));
    } else {
      ground.effects.push_back(&effect);
    }
  }
  std::erase_if(ground.deletes,
                [&](int fact) { return std::ranges::find(ground.adds, fact) != ground.adds.end(); });
}

double ActionTable::cost_of(const Action& action, bool& defined) const {
  double cost = 0.0;
  for (const Amount& amount : action.costs) {
    if (amount.function < 0) {
      cost += amount.number;
      continue;
    }
    GroundAtom atom{amount.function, {}};
    for (const Term term : amount.terms) atom.objects.push_back(object_of(term, binding_));
    const auto value = task_.values.find(atom);
    defined = defined && value != task_.values.end();
    if (value != task_.values.end()) cost += value->second;
  }
  return cost;
}

bool ActionTable::applicable(const GroundAction& ground) {
  const auto true_now = [&](int fact) { return state_.holds(fact); };
  if (!ground.possible || !std::ranges::all_of(ground.needs, true_now) ||
      std::ranges::any_of(ground.forbids, true_now))
    return false;
  if (ground.conditions.empty()) return true;
  bind(ground);
  return std::ranges::all_of(ground.conditions, [&](const Condition* condition) {
    return holds(*condition, binding_, evaluation());
  });
}

// All effects are decided in the state before; what is both deleted and added holds.
void ActionTable::apply(const GroundAction& ground) {
  for (const int fact : ground.deletes) state_.set(fact, false);
  for (const int fact : ground.adds) state_.set(fact, true);
  if (ground.effects.empty()) return;
  bind(ground);
  changes_.clear();
  for (const Effect* effect : ground.effects) {
    each_choice(effect->variables, 0, binding_, evaluation(), [&] {
      if (holds(effect->condition, binding_, evaluation()))
        changes_.emplace_back(fact_of(effect->predicate, effect->terms), effect->add);
    });
  }
  for (const auto& [fact, add] : changes_)
    if (!add) state_.set(fact, false);
  for (const auto& [fact, add] : changes_)
    if (add) state_.set(fact, true);
}

std::string ActionTable::text_of(int fact) const {
  std::string text = "(" + task_.predicates[static_cast<std::size_t>(state_.predicate(fact))].name;
  for (const int object : state_.objects(fact))
    text += " " + task_.objects[static_cast<std::size_t>(object)].name;
  return text + ")";
}

std::string ActionTable::obstacle(const GroundAction& ground) {
  for (const int fact : ground.needs)
    if (!state_.holds(fact)) return text_of(fact) + " does not hold";
  for (const int fact : ground.forbids)
    if (state_.holds(fact)) return text_of(fact) + " holds";
  return ground.possible ? "its precondition does not hold" : "no state allows it";
}

}  // namespace stepwright::htn
