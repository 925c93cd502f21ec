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
  while (at_variable_section()) variable_section(result.variables);
  if (at_chart()) {
    result.chart = chart(end);
  } else {
    while (true) {
      Statements more = statements();
      for (auto& each : more) result.body.push_back(std::move(each));
      if (at(TokenKind::End) || at_pou_start()) break;
      // An END_IF too many, a VAR between statements: one report, then on with the body.
      unexpected("a statement");
      if (at_variable_section()) {
        variable_section(result.variables);
      } else {
        advance();
        accept(TokenKind::Semicolon);
      }
    }
  }
  result.end = peek().where;
  expect_end(end, open);
  accept(TokenKind::Semicolon);
  return result;
}

}  // namespace stepwright::syntax::internal
