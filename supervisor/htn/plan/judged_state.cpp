#include "supervisor/htn/plan/judged_state.h"

#include <algorithm>

namespace stepwright::htn {
namespace {

std::string value_of(const ParsedTerm& term, const NamedBinding& binding) {
  if (!term.variable) return term.name;
  const auto found = binding.find(term.name);
  return found == binding.end() ? term.name : found->second;
}

std::string text_of(const ParsedCall& call, const NamedBinding& binding) {
  std::string text = call.name;
  for (const ParsedTerm& term : call.arguments) text += " " + value_of(term, binding);
  return text;
}

std::set<std::string> names_of(const TypedName& typed) {
  if (typed.either.empty()) return {typed.type_name};
  return {typed.either.begin(), typed.either.end()};
}

}  // namespace

JudgedState::JudgedState(const ParsedDomain& domain, const ParsedProblem& problem,
                         const std::set<std::string>& external)
    : external_(external) {
  for (const TypedName& type : domain.types)
    if (type.name != "object") parents_[type.name].merge(names_of(type));
  for (const auto* list : {&domain.constants, &problem.objects})
    for (const TypedName& object : *list) types_[object.name].merge(names_of(object));
  for (const ParsedCall& fact : problem.facts) facts_.insert(text_of(fact, {}));
  for (const ParsedValue& value : problem.values) values_[text_of(value.function, {})] = value.value;
}

bool JudgedState::is_a(const std::string& type, const std::string& wanted, std::set<std::string>& met) const {
  if (type == wanted || wanted == "object") return true;
  const auto above = parents_.find(type);
  if (above == parents_.end() || !met.insert(type).second) return false;
  return std::ranges::any_of(above->second, [&](const std::string& each) { return is_a(each, wanted, met); });
}

bool JudgedState::is_of(const std::string& object, const TypedName& type) const {
  const auto known = types_.find(object);
  if (known == types_.end()) return false;
  for (const std::string& own : known->second) {
    for (const std::string& wanted : names_of(type)) {
      std::set<std::string> met;
      if (is_a(own, wanted, met)) return true;
    }
  }
  return false;
}

std::vector<std::string> JudgedState::objects_of(const TypedName& type) const {
  std::vector<std::string> found;
  for (const auto& [object, types] : types_)
    if (is_of(object, type)) found.push_back(object);
  return found;
}

template <typename Visit>
void JudgedState::each(const std::vector<TypedName>& variables, const NamedBinding& binding,
                       const Visit& visit) const {
  std::vector<NamedBinding> all{binding};
  for (const TypedName& variable : variables) {
    std::vector<NamedBinding> longer;
    for (const NamedBinding& shorter : all) {
      for (const std::string& object : objects_of(variable)) {
        longer.push_back(shorter);
        longer.back()[variable.name] = object;
      }
    }
    all = std::move(longer);
  }
  for (const NamedBinding& one : all) visit(one);
}

// A literal that somebody else judges.
bool JudgedState::skipped(const ParsedFormula& formula) const {
  const ParsedFormula& atom =
      formula.kind == FormulaKind::Not && !formula.parts.empty() ? formula.parts[0] : formula;
  return atom.kind == FormulaKind::Atom && external_.contains(atom.call.name);
}

bool JudgedState::holds(const ParsedFormula& formula, const NamedBinding& binding) const {
  const auto here = [&](const ParsedFormula& part) { return skipped(part) || holds(part, binding); };
  switch (formula.kind) {
    case FormulaKind::Atom:
      return skipped(formula) || facts_.contains(text_of(formula.call, binding));
    case FormulaKind::Equal:
      return value_of(formula.call.arguments[0], binding) == value_of(formula.call.arguments[1], binding);
    case FormulaKind::And:
      return std::ranges::all_of(formula.parts, here);
    case FormulaKind::Or:
      return std::ranges::any_of(formula.parts,
                                 [&](const ParsedFormula& part) { return holds(part, binding); });
    case FormulaKind::Not:
      return skipped(formula) || !holds(formula.parts[0], binding);
    case FormulaKind::Imply:
      return !holds(formula.parts[0], binding) || holds(formula.parts[1], binding);
    case FormulaKind::Forall:
    case FormulaKind::Exists:
      break;
  }
  std::size_t true_for = 0, of = 0;
  each(formula.variables, binding, [&](const NamedBinding& one) {
    ++of;
    true_for += holds(formula.parts[0], one) ? 1 : 0;
  });
  return formula.kind == FormulaKind::Forall ? true_for == of : true_for > 0;
}

void JudgedState::collect(const ParsedEffect& effect, const NamedBinding& binding,
                          std::set<std::string>& added, std::set<std::string>& deleted) {
  switch (effect.kind) {
    case EffectKind::Add:
    case EffectKind::Delete:
      if (external_.contains(effect.call.name)) return;
      (effect.kind == EffectKind::Add ? added : deleted).insert(text_of(effect.call, binding));
      return;
    case EffectKind::Cost:
      cost_ += effect.amount.function.name.empty() ? effect.amount.number
                                                   : values_[text_of(effect.amount.function, binding)];
      return;
    case EffectKind::When:
      if (!holds(effect.condition[0], binding)) return;
      break;
    case EffectKind::Forall:
      each(effect.variables, binding,
           [&](const NamedBinding& one) { collect(effect.parts[0], one, added, deleted); });
      return;
    case EffectKind::And:
      break;
  }
  for (const ParsedEffect& part : effect.parts) collect(part, binding, added, deleted);
}

void JudgedState::apply(const ParsedAction& action, const NamedBinding& binding) {
  std::set<std::string> added, deleted;
  collect(action.effect, binding, added, deleted);
  for (const std::string& fact : deleted) facts_.erase(fact);
  facts_.insert(added.begin(), added.end());
}

}  // namespace stepwright::htn
