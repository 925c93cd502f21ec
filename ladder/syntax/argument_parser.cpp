// Arguments of calls, and the lists of first values (IEC 61131-3, 6.5.1.3 and 6.6.1.7).

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

// False if the list does not end as one: how many arguments were meant is not known.
bool Parser::arguments(std::vector<Argument>& list) {
  advance();  // '('
  if (accept(TokenKind::RightParen)) return true;
  do list.push_back(argument());
  while (accept(TokenKind::Comma));
  return expect(TokenKind::RightParen, "to close the argument list");
}

Argument Parser::argument() {
  Argument result;
  const std::size_t name_at = at(Keyword::Not) ? 1 : 0;
  const Token& after = peek(name_at + 1);
  const bool formal = peek(name_at).is(TokenKind::Identifier) &&
                      (after.is(TokenKind::Output) || (name_at == 0 && after.is(TokenKind::Assign)));
  if (formal) {
    result.negated = accept(Keyword::Not);
    const Token& token = advance();
    result.formal = Name{token.name, token.text, token.where};
    result.is_output = advance().is(TokenKind::Output);
    // "Q =>" alone: the output is not wanted.
    if (result.is_output && (at(TokenKind::Comma) || at(TokenKind::RightParen))) return result;
  }
  const std::uint32_t begin = peek().where.offset;
  result.value = expression();
  if (closing_ != nullptr)
    result.text = context_.sources.text(peek().where.file).substr(begin, after_previous().offset - begin);
  return result;
}

ExpressionPtr Parser::initial_value() {
  const Nesting nesting(*this);
  if (too_deep()) return error_node();
  if (at(TokenKind::LeftBracket)) return array_values();
  const bool names_field = peek(1).is(TokenKind::Identifier) && peek(2).is(TokenKind::Assign);
  if (at(TokenKind::LeftParen) && names_field) return struct_values();
  return expression();
}

ExpressionPtr Parser::array_values() {
  auto node = make(ExpressionKind::ArrayValues);
  advance();
  do {
    if (at(TokenKind::RightBracket)) break;
    if (at(TokenKind::Integer) && peek(1).is(TokenKind::LeftParen)) {
      auto repeat = make(ExpressionKind::Repeat);
      adopt(*repeat, literal());
      advance();
      if (!at(TokenKind::RightParen)) adopt(*repeat, initial_value());
      expect(TokenKind::RightParen, "to close the repeated value");
      adopt(*node, std::move(repeat));
    } else {
      adopt(*node, initial_value());
    }
  } while (accept(TokenKind::Comma));
  expect(TokenKind::RightBracket, "to close the list of values");
  return node;
}

ExpressionPtr Parser::struct_values() {
  auto node = make(ExpressionKind::StructValues);
  advance();
  do {
    const auto name = expect_name("the name of a member");
    if (!name || !expect(TokenKind::Assign, "behind the name of the member")) break;
    Argument value;
    value.formal = *name;
    value.value = initial_value();
    node->arguments.push_back(std::move(value));
  } while (accept(TokenKind::Comma));
  expect(TokenKind::RightParen, "to close the list of values");
  return node;
}

}  // namespace stepwright::syntax::internal
