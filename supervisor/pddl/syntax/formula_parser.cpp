#include "supervisor/pddl/syntax/formula_parser.h"

#include <optional>

#include "supervisor/lisp/typed_list.h"

namespace stepwright::pddl {
namespace {

std::optional<Relation> relation_of(const std::string& symbol) {
  if (symbol == "<") return Relation::Less;
  if (symbol == "<=") return Relation::LessEqual;
  if (symbol == "=") return Relation::Equal;
  if (symbol == ">") return Relation::Greater;
  if (symbol == ">=") return Relation::GreaterEqual;
  return std::nullopt;
}

}  // namespace

bool FormulaParser::typed_list(TokenKind kind, std::vector<Typed>& list) {
  return lisp::read_typed_list(tokens_, kind, list);
}

bool FormulaParser::declaration(Symbol& symbol) {
  return tokens_.expect(TokenKind::Open, "'('") && tokens_.expect_name("a name", symbol.name, symbol.at) &&
         typed_list(TokenKind::Variable, symbol.parameters) && close();
}

bool FormulaParser::term(Term& term) {
  term.variable = tokens_.at(TokenKind::Variable);
  if (!term.variable && !tokens_.at(TokenKind::Name)) return tokens_.unexpected("a variable or an object");
  term.at = tokens_.peek().at;
  term.name = tokens_.take().text;
  return true;
}

bool FormulaParser::arguments(Call& call) {
  while (!tokens_.at(TokenKind::Close)) {
    call.arguments.emplace_back();
    if (!term(call.arguments.back())) return false;
  }
  return close();
}

bool FormulaParser::call(Call& call) {
  return tokens_.expect(TokenKind::Open, "'('") && tokens_.expect_name("a name", call.name, call.at) &&
         arguments(call);
}

bool FormulaParser::expression(Expression& expression) {
  if (tokens_.too_deep()) return false;
  expression.at = tokens_.peek().at;
  if (tokens_.at(TokenKind::Number)) {
    expression.number = tokens_.take().number;
    return true;
  }
  expression.kind = NumericKind::Fluent;
  if (tokens_.at(
          TokenKind::Name)) {  // A function without arguments may stand without parentheses in a metric.
    expression.call.at = tokens_.peek().at;
    expression.call.name = tokens_.take().text;
    return true;
  }
  if (!tokens_.expect(TokenKind::Open, "a number or '('")) return false;
  if (tokens_.at(TokenKind::Operator)) return operation(expression, tokens_.take().text);
  return tokens_.expect_name("a function or an arithmetic operator", expression.call.name,
                             expression.call.at) &&
         arguments(expression.call);
}

bool FormulaParser::operation(Expression& expression, const std::string& symbol) {
  if (symbol == "+") {
    expression.kind = NumericKind::Add;
  } else if (symbol == "-") {
    expression.kind = NumericKind::Subtract;
  } else if (symbol == "*") {
    expression.kind = NumericKind::Multiply;
  } else if (symbol == "/") {
    expression.kind = NumericKind::Divide;
  } else {
    tokens_.reporter().error("P0003", expression.at, "'" + symbol + "' is not an arithmetic operator");
    return false;
  }
  while (!tokens_.at(TokenKind::Close)) {
    expression.operands.emplace_back();
    if (!this->expression(expression.operands.back())) return false;
  }
  const std::size_t count = expression.operands.size();
  const bool sum = symbol == "+" || symbol == "*";
  if (count == 1 && symbol == "-") {
    expression.kind = NumericKind::Negate;
  } else if (count < 2 || (count > 2 && !sum)) {
    tokens_.reporter().error("P0106", expression.at,
                             "'" + symbol + "' takes two operands, not " + std::to_string(count));
    return false;
  }
  return close();
}

bool FormulaParser::compare(Formula& formula) {
  const auto relation = relation_of(tokens_.peek().text);
  if (!relation) return tokens_.unexpected("a predicate, a comparison or a connective");
  tokens_.take();
  formula.kind = FormulaKind::Compare;
  formula.relation = *relation;
  formula.sides.resize(2);
  return expression(formula.sides[0]) && expression(formula.sides[1]) && close();
}

bool FormulaParser::equality(Formula& formula) {
  const TokenKind next = tokens_.peek(1).kind;
  if (next != TokenKind::Variable && next != TokenKind::Name) return compare(formula);
  tokens_.take();
  formula.kind = FormulaKind::SameObject;
  formula.terms.resize(2);
  return term(formula.terms[0]) && term(formula.terms[1]) && close();
}

bool FormulaParser::quantifier(std::vector<Typed>& variables) {
  return tokens_.expect(TokenKind::Open, "'(' and the quantified variables") &&
         typed_list(TokenKind::Variable, variables) && close();
}

bool FormulaParser::connective(Formula& formula, FormulaKind kind) {
  formula.kind = kind;
  while (!tokens_.at(TokenKind::Close)) {
    formula.parts.emplace_back();
    if (!this->formula(formula.parts.back())) return false;
  }
  const std::size_t wanted = kind == FormulaKind::Imply                            ? 2
                             : kind == FormulaKind::And || kind == FormulaKind::Or ? 0
                                                                                   : 1;
  if (wanted != 0 && formula.parts.size() != wanted) {
    tokens_.reporter().error("P0106", formula.at,
                             "expected " + std::to_string(wanted) + " condition" + (wanted > 1 ? "s" : "") +
                                 " here, found " + std::to_string(formula.parts.size()));
    return false;
  }
  return close();
}

// Over no variables, both quantifiers say what stands in them.
bool FormulaParser::quantified(Formula& formula, FormulaKind kind) {
  if (!quantifier(formula.variables) || !connective(formula, kind)) return false;
  if (formula.variables.empty()) formula.kind = FormulaKind::And;
  return true;
}

bool FormulaParser::formula(Formula& formula) {
  if (tokens_.too_deep()) return false;
  formula.at = tokens_.peek().at;
  if (!tokens_.expect(TokenKind::Open, "a condition in parentheses")) return false;
  if (tokens_.accept(TokenKind::Close)) return true;
  if (tokens_.at(TokenKind::Operator, "=")) return equality(formula);
  if (tokens_.at(TokenKind::Operator)) return compare(formula);
  std::string head;
  Place at;
  if (!tokens_.expect_name("a predicate, a comparison or a connective", head, at)) return false;
  if (head == "and") return connective(formula, FormulaKind::And);
  if (head == "or") return connective(formula, FormulaKind::Or);
  if (head == "not") return connective(formula, FormulaKind::Not);
  if (head == "imply") return connective(formula, FormulaKind::Imply);
  if (head == "forall" || head == "exists") {
    return quantified(formula, head == "forall" ? FormulaKind::Forall : FormulaKind::Exists);
  }
  if (head == "preference") {
    tokens_.reporter().error("P0008", at, "preferences are not supported");
    return false;
  }
  formula.kind = FormulaKind::Atom;
  formula.call.name = head;
  formula.call.at = at;
  return arguments(formula.call);
}

}  // namespace stepwright::pddl
