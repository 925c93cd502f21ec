// Program organisation units (IEC 61131-3, 6.6).

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

PouDeclaration Parser::pou() {
  PouDeclaration result;
  const Token& open = advance();
  Keyword end = Keyword::EndProgram;
  if (open.is(Keyword::FunctionBlock)) {
    result.kind = PouKind::FunctionBlock;
    end = Keyword::EndFunctionBlock;
  } else if (open.is(Keyword::Function)) {
    result.kind = PouKind::Function;
    end = Keyword::EndFunction;
  }
  if (const auto name = expect_name("the name of the POU")) result.name = *name;
  if (result.kind == PouKind::Function) {
    if (accept(TokenKind::Colon)) result.result = type();
  }
  accept(TokenKind::Semicolon);
  while (at_variable_section() || at_bare_declaration()) {
    if (at_variable_section()) {
      variable_section(result.variables);
      continue;
    }
    unexpected("VAR before a declaration");
    variable_lines({}, result.variables);
    accept(Keyword::EndVar);
  }
  if (at_chart()) {
    result.chart = chart(end);
  } else {
    while (true) {
      Statements more = statements();
      for (auto& each : more) result.body.push_back(std::move(each));
      if (at(TokenKind::End) || at_pou_start()) break;
      stray_word(result);
    }
  }
  result.end = peek().where;
  expect_end(end, open);
  accept(TokenKind::Semicolon);
  return result;
}

// An END_IF too many, a VAR between statements: one report, then on with the body.
void Parser::stray_word(PouDeclaration& pou) {
  unexpected("a statement");
  if (at_variable_section()) return variable_section(pou.variables);
  // An IF that was not read has left its ELSE and its END_IF behind.
  const bool of_if = at(Keyword::Elsif) || at(Keyword::Else);
  const Keyword end = of_if ? Keyword::EndIf : at(Keyword::Until) ? Keyword::EndRepeat : Keyword::None;
  advance();
  while (end != Keyword::None && !at(TokenKind::End) && !at_pou_start() && !accept(end)) advance();
  accept(TokenKind::Semicolon);
}

}  // namespace stepwright::syntax::internal
