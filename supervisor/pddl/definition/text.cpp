#include "supervisor/pddl/definition/text.h"

#include "supervisor/pddl/definition/state.h"

namespace stepwright::pddl {
namespace {

std::string print(const Definition& definition, const Term& term, const Binding& binding) {
  if (!term.variable) return term.name;
  const auto slot = static_cast<std::size_t>(term.index);
  if (slot >= binding.size() || binding[slot] < 0) return term.name;
  return definition.objects[static_cast<std::size_t>(binding[slot])].name;
}

std::string print(const Definition& definition, const Call& call, const Binding& binding) {
  std::string text = "(" + call.name;
  for (const Term& term : call.arguments) text += " " + print(definition, term, binding);
  return text + ")";
}

const char* word_of(FormulaKind kind) {
  switch (kind) {
    case FormulaKind::Or:
      return "or";
    case FormulaKind::Not:
      return "not";
    case FormulaKind::Imply:
      return "imply";
    case FormulaKind::Forall:
      return "forall";
    case FormulaKind::Exists:
      return "exists";
    default:
      return "and";
  }
}

}  // namespace

const char* symbol_of(NumericKind kind) {
  switch (kind) {
    case NumericKind::Add:
      return "+";
    case NumericKind::Multiply:
      return "*";
    case NumericKind::Divide:
      return "/";
    default:
      return "-";
  }
}

const char* symbol_of(Relation relation) {
  switch (relation) {
    case Relation::Less:
      return "<";
    case Relation::LessEqual:
      return "<=";
    case Relation::Equal:
      return "=";
    case Relation::GreaterEqual:
      return ">=";
    case Relation::Greater:
      return ">";
  }
  return "=";
}

std::string print(const Definition& definition, const Expression& expression, const Binding& binding) {
  if (expression.kind == NumericKind::Constant) return number_text(expression.number);
  if (expression.kind == NumericKind::Fluent) return print(definition, expression.call, binding);
  std::string text = std::string("(") + symbol_of(expression.kind);
  for (const Expression& operand : expression.operands) text += " " + print(definition, operand, binding);
  return text + ")";
}

std::string print(const Definition& definition, const Formula& formula, const Binding& binding) {
  std::string text;
  switch (formula.kind) {
    case FormulaKind::Atom:
      return print(definition, formula.call, binding);
    case FormulaKind::SameObject:
      return "(= " + print(definition, formula.terms[0], binding) + " " +
             print(definition, formula.terms[1], binding) + ")";
    case FormulaKind::Compare:
      return std::string("(") + symbol_of(formula.relation) + " " +
             print(definition, formula.sides[0], binding) + " " +
             print(definition, formula.sides[1], binding) + ")";
    default:
      break;
  }
  text = std::string("(") + word_of(formula.kind);
  if (!formula.variables.empty()) {
    text += " (";
    for (const Typed& variable : formula.variables) {
      text += (text.back() == '(' ? "" : " ") + variable.name + " - " + variable.type_name;
    }
    text += ")";
  }
  for (const Formula& part : formula.parts) text += " " + print(definition, part, binding);
  return text + ")";
}

}  // namespace stepwright::pddl
