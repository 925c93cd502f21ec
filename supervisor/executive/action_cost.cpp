#include "supervisor/executive/action_cost.h"

#include <optional>

#include "supervisor/pddl/action/ground_action.h"
#include "supervisor/pddl/plan/describe_run.h"
#include "supervisor/pddl/plan/simulate.h"

namespace stepwright::executive {
namespace {

std::optional<double> value_of(const pddl::NumericNode& node, const pddl::State& state) {
  using pddl::NumericKind;
  if (node.kind == NumericKind::Constant) return node.constant;
  if (node.kind == NumericKind::Fluent) return state.value(node.fluent);
  const auto left = value_of(node.operands.front(), state);
  if (!left) return std::nullopt;
  if (node.kind == NumericKind::Negate) return -*left;
  const auto right = value_of(node.operands.back(), state);
  if (!right) return std::nullopt;
  switch (node.kind) {
    case NumericKind::Add:
      return *left + *right;
    case NumericKind::Subtract:
      return *left - *right;
    case NumericKind::Multiply:
      return *left * *right;
    case NumericKind::Divide:
      return *right == 0.0 ? std::nullopt : std::optional<double>(*left / *right);
    default:
      return std::nullopt;
  }
}

// False if a value is unknown. Conditional changes are left out: their conditions are exact, measured states
// are not.
bool apply_numeric(const pddl::Change& change, const pddl::State& before, pddl::State& after) {
  using pddl::ChangeKind;
  if (change.kind == ChangeKind::Add || change.kind == ChangeKind::Delete || !change.when.empty())
    return true;
  const auto amount = value_of(change.amount, before);
  const auto old = before.value(change.target);
  if (!amount || (!old && change.kind != ChangeKind::Assign)) return false;
  switch (change.kind) {
    case ChangeKind::Assign:
      after.assign(change.target, *amount);
      break;
    case ChangeKind::Increase:
      after.assign(change.target, *old + *amount);
      break;
    case ChangeKind::Decrease:
      after.assign(change.target, *old - *amount);
      break;
    case ChangeKind::ScaleUp:
      after.assign(change.target, *old * *amount);
      break;
    case ChangeKind::ScaleDown:
      after.assign(change.target, *amount == 0.0 ? *old : *old / *amount);
      break;
    default:
      break;
  }
  return true;
}

std::optional<double> quantity(const pddl::Task& task, const std::string& fluent, const pddl::State& state,
                               std::size_t steps) {
  if (!fluent.empty()) return state.value(fluent);
  auto metric = pddl::evaluate_metric(task, state, steps);
  return metric ? std::optional<double>(*metric) : std::nullopt;
}

}  // namespace

double action_cost(const pddl::Task& task, const std::string& fluent, const model::GroundAction& action,
                   const model::NamedState& before) {
  const auto info = pddl::inspect_action(task, action);
  if (!info) return 0.0;
  const pddl::State start = pddl::from_named(before);
  pddl::State end = start;
  for (const pddl::Change& change : info->changes) {
    if (!apply_numeric(change, start, end)) return 0.0;
  }
  const auto from = quantity(task, fluent, start, 0);
  const auto to = quantity(task, fluent, end, 1);
  return from && to ? *to - *from : 0.0;
}

}  // namespace stepwright::executive
