#include "supervisor/htn/search/evaluate.h"

#include <algorithm>
#include <array>

namespace stepwright::htn {
namespace {

bool atom_holds(const Condition& atom, const std::vector<int>& binding, const State& state) {
  constexpr std::size_t kFew = 8;
  std::array<int, kFew> few{};
  std::vector<int> many;
  const std::size_t count = atom.terms.size();
  if (count > kFew) many.resize(count);
  int* objects = count > kFew ? many.data() : few.data();
  for (std::size_t i = 0; i < count; ++i) objects[i] = object_of(atom.terms[i], binding);
  return state.holds(atom.symbol, {objects, count});
}

bool quantified(const Condition& condition, std::size_t from, std::vector<int>& binding,
                const Evaluation& in) {
  const bool forall = condition.kind == ConditionKind::Forall;
  if (from == condition.variables.size()) return holds(condition.parts[0], binding, in);
  const Variable& variable = condition.variables[from];
  for (const int object : in.task.types[static_cast<std::size_t>(variable.type)].objects) {
    if (in.interrupt.poll()) return false;
    binding[static_cast<std::size_t>(variable.slot)] = object;
    if (quantified(condition, from + 1, binding, in) != forall) return !forall;
  }
  return forall;
}

}  // namespace

bool holds(const Condition& condition, std::vector<int>& binding, const Evaluation& in) {
  const auto here = [&](const Condition& part) { return holds(part, binding, in); };
  switch (condition.kind) {
    case ConditionKind::Atom:
      return atom_holds(condition, binding, in.state);
    case ConditionKind::Equal:
      return object_of(condition.terms[0], binding) == object_of(condition.terms[1], binding);
    case ConditionKind::OfType:
      return in.task.is_of_type(object_of(condition.terms[0], binding), condition.symbol);
    case ConditionKind::And:
      return std::ranges::all_of(condition.parts, here);
    case ConditionKind::Or:
      return std::ranges::any_of(condition.parts, here);
    case ConditionKind::Not:
      return !here(condition.parts[0]);
    case ConditionKind::Imply:
      return !here(condition.parts[0]) || here(condition.parts[1]);
    case ConditionKind::Forall:
    case ConditionKind::Exists:
      return quantified(condition, 0, binding, in);
  }
  return false;
}

}  // namespace stepwright::htn
