#include "ladder/syntax/expression_text.h"

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax {

namespace internal {

ExpressionPtr Parser::whole_expression() {
  ExpressionPtr value = expression();
  if (!at(TokenKind::End)) unexpected(describe(TokenKind::End));
  return value;
}

}  // namespace internal

ExpressionPtr parse_expression(SyntaxContext& context, source::FileId file, TextKind kind) {
  const std::size_t errors = context.sink.error_count();
  const auto tokens = lex(context.sources, file, kind, context.names, context.sink);
  ExpressionPtr value = internal::Parser(context, tokens, kind).whole_expression();
  return context.sink.error_count() == errors ? std::move(value) : nullptr;
}

}  // namespace stepwright::syntax
