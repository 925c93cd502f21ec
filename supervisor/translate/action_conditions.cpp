#include "supervisor/translate/action_conditions.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace stepwright::translate {

namespace {

result::Result<ActionConditions> problem(const char* code, const Binding& binding, const ActionBinding& entry,
                                         std::string message, std::string hint = {}) {
  result::Location where = entry.where;
  if (where.file.empty()) where.file = binding.file;
  return result::fail(code, std::move(where), std::move(message), std::move(hint));
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

result::Result<ActionConditions> complete_by_fact(ActionConditions conditions, const std::string& atom,
                                                  const model::PlannedAction& planned,
                                                  const Binding& binding) {
  const ObservedFact* fact = binding.observed(atom);
  if (fact == nullptr) {
    return problem("T0003", binding, *conditions.entry,
                   to_string(planned.action) + " ends with " + atom + ", which no [[facts]] entry observes");
  }
  if (!planned.after.facts.contains(atom)) {
    return problem("T0004", binding, *conditions.entry,
                   to_string(planned.action) + " ends with " + atom + ", which it does not bring about");
  }
  conditions.complete = fact_is(*fact, true);
  conditions.complete_text = fact->label;
  return conditions;
}

result::Result<ActionConditions> complete_by_level(ActionConditions conditions, const std::string& atom,
                                                   const model::PlannedAction& planned,
                                                   const Binding& binding, const Tare& tare,
                                                   const Offsets& offsets) {
  const Sensor* sensor = binding.sensor_of(atom);
  const auto before = planned.before.fluents.find(atom);
  const auto after = planned.after.fluents.find(atom);
  const std::string who = to_string(planned.action);
  if (sensor == nullptr || before == planned.before.fluents.end() || after == planned.after.fluents.end()) {
    const char* why = sensor == nullptr ? ", which no sensor measures" : ", which the plan's states lack";
    return problem("T0003", binding, *conditions.entry, who + " ends with " + atom + why);
  }
  const double change = after->second - before->second;
  if (change == 0.0) {
    return problem("T0004", binding, *conditions.entry,
                   who + " ends with " + atom + ", which it does not change");
  }
  // A pump that stops half-way at the earliest always runs, whatever its run-out. The way is that from where
  // the level really is.
  const auto offset = offsets.find(atom);
  const double excess = offset == offsets.end() ? 0.0 : offset->second;
  const double way = std::max(0.0, (change - excess) * std::copysign(1.0, change));
  const double pre_act = std::min(conditions.entry->completion.pre_act, way / 2.0);
  const double stop_at = after->second - std::copysign(pre_act, change);
  const std::string& type = binding.tag(sensor->tag)->type;
  if (threshold(*sensor, type, tare, stop_at).limited) {
    return problem("T0004", binding, *conditions.entry,
                   who + " ends with " + atom + " = " + short_number(after->second) + ", which sensor " +
                       sensor->name + " cannot show",
                   "the counts at this level lie outside the range of " + type);
  }
  conditions.complete =
      change > 0.0 ? at_least(*sensor, type, tare, stop_at) : at_most(*sensor, type, tare, stop_at);
  conditions.complete_text =
      sensor->label + (change > 0.0 ? " rises to " : " falls to ") + short_number(after->second);
  return conditions;
}

milliseconds in_ms(double seconds) {
  return milliseconds(std::lround(seconds * 1e3));
}

// A level that has moved by less than half a unit in the time of three is not moved by the action.
std::optional<Idle> idle_level(const ActionConditions& conditions, const std::string& atom,
                               const model::PlannedAction& planned, const Binding& binding, const Tare& tare,
                               const Offsets& offsets, const std::string& counted) {
  const DurationModel& duration = conditions.entry->duration;
  if (counted != atom || duration.per_unit_s <= 0.0) return std::nullopt;
  const Sensor& sensor = *binding.sensor_of(atom);
  const auto offset = offsets.find(atom);
  const double start = planned.before.fluents.at(atom) + (offset == offsets.end() ? 0.0 : offset->second);
  const double change = planned.after.fluents.at(atom) - start;
  const double least = std::min(0.5, std::abs(change) / 2.0);
  if (least <= sensor.tolerance) return std::nullopt;
  const std::string& type = binding.tag(sensor.tag)->type;
  return Idle{in_ms(duration.fixed_s + 3.0 * duration.per_unit_s),
              change > 0.0 ? at_most(sensor, type, tare, start + least)
                           : at_least(sensor, type, tare, start - least)};
}

// What leaves a place has left it after half of the way.
std::optional<Idle> idle_place(const ActionConditions& conditions, const model::PlannedAction& planned,
                               const Binding& binding, const std::string& counted) {
  const DurationModel& duration = conditions.entry->duration;
  const auto amount = planned.before.fluents.find(counted);
  if (duration.per_unit_s <= 0.0 || amount == planned.before.fluents.end()) return std::nullopt;
  std::vector<graphic::Condition> still;
  for (const ObservedFact& fact : binding.facts) {
    const bool left = planned.before.facts.contains(fact.fact) && !planned.after.facts.contains(fact.fact);
    if (left) still.push_back(fact_is(fact, true));
  }
  if (still.empty()) return std::nullopt;
  return Idle{in_ms(duration.fixed_s + 0.5 * duration.per_unit_s * std::abs(amount->second)),
              graphic::any(std::move(still))};
}

}  // namespace

result::Result<ActionConditions> action_conditions(const model::PlannedAction& planned,
                                                   const Binding& binding, const Tare& tare,
                                                   const Offsets& offsets) {
  Assignment assignment;
  ActionConditions conditions;
  conditions.entry = binding.action_for(planned.action, assignment);
  if (conditions.entry == nullptr) {
    return result::fail("T0001", {binding.file, 0, 0},
                        "no entry of the binding matches " + to_string(planned.action));
  }
  auto guard = make_guard(planned, binding, tare, offsets);
  if (!guard) return result::forward(guard);
  conditions.guard = std::move(*guard);
  for (const Pattern& pattern : conditions.entry->hold) {
    const std::string atom = instantiate(pattern, assignment);
    const ObservedFact* fact = binding.observed(atom);
    if (fact == nullptr) {
      return problem(
          "T0003", binding, *conditions.entry,
          to_string(planned.action) + " must hold " + atom + ", which no [[facts]] entry observes");
    }
    conditions.hold.push_back(fact_is(*fact, true));
  }
  const Completion& completion = conditions.entry->completion;
  const std::string atom = instantiate(completion.atom, assignment);
  const auto& of = conditions.entry->duration.of;
  const std::string counted = of ? instantiate(*of, assignment) : std::string();
  if (completion.kind == CompletionKind::Fact) {
    auto complete = complete_by_fact(std::move(conditions), atom, planned, binding);
    if (complete) complete->idle = idle_place(*complete, planned, binding, counted);
    return complete;
  }
  auto complete = complete_by_level(std::move(conditions), atom, planned, binding, tare, offsets);
  if (complete) complete->idle = idle_level(*complete, atom, planned, binding, tare, offsets, counted);
  return complete;
}

graphic::Condition snapshot_condition(const model::NamedState& state, const Binding& binding,
                                      const Tare& tare) {
  std::vector<graphic::Condition> parts;
  for (const ObservedFact& fact : binding.facts) {
    parts.push_back(fact_is(fact, state.facts.contains(fact.fact)));
  }
  for (const Sensor& sensor : binding.sensors) {
    const auto value = state.fluents.find(sensor.fluent);
    if (value == state.fluents.end()) continue;
    parts.push_back(near(sensor, binding.tag(sensor.tag)->type, tare, value->second, sensor.tolerance));
  }
  return graphic::all(std::move(parts));
}

}  // namespace stepwright::translate
