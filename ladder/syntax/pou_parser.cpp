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

// PROGRAM name, FUNCTION_BLOCK name, FUNCTION name [: type]. What stands for another POU (MOCK) may name it
// with its namespace.
void Parser::pou_head(PouDeclaration& result, bool stands_for_another) {
  const Token& open = advance();
  internal_pou_ = accept_internal();
  if (open.is(Keyword::FunctionBlock)) {
    result.kind = PouKind::FunctionBlock;
  } else if (open.is(Keyword::Function)) {
    result.kind = PouKind::Function;
  }
  while (accept_modifier()) {
  }
  const char* const what = "the name of the POU";
  if (const auto name = stands_for_another ? full_name(what) : expect_name(what)) {
    result.name = *name;
    skip_inheritance();
  } else {
    skip_header_line();
  }
  if (result.kind == PouKind::Function) result.result = function_result();
  accept(TokenKind::Semicolon);
  using_directives(pou_used_);
}

// Variables and statements or a chart, up to the word that ends them.
void Parser::pou_body(PouDeclaration& result, std::optional<Keyword> end) {
  // "x : INT" is no statement: the word VAR is missing. In a generated text it is a label.
  const bool is_program = result.kind == PouKind::Program;
  while (at_variable_section() || at_object() || (is_program && at(Keyword::VarAccess)) ||
         (kind_ == TextKind::Written && (at_declaration() || at_unopened_section()))) {
    if (at_variable_section()) {
      variable_section(result.variables);
      continue;
    }
    if (at_object()) {
      skip_object();
      continue;
    }
    if (is_program && at(Keyword::VarAccess)) {
      access_section();
      continue;
    }
    unexpected("VAR before a declaration");
    while (!at_declaration() && !at(Keyword::EndVar) && !at(TokenKind::End)) advance();
    variable_lines({}, result.variables);
    accept(Keyword::EndVar);
  }
  const std::size_t errors = context_.sink.error_count();
  while (!(end && at_chart())) {
    Statements more = statements();
    for (auto& each : more) result.body.push_back(std::move(each));
    if (at(TokenKind::End) || at_pou_start()) break;
    if (!(end && at_chart())) stray_word(result);
  }
  if (end && at_chart()) {
    // What stands before a chart is a mistake.
    if (!result.body.empty() && context_.sink.error_count() == errors) unexpected("a statement");
    result.body.clear();
    result.chart = chart(*end);
  }
  result.end = peek().where;
}

// ": INT"; null if there is none. What stands in its place is taken for it.
TypeSpecPtr Parser::function_result() {
  const bool here = context_.sources.line(peek().where) == context_.sources.line(tokens_[at_ - 1].where);
  // A body may begin on the same line.
  const bool statement = at_statement_keyword() || at_bare_statement() || at(TokenKind::Direct) ||
                         (at(TokenKind::Identifier) &&
                          (peek(1).is(TokenKind::LeftParen) || peek(1).is(TokenKind::AttemptAssign)));
  const bool misspelt = here && kind_ == TextKind::Written && !at(TokenKind::Colon) &&
                        !at(TokenKind::Semicolon) && !at(TokenKind::End) && !at_variable_section() &&
                        !at_pou_start() && !at_chart() && !at_using() && !statement;
  if (misspelt) {
    unexpected("':' and the type of the result");
    skip_header_line();
    reported_at_ = at_;
    return std::make_unique<TypeSpec>();
  }
  if (!accept(TokenKind::Colon)) return nullptr;
  TypeSpecPtr result = type();
  if (result->kind == TypeKind::Error) skip_header_line();
  return result;
}

// What is left of the line that names a POU.
void Parser::skip_header_line() {
  const auto line = [&](std::size_t token) { return context_.sources.line(tokens_[token].where); };
  while (!at(TokenKind::Semicolon) && !at(TokenKind::End) && !at_variable_section() && !at_pou_start() &&
         line(at_) == line(at_ - 1))
    advance();
}

// An END_VAR without its VAR comes next.
bool Parser::at_unopened_section() const {
  for (std::size_t i = 0;; ++i) {
    const Token& token = peek(i);
    if (token.is(Keyword::EndVar)) return true;
    if (token.is(TokenKind::End) || begins_section(token) || begins_or_ends_pou(token)) return false;
  }
}

// An END_IF too many, a VAR between statements: one report, then on with the body.
void Parser::stray_word(PouDeclaration& pou) {
  if (at_object()) return skip_object();
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
