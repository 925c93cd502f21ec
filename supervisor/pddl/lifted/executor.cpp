#include "supervisor/pddl/lifted/executor.h"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "supervisor/lisp/name_hints.h"
#include "supervisor/pddl/definition/numeric.h"
#include "supervisor/pddl/lifted/derive.h"

namespace stepwright::pddl {
namespace {

struct NumericChange {
  ChangeKind kind;
  double amount;
};

// The effects of one action, all read from the state before it.
class Effects {
 public:
  Effects(const Definition& definition, const LiftedState& before)
      : definition_(definition), before_(before) {}

  void collect(const Effect& effect, Binding& binding) {
    switch (effect.kind) {
      case EffectKind::And:
        for (const Effect& part : effect.parts) collect(part, binding);
        break;
      case EffectKind::Add:
        adds_.push_back(ground(effect.call, binding));
        break;
      case EffectKind::Delete:
        deletes_.push_back(ground(effect.call, binding));
        break;
      case EffectKind::When:
        if (holds(definition_, effect.condition[0], binding, before_)) collect(effect.parts[0], binding);
        break;
      case EffectKind::Forall:
        for_each_binding(definition_, effect.variables, binding, [&] {
          collect(effect.parts[0], binding);
          return true;
        });
        break;
      case EffectKind::Numeric:
        numeric(effect, binding);
        break;
    }
  }

  // Deletes come before adds (Fox, Long 2003, section 6.1). `state` is the one before the action; it changes
  // only if nothing fails.
  std::optional<Failure> apply(LiftedState& state) const {
    if (failure_) return failure_;
    std::vector<std::pair<const Atom*, double>> values;
    for (const auto& [fluent, changes] : numeric_) {
      double value = 0.0;
      if (auto failure = combine(fluent, changes, value)) return failure;
      values.emplace_back(&fluent, value);
    }
    for (const auto& [fluent, value] : values) state.fluents[*fluent] = value;
    for (const Atom& fact : deletes_) state.facts.erase(fact);
    for (const Atom& fact : adds_) state.facts.insert(fact);
    return std::nullopt;
  }

 private:
  void numeric(const Effect& effect, const Binding& binding) {
    const auto amount = evaluate(effect.amount[0], binding, before_);
    if (!amount) {
      failure_ = Failure{"P0306",
                         "the value of " + print(definition_, effect.amount[0], binding) + " is undefined",
                         "a fluent in it has no value yet, or a divisor is zero",
                         {}};
      return;
    }
    numeric_[ground(effect.call, binding)].push_back({effect.change, *amount});
  }

  // The fluent's value after all changes of it.
  std::optional<Failure> combine(const Atom& fluent, const std::vector<NumericChange>& changes,
                                 double& value) const {
    const std::string name = fluent_name(definition_, fluent);
    const auto old = before_.fluents.find(fluent);
    value = old == before_.fluents.end() ? 0.0 : old->second;
    bool additive = true;
    for (const NumericChange& change : changes) {
      const bool assign = change.kind == ChangeKind::Assign;
      additive = additive && (change.kind == ChangeKind::Increase || change.kind == ChangeKind::Decrease);
      if (!additive && changes.size() > 1) {
        return Failure{
            "P0308", "the action changes " + name + " in two ways that exclude each other", {}, {}};
      }
      if (!assign && old == before_.fluents.end()) {
        return Failure{"P0306", name + " is changed but has no value", "give it one in ':init'", {}};
      }
      if (assign) value = change.amount;
      if (change.kind == ChangeKind::Increase) value += change.amount;
      if (change.kind == ChangeKind::Decrease) value -= change.amount;
      if (change.kind == ChangeKind::ScaleUp) value *= change.amount;
      if (change.kind == ChangeKind::ScaleDown) value /= change.amount;
    }
    if (!std::isfinite(value))
      return Failure{"P0307", name + " has no finite value after the action", {}, {}};
    value = snap(value);
    return std::nullopt;
  }

  const Definition& definition_;
  const LiftedState& before_;
  std::vector<Atom> adds_, deletes_;
  std::map<Atom, std::vector<NumericChange>> numeric_;
  std::optional<Failure> failure_;
};

}  // namespace

std::optional<BoundAction> bind(const Definition& definition, const model::GroundAction& action,
                                Failure& failure) {
  const auto found = definition.action_ids.find(action.name);
  if (found == definition.action_ids.end()) {
    failure = {"P0301",
               "unknown action '" + action.name + "'",
               lisp::did_you_mean(action.name, lisp::names_of(definition.action_ids)),
               {}};
    return std::nullopt;
  }
  const Action& schema = definition.actions[static_cast<std::size_t>(found->second)];
  if (action.arguments.size() != schema.parameters.size()) {
    failure = {"P0302",
               "'" + action.name + "' takes " + std::to_string(schema.parameters.size()) +
                   " argument(s), not " + std::to_string(action.arguments.size()),
               {},
               {}};
    return std::nullopt;
  }
  BoundAction bound{&schema, Binding(static_cast<std::size_t>(schema.slots), -1)};
  for (std::size_t i = 0; i < action.arguments.size(); ++i) {
    const std::string& name = action.arguments[i];
    const auto object = definition.object_ids.find(name);
    if (object == definition.object_ids.end()) {
      failure = {"P0303",
                 "unknown object '" + name + "'",
                 lisp::did_you_mean(name, lisp::names_of(definition.object_ids)),
                 {}};
      return std::nullopt;
    }
    if (!definition.is_of_type(object->second, schema.parameters[i].type)) {
      failure = {"P0304", "'" + name + "' is not of type '" + schema.parameters[i].type_name + "'", {}, {}};
      return std::nullopt;
    }
    bound.binding[i] = object->second;
  }
  return bound;
}

std::optional<Failure> Executor::step(const model::GroundAction& action) {
  Failure failure;
  auto bound = bind(definition_, action, failure);
  if (!bound) return failure;
  Violation violation = first_violation(definition_, bound->action->precondition, bound->binding, state_);
  if (!violation.condition.empty()) {
    std::string message = "the precondition " + violation.condition + " does not hold";
    if (!violation.values.empty()) message += " (" + violation.values + ")";
    return Failure{"P0305", std::move(message), {}, std::move(violation)};
  }
  Effects effects(definition_, state_);
  effects.collect(bound->action->effect, bound->binding);
  if (auto wrong = effects.apply(state_)) return wrong;
  derive(definition_, state_);
  ++steps_;
  if (definition_.total_time >= 0) state_.fluents[Atom{definition_.total_time, {}}] += 1.0;
  return std::nullopt;
}

std::optional<double> Executor::cost() const {
  if (!definition_.metric) return static_cast<double>(steps_);
  const auto value = evaluate(definition_.metric->expression, {}, state_);
  if (!value) return std::nullopt;
  return snap(*value);
}

}  // namespace stepwright::pddl
