#include "supervisor/pddl/lifted/alternatives.h"

namespace stepwright::pddl {
namespace {

// More alternatives than this stay one condition.
constexpr std::size_t kMostAlternatives = 64;

using Alternatives = std::vector<Alternative>;

Alternatives product(const Formula& conjunction) {
  Alternatives all(1);
  for (const Formula& part : conjunction.parts) {
    Alternatives options = alternatives(part);
    if (all.size() * options.size() > kMostAlternatives) options = {{{}, {&part}}};
    Alternatives next;
    for (const Alternative& left : all) {
      for (const Alternative& right : options) {
        Alternative both = left;
        both.variables.insert(both.variables.end(), right.variables.begin(), right.variables.end());
        both.conjuncts.insert(both.conjuncts.end(), right.conjuncts.begin(), right.conjuncts.end());
        next.push_back(std::move(both));
      }
    }
    all = std::move(next);
  }
  return all;
}

void collect_slots(const std::vector<Term>& terms, std::set<int>& slots) {
  for (const Term& term : terms) {
    if (term.variable) slots.insert(term.index);
  }
}

void collect_slots(const Expression& expression, std::set<int>& slots) {
  collect_slots(expression.call.arguments, slots);
  for (const Expression& operand : expression.operands) collect_slots(operand, slots);
}

}  // namespace

std::vector<Alternative> alternatives(const Formula& formula) {
  if (formula.kind == FormulaKind::And) return product(formula);
  if (formula.kind == FormulaKind::Exists) {
    Alternatives inner = alternatives(formula.parts[0]);
    for (Alternative& option : inner) {
      option.variables.insert(option.variables.begin(), formula.variables.begin(), formula.variables.end());
    }
    return inner;
  }
  if (formula.kind != FormulaKind::Or) return {{{}, {&formula}}};
  Alternatives all;
  for (const Formula& part : formula.parts) {
    for (Alternative& option : alternatives(part)) all.push_back(std::move(option));
  }
  if (all.size() > kMostAlternatives) return {{{}, {&formula}}};
  return all;
}

void collect_slots(const Formula& formula, std::set<int>& slots) {
  collect_slots(formula.call.arguments, slots);
  collect_slots(formula.terms, slots);
  for (const Expression& side : formula.sides) collect_slots(side, slots);
  for (const Formula& part : formula.parts) collect_slots(part, slots);
}

}  // namespace stepwright::pddl
