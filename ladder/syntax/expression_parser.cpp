// Expressions, with the precedence of IEC 61131-3:2013, table 71.

#include <algorithm>
#include <array>
#include <cassert>

#include "ladder/syntax/internal/parser.h"
#include "ladder/syntax/number.h"
#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::syntax {

const char* to_string(Operator op) {
  static constexpr std::array kWords = {"OR", "XOR", "AND", "OR_ELSE", "AND_THEN", "=",  "<>",
                                        "<",  "<=",  ">",   ">=",      "+",        "-",  "*",
                                        "/",  "MOD", "**",  "-",       "+",        "NOT"};
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
    case Keyword::OrElse:
      return {0, Operator::OrElse};
    case Keyword::Xor:
      return {1, Operator::Xor};
    case Keyword::And:
      return {2, Operator::And};
    case Keyword::AndThen:
      return {2, Operator::AndThen};
    case Keyword::Mod:
      return {6, Operator::Modulo};
    default:
      return {};
  }
}

}  // namespace

void Parser::adopt(Expression& parent, ExpressionPtr child) {
  parent.depth = std::max<std::uint16_t>(parent.depth, static_cast<std::uint16_t>(child->depth + 1));
  parent.operands.push_back(std::move(child));
}

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

// "a := 5" and "a => 5" where a value stands: what was meant is a comparison.
ExpressionPtr Parser::no_assignment(ExpressionPtr before) {
  if (!at(TokenKind::Assign) && !at(TokenKind::Output)) return before;
  unexpected("a comparison", at(TokenKind::Assign)
                                 ? "equal is written '='; ':=' assigns, and only a statement does that"
                                 : "greater or equal is written '>='");
  advance();
  expression();
  reported_at_ = at_;
  return error_node();
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
      ExpressionPtr inside = no_assignment(expression());
      expect(TokenKind::RightParen, "to close the parenthesis");
      return inside;
    }
    case TokenKind::Identifier:
      return at_full_prefix() ? prefixed_literal() : name_or_call();
    case TokenKind::TypePrefix:
      return prefixed_literal();
    case TokenKind::Direct: {
      auto node = make(ExpressionKind::Direct);
      const auto address = direct_address();
      if (!address) return error_node();
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
         (base.kind == ExpressionKind::Field || base.kind == ExpressionKind::Index ||
          base.kind == ExpressionKind::Dereference);
}

void Parser::call_arguments(Expression& call) {
  std::vector<Argument> given;
  if (!arguments(given)) call.kind = ExpressionKind::Error;
  for (Argument& each : given) {
    if (each.value)
      call.depth = std::max<std::uint16_t>(call.depth, static_cast<std::uint16_t>(each.value->depth + 1));
    const std::string formal = each.formal ? source::upper(each.formal->text) : std::string();
    if (formal == "EN" && !each.is_output && !call.enable) {
      call.enable = std::make_unique<Argument>(std::move(each));
    } else if (formal == "ENO" && each.is_output && !call.enabled) {
      call.enabled = std::make_unique<Argument>(std::move(each));
    } else {
      call.arguments.push_back(std::move(each));
    }
  }
}

ExpressionPtr Parser::suffixes(ExpressionPtr base) {
  while (at(TokenKind::Dot) || at(TokenKind::LeftBracket) || at(TokenKind::Caret) || at_path_call(*base)) {
    if (base->depth >= kMaxDepth) {
      nesting_ += 1000;
      too_deep();
      nesting_ -= 1000;
      return error_node();
    }
    auto node = make(at(TokenKind::Caret)         ? ExpressionKind::Dereference
                     : at(TokenKind::LeftBracket) ? ExpressionKind::Index
                                                  : ExpressionKind::Field);
    node->where = base->where;
    adopt(*node, std::move(base));
    if (at(TokenKind::LeftParen)) {
      node->kind = ExpressionKind::Call;
      call_arguments(*node);
    } else if (accept(TokenKind::Dot)) {
      if (!member(*node)) return error_node();
    } else if (advance().is(TokenKind::LeftBracket)) {
      do adopt(*node, expression());
      while (accept(TokenKind::Comma));
      expect(TokenKind::RightBracket, "to close the index");
    }
    base = std::move(node);
  }
  return base;
}

// Behind the '.': the name of a member, or a part of a bit string: %X3, %B1, %W0, %D1, or 3 for %X3 (table
// 17).
bool Parser::member(Expression& node) {
  const Token& token = peek();
  if (at(TokenKind::Integer) && !token.based) {
    node.kind = ExpressionKind::Part;
    node.integer = advance().integer;
    return true;
  }
  if (at(TokenKind::Direct)) {
    static constexpr std::string_view kSizes = "XBWDL";
    static constexpr std::uint8_t kBits[] = {1, 8, 16, 32, 64};
    const std::size_t size = kSizes.find(naming::to_upper(token.text.size() > 1 ? token.text[1] : ' '));
    const auto number = parse_integer(token.text.substr(std::min<std::size_t>(token.text.size(), 2)), 10);
    advance();
    if (size == std::string_view::npos || !number) {
      context_.sink.error(source::code::kBadAddress, token.where,
                          "'" + std::string(token.text) + "' is no part of a variable",
                          "parts of bit strings are written .%X7, .%B1, .%W0 or .%D1");
      return false;
    }
    node.kind = ExpressionKind::Part;
    node.part_bits = kBits[size];
    node.integer = *number;
    return true;
  }
  const auto name = expect_name("the name of a member");
  if (name) node.name = *name;
  return name.has_value();
}

// The address that stands here, reported if it is none.
std::optional<DirectAddress> Parser::direct_address() {
  const Token& token = advance();
  auto address = naming::parse_direct_address(token.text);
  if (const auto hierarchical = address ? std::nullopt : parse_hierarchical(token.text)) {
    address = hierarchical->address;
    address->byte = kHierarchical + context_.names.intern(token.text).value;
  }
  if (!address) {
    const bool is_open = !token.text.empty() && token.text.back() == '*';
    context_.sink.error(source::code::kBadAddress, token.where,
                        "'" + std::string(token.text) + "' is no address",
                        is_open ? "an address with '*' stands behind AT in VAR of a program or function block"
                                : "addresses look like %IX0.0, %QB1, %MW2, %ID3 or %ML4");
  }
  return address;
}

}  // namespace stepwright::syntax::internal
