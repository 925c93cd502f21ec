#include "supervisor/translate/change.h"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace stepwright::translate {

namespace {

Change planned_change(const model::PlannedAction& planned) {
  Change change;
  const auto& before = planned.before;
  const auto& after = planned.after;
  std::set_difference(after.facts.begin(), after.facts.end(), before.facts.begin(), before.facts.end(),
                      std::back_inserter(change.made_true));
  std::set_difference(before.facts.begin(), before.facts.end(), after.facts.begin(), after.facts.end(),
                      std::back_inserter(change.made_false));
  for (const auto& [fluent, value] : after.fluents) {
    const auto old = before.fluents.find(fluent);
    const double difference = value - (old == before.fluents.end() ? 0.0 : old->second);
    if (difference != 0.0) change.increase[fluent] = difference;
  }
  return change;
}

// The fluents that share the liquid of the completion's fluent: measured ones, and targets of transfers.
bool is_linked(const std::string& fluent, const Binding& binding, const ActionBinding& entry,
               const Assignment& assignment) {
  if (binding.sensor_of(fluent) != nullptr) return true;
  return std::any_of(entry.transfers.begin(), entry.transfers.end(), [&](const Transfer& transfer) {
    return instantiate(transfer.to, assignment) == fluent;
  });
}

// Accounts in `change` and `offsets` for an end at the absolute level that the plan names.
void even_out(const model::PlannedAction& planned, const Binding& binding, Change& change, Offsets& offsets) {
  Assignment assignment;
  const ActionBinding* entry = binding.action_for(planned.action, assignment);
  assert(entry != nullptr);
  if (entry->completion.kind != CompletionKind::Fluent) return;
  const std::string level = instantiate(entry->completion.atom, assignment);
  const auto offset = offsets.find(level);
  const auto increase = change.increase.find(level);
  if (offset == offsets.end() || increase == change.increase.end()) return;
  const double excess = offset->second;
  const double planned_increase = increase->second;
  for (auto& [fluent, amount] : change.increase) {
    if (fluent == level || !is_linked(fluent, binding, *entry, assignment)) continue;
    const double correction = -excess * amount / planned_increase;
    amount += correction;
    offsets[fluent] += correction;
  }
  increase->second -= excess;
  offsets.erase(level);
}

}  // namespace

ExpectedChanges expected_changes(const model::PlannedRun& run, const Binding& binding, Offsets offsets) {
  ExpectedChanges changes;
  for (const model::PlannedAction& planned : run.actions) {
    changes.before.push_back(offsets);
    changes.of_action.push_back(planned_change(planned));
    even_out(planned, binding, changes.of_action.back(), offsets);
  }
  return changes;
}

void apply(const Change& change, model::NamedState& state) {
  for (const std::string& fact : change.made_false) state.facts.erase(fact);
  for (const std::string& fact : change.made_true) state.facts.insert(fact);
  for (const auto& [fluent, amount] : change.increase) state.fluents[fluent] += amount;
}

std::set<std::string> changed_atoms(const model::PlannedAction& action) {
  const Change change = planned_change(action);
  std::set<std::string> atoms(change.made_true.begin(), change.made_true.end());
  atoms.insert(change.made_false.begin(), change.made_false.end());
  for (const auto& [fluent, amount] : change.increase) atoms.insert(fluent);
  return atoms;
}

}  // namespace stepwright::translate
