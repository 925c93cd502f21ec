// Expressions, with the precedence of IEC 61131-3:2013, table 71.

#include <algorithm>
#include <array>
#include <cassert>

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax {

const char* to_string(Operator op) {
  static constexpr std::array kWords = {
      "OR", "XOR", "AND", "=", "<>", "<", "<=", ">", ">=", "+", "-", "*", "/", "MOD", "**", "-", "+", "NOT"};
  return kWords[static_cast<std::size_t>(op)];
}

}  // namespace stepwright::syntax

namespace stepwright::syntax::internal {

namespace {

constexpr std::uint16_t kMaxDepth = 500;
constexpr int kPowerLevel = 7;

// The level at which an operator binds, 0 = loosest; -1 for a token that is no binary operator.
struct Binary {
  int level = -1;
  Operator op = Operator::Or;
};

Binary binary_operator(const Token& token) {
  switch (token.kind) {
    case TokenKind::Ampersand:
      return {2, Operator::And};
    case TokenKind::Equal:
      return {3, Operator::Equal};
    case TokenKind::NotEqual:
      return {3, Operator::NotEqual};
    case TokenKind::Less:
      return {4, Operator::Less};
    case TokenKind::LessEqual:
      return {4, Operator::LessEqual};
    case TokenKind::Greater:
      return {4, Operator::Greater};
    case TokenKind::GreaterEqual:
      return {4, Operator::GreaterEqual};
    case TokenKind::Plus:
      return {5, Operator::Add};
    case TokenKind::Minus:
      return {5, Operator::Subtract};
    case TokenKind::Star:
      return {6, Operator::Multiply};
    case TokenKind::Slash:
      return {6, Operator::Divide};
    case TokenKind::Power:
      return {kPowerLevel, Operator::Power};
    case TokenKind::Keyword:
      break;
    default:
      return {};
  }
  switch (token.keyword) {
    case Keyword::Or:
      return {0, Operator::Or};
    case Keyword::Xor:
      return {1, Operator::Xor};
    case Keyword::And:
      return {2, Operator::And};
    case Keyword::Mod:
      return {6, Operator::Modulo};
    default:
      return {};
  }
}

void adopt(Expression& parent, ExpressionPtr child) {
  parent.depth = std::max<std::uint16_t>(parent.depth, static_cast<std::uint16_t>(child->depth + 1));
  parent.operands.push_back(std::move(child));
}

}  // namespace

ExpressionPtr Parser::make(ExpressionKind kind) const {
  auto node = std::make_unique<Expression>();
  node->kind = kind;
  node->where = peek().where;
  return node;
}

ExpressionPtr Parser::expression() {
  const Nesting nesting(*this);
  if (too_deep()) return error_node();
  return binary(0);
}

ExpressionPtr Parser::binary(int level) {
  if (level > kPowerLevel) return unary();
  ExpressionPtr left = binary(level + 1);
  bool chained = false;
  for (Binary found = binary_operator(peek()); found.level == level; found = binary_operator(peek())) {
    const source::Position where = advance().where;
    ExpressionPtr right = binary(level + 1);
    left = join(found.op, std::move(left), std::move(right), where, chained);
    chained = true;
  }
  return left;
}

// `extend`: the left side was made by this very loop, so a chain of one operator stays flat.
ExpressionPtr Parser::join(Operator op, ExpressionPtr left, ExpressionPtr right, source::Position where,
                           bool extend) {
  if (extend && left->kind == ExpressionKind::Binary && left->op == op) {
    adopt(*left, std::move(right));
    return left;
  }
  auto node = make(ExpressionKind::Binary);
  node->op = op;
  node->where = where;
  if (std::max(left->depth, right->depth) >= kMaxDepth) {
    context_.sink.error(source::code::kTooDeep, where, "the expression is nested too deeply",
                        "split it into several assignments");
    return error_node();
  }
  adopt(*node, std::move(left));
  adopt(*node, std::move(right));
  return node;
}

ExpressionPtr Parser::unary() {
  const bool is_sign = at(TokenKind::Minus) || at(TokenKind::Plus);
  if (!is_sign && !at(Keyword::Not)) return primary();
  const Nesting nesting(*this);
  if (too_deep()) return error_node();
  auto node = make(ExpressionKind::Unary);
  const Token& token = advance();
  node->op = token.is(TokenKind::Minus)  ? Operator::Negate
             : token.is(TokenKind::Plus) ? Operator::Plus
                                         : Operator::Not;
  adopt(*node, unary());
  return node;
}

ExpressionPtr Parser::primary() {
  switch (peek().kind) {
    case TokenKind::LeftParen: {
      advance();
      ExpressionPtr inside = expression();
      expect(TokenKind::RightParen, "to close the parenthesis");
      return inside;
    }
    case TokenKind::Identifier:
      return name_or_call();
    case TokenKind::TypePrefix:
      return prefixed_literal();
    case TokenKind::Direct: {
      auto node = make(ExpressionKind::Direct);
      const Token& token = advance();
      const auto address = naming::parse_direct_address(token.text);
      if (!address) {
        context_.sink.error(source::code::kBadAddress, token.where,
                            "'" + std::string(token.text) + "' is no address",
                            "addresses look like %IX0.0, %QB1, %MW2, %ID3 or %ML4");
        return error_node();
      }
      node->address = *address;
      return node;
    }
    case TokenKind::Keyword:
      // NOT is an operator and a function name ("NOT(x)"); AND(a, b) and MOD(a, b) are functions too.
      if ((at(Keyword::And) || at(Keyword::Or) || at(Keyword::Xor) || at(Keyword::Mod)) &&
          peek(1).is(TokenKind::LeftParen))
        return name_or_call();
      return literal();
    default:
      return literal();
  }
}

ExpressionPtr Parser::literal() {
  auto node = make(ExpressionKind::Integer);
  const Token& token = peek();
  if (at(Keyword::True) || at(Keyword::False)) {
    node->kind = ExpressionKind::Boolean;
    node->integer = at(Keyword::True) ? 1 : 0;
  } else if (at(TokenKind::Integer)) {
    node->integer = token.integer;
    node->based = token.based;
  } else if (at(TokenKind::Real)) {
    node->kind = ExpressionKind::Real;
    node->real = token.real;
  } else if (at(TokenKind::Time)) {
    node->kind = ExpressionKind::Time;
    node->time_ns = token.time_ns;
  } else if (at(TokenKind::String)) {
    context_.sink.error(source::code::kNotSupported, token.where, "strings are not supported yet");
    advance();
    return error_node();
  } else {
    unexpected("an expression", at(TokenKind::Keyword)
                                    ? "'" + std::string(token.text) + "' is a reserved word"
                                    : std::string());
    return error_node();
  }
  advance();
  return node;
}

// "INT#-5", "BOOL#TRUE", "WORD#16#FF", "Color#Red"
ExpressionPtr Parser::prefixed_literal() {
  const Token& prefix = advance();
  const Name type{prefix.name, prefix.text, prefix.where};
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
  node->where = prefix.where;
  return node;
}

ExpressionPtr Parser::name_or_call() {
  auto node = make(ExpressionKind::Variable);
  const Token& token = advance();
  node->name = {token.name, token.text, token.where};
  if (at(TokenKind::LeftParen)) {
    node->kind = ExpressionKind::Call;
    call_arguments(*node);
  }
  return suffixes(std::move(node));
}

// "timers[3](IN := x)": a call of a block that is a part of a variable.
bool Parser::at_path_call(const Expression& base) const {
  return at(TokenKind::LeftParen) &&
         (base.kind == ExpressionKind::Field || base.kind == ExpressionKind::Index);
}

void Parser::call_arguments(Expression& call) {
  call.arguments = arguments();
  for (const Argument& each : call.arguments)
    if (each.value)
      call.depth = std::max<std::uint16_t>(call.depth, static_cast<std::uint16_t>(each.value->depth + 1));
}

ExpressionPtr Parser::suffixes(ExpressionPtr base) {
  while (at(TokenKind::Dot) || at(TokenKind::LeftBracket) || at_path_call(*base)) {
    if (base->depth >= kMaxDepth) {
      nesting_ += 1000;
      too_deep();
      nesting_ -= 1000;
      return error_node();
    }
    auto node = make(at(TokenKind::Dot) ? ExpressionKind::Field : ExpressionKind::Index);
    node->where = base->where;
    adopt(*node, std::move(base));
    if (at(TokenKind::LeftParen)) {
      node->kind = ExpressionKind::Call;
      call_arguments(*node);
    } else if (accept(TokenKind::Dot)) {
      const auto name = expect_name("the name of a member");
      if (!name) return error_node();
      node->name = *name;
    } else {
      advance();
      do adopt(*node, expression());
      while (accept(TokenKind::Comma));
      expect(TokenKind::RightBracket, "to close the index");
    }
    base = std::move(node);
  }
  return base;
}

std::vector<Argument> Parser::arguments() {
  std::vector<Argument> list;
  advance();  // '('
  if (accept(TokenKind::RightParen)) return list;
  do list.push_back(argument());
  while (accept(TokenKind::Comma));
  expect(TokenKind::RightParen, "to close the argument list");
  return list;
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
  result.value = expression();
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
