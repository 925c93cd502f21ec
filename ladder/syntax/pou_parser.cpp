// Program organisation units (IEC 61131-3, 6.6).

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

PouDeclaration Parser::pou() {
  PouDeclaration result;
  const Token& open = peek();
  pou_head(result);
  const Keyword end = result.kind == PouKind::FunctionBlock ? Keyword::EndFunctionBlock
                      : result.kind == PouKind::Function    ? Keyword::EndFunction
                                                            : Keyword::EndProgram;
  pou_body(result, end);
  expect_end(end, open);
  accept(TokenKind::Semicolon);
  return result;
}

// PROGRAM name, FUNCTION_BLOCK name, FUNCTION name [: type]
void Parser::pou_head(PouDeclaration& result) {
  const Token& open = advance();
  if (open.is(Keyword::FunctionBlock)) {
    result.kind = PouKind::FunctionBlock;
  } else if (open.is(Keyword::Function)) {
    result.kind = PouKind::Function;
  }
  if (const auto name = expect_name("the name of the POU")) result.name = *name;
  if (result.kind == PouKind::Function) {
    if (accept(TokenKind::Colon)) result.result = type();
  }
  accept(TokenKind::Semicolon);
}

// Variables and statements or a chart, up to the word that ends them.
void Parser::pou_body(PouDeclaration& result, std::optional<Keyword> end) {
  while (at_variable_section()) variable_section(result.variables);
  if (end && at_chart()) {
    result.chart = chart(*end);
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
}

}  // namespace stepwright::syntax::internal
