// Literals (IEC 61131-3, 6.3).

#include "ladder/syntax/internal/parser.h"
#include "runtime/ground/naming/text_literal.h"

namespace stepwright::syntax::internal {

namespace {

ExpressionKind time_kind(TokenKind kind) {
  switch (kind) {
    case TokenKind::Date:
      return ExpressionKind::Date;
    case TokenKind::TimeOfDay:
      return ExpressionKind::TimeOfDay;
    case TokenKind::DateAndTime:
      return ExpressionKind::DateAndTime;
    default:
      return ExpressionKind::Time;
  }
}

}  // namespace

ExpressionPtr Parser::literal() {
  auto node = make(ExpressionKind::Integer);
  const Token& token = peek();
  switch (token.kind) {
    case TokenKind::Integer:
      node->integer = token.integer;
      node->based = token.based;
      break;
    case TokenKind::Real:
      node->kind = ExpressionKind::Real;
      node->real = token.real;
      break;
    case TokenKind::Time:
    case TokenKind::Date:
    case TokenKind::TimeOfDay:
    case TokenKind::DateAndTime:
      node->kind = time_kind(token.kind);
      node->time_ns = token.time_ns;
      break;
    case TokenKind::String:
    case TokenKind::WideString:
      return text_literal();
    default:
      if (at(Keyword::True) || at(Keyword::False)) {
        node->kind = ExpressionKind::Boolean;
        node->integer = at(Keyword::True) ? 1 : 0;
      } else if (at(Keyword::Null)) {
        node->kind = ExpressionKind::Null;
      } else {
        unexpected("an expression", at(TokenKind::Keyword)
                                        ? "'" + std::string(token.text) + "' is a reserved word"
                                        : std::string());
        return error_node();
      }
  }
  advance();
  return node;
}

// 'single' or "double"
ExpressionPtr Parser::text_literal() {
  const bool wide = at(TokenKind::WideString);
  auto node = make(wide ? ExpressionKind::WideString : ExpressionKind::String);
  const Token& token = advance();
  const std::string_view inside = token.text.substr(1, token.text.size() - 2);
  naming::TextMistake mistake;
  auto characters =
      naming::parse_text(inside, wide ? naming::TextWidth::Double : naming::TextWidth::Single, mistake);
  if (!characters) {
    const source::Position where{token.where.file,
                                 token.where.offset + 1 + static_cast<std::uint32_t>(mistake.offset)};
    context_.sink.error(source::code::kBadLiteral, where, mistake.message,
                        wide ? "write $$, $\", $L, $N, $P, $R, $T or $hhhh with four hexadecimal digits"
                             : "write $$, $', $L, $N, $P, $R, $T or $hh with two hexadecimal digits; "
                               "characters beyond 255 need \"...\"");
    return error_node();
  }
  node->characters = std::move(*characters);
  return node;
}

// "Plant.Color#Red": a type with its namespace.
bool Parser::at_full_prefix() const {
  for (std::size_t i = 0; peek(i).is(TokenKind::Identifier) && peek(i + 1).is(TokenKind::Dot); i += 2)
    if (peek(i + 2).is(TokenKind::TypePrefix)) return true;
  return false;
}

Name Parser::literal_prefix() {
  const Token& first = peek();
  if (!first.is(TokenKind::TypePrefix)) {
    const auto name = full_name("a type");
    return name ? *name : Name{first.name, first.text, first.where};
  }
  advance();
  return {first.name, first.text, first.where};
}

// "INT#-5", "BOOL#TRUE", "WORD#16#FF", "STRING#'a'", "Color#Red"
ExpressionPtr Parser::prefixed_literal() {
  const Name type = literal_prefix();
  ExpressionPtr node;
  if (at(TokenKind::Identifier)) {
    node = make(ExpressionKind::EnumValue);
    const Token& token = advance();
    node->name = {token.name, token.text, token.where};
  } else if (at(TokenKind::Minus) || at(TokenKind::Plus)) {
    const bool negative = advance().is(TokenKind::Minus);
    ExpressionPtr value = literal();
    if (negative) {
      // The sign belongs to the literal: INT#-32768 is in range although 32768 is not.
      node = make(ExpressionKind::Unary);
      node->op = Operator::Negate;
      adopt(*node, std::move(value));
    } else {
      node = std::move(value);
    }
  } else {
    node = literal();
  }
  node->prefix = type;
  node->where = type.where;
  return node;
}

}  // namespace stepwright::syntax::internal
