#include "ladder/syntax/parser.h"

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax {

namespace internal {

void Parser::unit(Unit& out) {
  scope_ = &out.scopes.emplace_back();
  bool lost = false;  // in what belongs to a mistake that was reported
  while (!at(TokenKind::End)) {
    lost = lost && !at_declaration_of_unit();
    if (at_object()) {
      skip_object();
      continue;
    }
    if (at_using()) {
      using_directives(scope_->used);
    } else if (at_namespace()) {
      namespace_block(out);
    } else if (!at_declaration_of_unit() && !at(Keyword::VarGlobal)) {
      if (accept(TokenKind::Semicolon)) continue;
      if (!lost)
        unexpected("PROGRAM, FUNCTION_BLOCK, FUNCTION, TYPE, VAR_GLOBAL, NAMESPACE or CONFIGURATION");
      lost = true;
      // Everything up to the next declaration belongs to the same mistake.
      do advance();
      while (!at(TokenKind::End) && !at(Keyword::VarGlobal) && !at_declaration_of_unit() && !at_object());
    } else if (at_test()) {
      test(out.tests);
      out.tests.back().body.scope = scope_;
    } else if (at_mock()) {
      mock(out);
    } else if (at(Keyword::Type)) {
      types_of_unit(out);
    } else if (at(Keyword::Configuration)) {
      out.configurations.push_back(configuration());
      out.configurations.back().scope = scope_;
    } else if (at(Keyword::VarGlobal)) {
      globals_of_unit(out);
    } else {
      pou_of_unit(out);
    }
  }
}

// "PROGRAM one WITH fast : main;" and "PROGRAM one : main;" are parts of a configuration.
bool Parser::at_declaration_of_unit() const {
  const bool instance = peek(1).is(Keyword::Retain) || peek(1).is(Keyword::NonRetain) ||
                        peek(2).is(Keyword::With) || peek(2).is(TokenKind::Colon);
  return (at(Keyword::Program) && !instance) || at(Keyword::FunctionBlock) || at(Keyword::Function) ||
         at(Keyword::Type) || at(Keyword::Configuration) || at_test() || at_mock() || at_namespace();
}

Statements Parser::whole_statements() {
  Statements list;
  while (!at(TokenKind::End)) {
    Statements more = statements();
    for (auto& each : more) list.push_back(std::move(each));
    if (at(TokenKind::End)) break;
    unexpected("a statement");
    advance();
  }
  return list;
}

PieceResult Parser::piece(PieceKind kind) {
  PieceResult result;
  const std::size_t errors = context_.sink.error_count();
  const bool names = kind == PieceKind::Word || kind == PieceKind::PouName;
  if (kind == PieceKind::StatementList) {
    open_end_ = true;
    jumps_ = false;
    result.statements = whole_statements();
  } else if (at(TokenKind::End)) {
    context_.sink.error(source::code::kUnexpectedToken, peek().where,
                        names                         ? "a name is missing"
                        : kind == PieceKind::Variable ? "a variable is missing"
                                                      : "a variable or expression is missing");
  } else if (names) {
    if (!at(TokenKind::Keyword)) kind == PieceKind::Word ? expect_name("a name") : full_name("a name");
    accept(TokenKind::Keyword);
    result.is_operand = true;
  } else if (kind == PieceKind::Variable && !at(TokenKind::Identifier) && !at(TokenKind::Direct)) {
    unexpected("a variable");
  } else {
    const source::Position where = peek().where;
    const ExpressionPtr value = kind == PieceKind::Variable ? primary() : expression();
    if (kind == PieceKind::Variable && value->kind == ExpressionKind::Call)
      context_.sink.error(source::code::kUnexpectedToken, where, "expected a variable, found a call");
    result.is_operand = value->kind != ExpressionKind::Unary && value->kind != ExpressionKind::Binary;
  }
  if (!at(TokenKind::End)) unexpected(describe(TokenKind::End));
  result.is_whole = context_.sink.error_count() == errors;
  return result;
}

std::vector<VariableDeclaration> Parser::whole_variables() {
  std::vector<VariableDeclaration> list;
  while (!at(TokenKind::End)) {
    if (at_variable_section()) {
      variable_section(list);
    } else {
      unexpected("a declaration");
      advance();
    }
  }
  return list;
}

}  // namespace internal

void parse_unit(SyntaxContext& context, source::FileId file, Unit& unit, TextKind kind, Extent extent) {
  const auto tokens = lex(context.sources, file, kind, context.names, context.sink, extent);
  internal::Parser(context, tokens, kind).unit(unit);
}

Statements parse_statements(SyntaxContext& context, source::FileId file, TextKind kind) {
  const auto tokens = lex(context.sources, file, kind, context.names, context.sink);
  return internal::Parser(context, tokens, kind).whole_statements();
}

PieceResult parse_piece(SyntaxContext& context, source::FileId file, PieceKind piece, TextKind kind) {
  const std::size_t errors = context.sink.error_count();
  const auto tokens = lex(context.sources, file, kind, context.names, context.sink);
  PieceResult result = internal::Parser(context, tokens, kind).piece(piece);
  result.is_whole = context.sink.error_count() == errors;
  return result;
}

std::vector<VariableDeclaration> parse_variables(SyntaxContext& context, source::FileId file, TextKind kind) {
  const auto tokens = lex(context.sources, file, kind, context.names, context.sink);
  return internal::Parser(context, tokens, kind).whole_variables();
}

}  // namespace stepwright::syntax
