#include "supervisor/htn/syntax/formula_parser.h"

namespace stepwright::htn {

using lisp::TokenKind;

bool FormulaParser::parameters(std::vector<TypedName>& list) {
  return tokens_.expect(TokenKind::Open, "'(' and variables") &&
         lisp::read_typed_list(tokens_, TokenKind::Variable, list) && close();
}

bool FormulaParser::declaration(ParsedSymbol& symbol) {
  return tokens_.expect(TokenKind::Open, "'('") && tokens_.expect_name("a name", symbol.name, symbol.at) &&
         lisp::read_typed_list(tokens_, TokenKind::Variable, symbol.parameters) && close();
}

bool FormulaParser::term(ParsedTerm& term) {
  term.variable = tokens_.at(TokenKind::Variable);
  if (!term.variable && !tokens_.at(TokenKind::Name)) return tokens_.unexpected("a variable or an object");
  term.at = tokens_.peek().at;
  term.name = tokens_.take().text;
  return true;
}

bool FormulaParser::arguments(ParsedCall& call) {
  while (!tokens_.at(TokenKind::Close)) {
    call.arguments.emplace_back();
    if (!term(call.arguments.back())) return false;
  }
  return close();
}

bool FormulaParser::call(ParsedCall& call) {
  return tokens_.expect(TokenKind::Open, "'('") && tokens_.expect_name("a name", call.name, call.at) &&
         arguments(call);
}

bool FormulaParser::equality(ParsedFormula& formula) {
  formula.kind = FormulaKind::Equal;
  formula.call.name = tokens_.take().text;
  formula.call.at = formula.at;
  formula.call.arguments.resize(2);
  return term(formula.call.arguments[0]) && term(formula.call.arguments[1]) && close();
}

bool FormulaParser::connective(ParsedFormula& formula, FormulaKind kind) {
  formula.kind = kind;
  while (!tokens_.at(TokenKind::Close)) {
    formula.parts.emplace_back();
    if (!this->formula(formula.parts.back())) return false;
  }
  const bool list = kind == FormulaKind::And || kind == FormulaKind::Or;
  const std::size_t wanted = kind == FormulaKind::Imply ? 2 : 1;
  if (!list && formula.parts.size() != wanted) {
    tokens_.reporter().error("P0106", formula.at,
                             "expected " + std::to_string(wanted) + " condition(s) here, found " +
                                 std::to_string(formula.parts.size()));
    return false;
  }
  return close();
}

// Over no variables, both quantifiers say what stands in them.
bool FormulaParser::quantified(ParsedFormula& formula, FormulaKind kind) {
  if (!parameters(formula.variables) || !connective(formula, kind)) return false;
  if (formula.variables.empty()) formula.kind = FormulaKind::And;
  return true;
}

bool FormulaParser::formula(ParsedFormula& formula) {
  if (tokens_.too_deep()) return false;
  formula.at = tokens_.peek().at;
  if (!tokens_.expect(TokenKind::Open, "a condition in parentheses")) return false;
  if (tokens_.accept(TokenKind::Close)) return true;
  if (tokens_.at(TokenKind::Operator, "=")) return equality(formula);
  std::string head;
  Place at;
  if (!tokens_.expect_name("a predicate, '=' or a connective", head, at)) return false;
  if (head == "and") return connective(formula, FormulaKind::And);
  if (head == "or") return connective(formula, FormulaKind::Or);
  if (head == "not") return connective(formula, FormulaKind::Not);
  if (head == "imply") return connective(formula, FormulaKind::Imply);
  if (head == "forall") return quantified(formula, FormulaKind::Forall);
  if (head == "exists") return quantified(formula, FormulaKind::Exists);
  if (head == "preference") {
    tokens_.reporter().error("P0008", at, "preferences are not supported");
    return false;
  }
  formula.kind = FormulaKind::Atom;
  formula.call.name = head;
  formula.call.at = at;
  return arguments(formula.call);
}

}  // namespace stepwright::htn
