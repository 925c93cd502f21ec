// Statements (IEC 61131-3, 7.3.3).

#include <algorithm>

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

StatementPtr Parser::make_statement(StatementKind kind) const {
  auto node = std::make_unique<Statement>();
  node->kind = kind;
  node->where = peek().where;
  return node;
}

// Up to a word that ends a block or, inside CASE, up to the next label: a block that is not closed ends
// there.
Statements Parser::statements() {
  Statements list;
  while (!at_block_end() && !(cases_ > 0 && at_case_label())) {
    if (accept(TokenKind::Semicolon)) continue;
    const std::size_t before = at_;
    if (StatementPtr each = statement()) list.push_back(std::move(each));
    // Whatever happened, a token was used up.
    if (at_ == before) {
      unexpected("a statement");
      advance();
    }
  }
  return list;
}

StatementPtr Parser::statement() {
  const Nesting nesting(*this);
  if (too_deep()) return nullptr;
  if (jumps_) {
    if (StatementPtr jump = jump_statement()) return jump;
  }
  switch (peek().is(TokenKind::Keyword) ? peek().keyword : Keyword::None) {
    case Keyword::If:
      return if_statement();
    case Keyword::Case:
      return case_statement();
    case Keyword::For:
      return for_statement();
    case Keyword::While:
      return while_statement();
    case Keyword::Repeat:
      return repeat_statement();
    case Keyword::Exit:
      return keyword_statement(StatementKind::Exit);
    case Keyword::Continue:
      return keyword_statement(StatementKind::Continue);
    case Keyword::Return:
      return keyword_statement(StatementKind::Return);
    default:
      return simple_statement();
  }
}

// Behind a statement. A forgotten ';' is reported; if a statement begins on the spot, nothing is skipped.
void Parser::end_of_statement(const std::string& hint) {
  if (accept(TokenKind::Semicolon)) return;
  if (open_end_ && (at(TokenKind::End) || at(Keyword::EndAction))) return;
  expect(TokenKind::Semicolon, "behind the statement", hint);
  const bool begins_here =
      at(TokenKind::Identifier) && at_ > 0 &&
      context_.sources.line(peek().where) > context_.sources.line(tokens_[at_ - 1].where);
  if (!begins_here) skip_statement();
}

// Behind END_IF and its like.
void Parser::end_of_block() {
  if (!context_.dialect->loose_ends)
    return end_of_statement(source::with_dialects({}, &source::Dialect::loose_ends));
  accept(TokenKind::Semicolon);
}

StatementPtr Parser::simple_statement() {
  if (!at(TokenKind::Identifier) && !at(TokenKind::Direct)) {
    unexpected("a statement");
    advance();
    skip_statement();
    return nullptr;
  }
  auto node = make_statement(StatementKind::Assign);
  ExpressionPtr left = primary();
  if (left->kind == ExpressionKind::Call && !at(TokenKind::Assign)) {
    node->kind = StatementKind::Call;
    node->value = std::move(left);
    end_of_statement();
    return node;
  }
  if (accept(TokenKind::AttemptAssign)) {
    node->kind = StatementKind::Attempt;
  } else if (!expect(TokenKind::Assign, "behind the variable")) {
    // "x = 1;" is read as the assignment that was meant.
    if (!at(TokenKind::Equal)) {
      skip_statement();
      return nullptr;
    }
    advance();
  }
  node->target = std::move(left);
  node->value = expression();
  end_of_statement();
  return node;
}

namespace {

// In a condition or a bound.
bool may_stand_in_head(const Token& token) {
  static constexpr Keyword kWords[] = {Keyword::And, Keyword::AndThen, Keyword::Or,   Keyword::OrElse,
                                       Keyword::Xor, Keyword::Not,     Keyword::Mod,  Keyword::True,
                                       Keyword::By,  Keyword::False,   Keyword::Null, Keyword::To};
  if (token.is(TokenKind::Keyword))
    return std::find(std::begin(kWords), std::end(kWords), token.keyword) != std::end(kWords);
  return !token.is(TokenKind::Semicolon) && !token.is(TokenKind::Assign) && !token.is(TokenKind::End);
}

}  // namespace

// A word of a statement's head. If it is not here, what stands before it belongs to the mistake; `last` ends
// the head.
void Parser::expect_in_head(Keyword word, const char* after, Keyword last) {
  if (expect(word, after)) return;
  for (std::size_t i = 0;; ++i) {
    const Token& token = peek(i);
    const bool found = token.is(word) || token.is(last);
    if (!found && may_stand_in_head(token)) continue;
    if (found) at_ += i + (token.is(word) ? 1 : 0);
    reported_at_ = at_;
    return;
  }
}

// Of IF, WHILE and UNTIL.
ExpressionPtr Parser::condition() {
  return no_assignment(expression());
}

// "ELSEIF x THEN": as other languages write it.
bool Parser::at_misspelt_elsif() const {
  if (!at_word("ELSEIF") && !at_word("ELIF")) return false;
  for (std::size_t i = 1;; ++i) {
    const Token& token = peek(i);
    if (token.is(Keyword::Then)) return true;
    if (token.is(TokenKind::End) || token.is(TokenKind::Semicolon) || token.is(TokenKind::Assign))
      return false;
  }
}

StatementPtr Parser::if_statement() {
  auto node = make_statement(StatementKind::If);
  const Token* open = &peek();
  std::string hint;
  do {
    if (at_misspelt_elsif()) unexpected("'ELSIF'", "it is written ELSIF");
    advance();  // IF, ELSIF
    Branch branch;
    branch.condition = condition();
    expect_in_head(Keyword::Then, "behind the condition", Keyword::Then);
    branch.body = statements();
    node->branches.push_back(std::move(branch));
  } while (at(Keyword::Elsif) || at_misspelt_elsif());
  if (at(Keyword::Else)) {
    const Token& otherwise = advance();
    // "ELSE IF" is an IF in the ELSE: if an END_IF is missing, another form was meant.
    if (at(Keyword::If) && context_.sources.line(peek().where) == context_.sources.line(otherwise.where)) {
      open = &otherwise;
      hint = "ELSE IF begins another IF with an END_IF of its own; a further branch is written ELSIF";
    }
    node->has_else = true;
    node->otherwise = statements();
  }
  if (expect_end(Keyword::EndIf, *open, hint)) end_of_block();
  return node;
}

// A label list and its ':' stand here. Only called inside CASE, so what reaches a ':' before it becomes a
// statement is one.
bool Parser::at_case_label() const {
  for (std::size_t i = 0;; ++i) {
    const Token& token = peek(i);
    switch (token.kind) {
      case TokenKind::Colon:
        return i > 0;
      case TokenKind::End:
      case TokenKind::Bad:
      case TokenKind::Semicolon:
      case TokenKind::Assign:
      case TokenKind::AttemptAssign:
      case TokenKind::Output:
        return false;
      case TokenKind::Keyword:
        if (!token.is(Keyword::True) && !token.is(Keyword::False)) return false;
        continue;
      default:
        continue;
    }
  }
}

Branch Parser::case_branch() {
  Branch branch;
  do {
    CaseLabel label;
    label.low = expression();
    if (accept(TokenKind::Range)) label.high = expression();
    branch.labels.push_back(std::move(label));
  } while (accept(TokenKind::Comma));
  expect(TokenKind::Colon, "behind the label");
  branch.body = statements();
  return branch;
}

StatementPtr Parser::case_statement() {
  auto node = make_statement(StatementKind::Case);
  const Token& open = advance();
  node->value = expression();
  expect(Keyword::Of, "behind the selector");
  ++cases_;
  while (!at_block_end()) {
    const std::size_t before = at_;
    node->branches.push_back(case_branch());
    if (at_ == before) advance();
  }
  --cases_;
  if (accept(Keyword::Else)) {
    node->has_else = true;
    node->otherwise = statements();
  }
  if (expect_end(Keyword::EndCase, open)) end_of_block();
  return node;
}

StatementPtr Parser::for_statement() {
  auto node = make_statement(StatementKind::For);
  const Token& open = advance();
  if (const auto name = expect_name("the variable that counts")) {
    node->target = make(ExpressionKind::Variable);
    node->target->name = *name;
    node->target->where = name->where;
  } else {
    node->target = error_node();
  }
  expect(TokenKind::Assign, "behind the variable that counts");
  node->value = expression();
  expect_in_head(Keyword::To, "behind the first value", Keyword::Do);
  node->limit = expression();
  if (accept(Keyword::By)) node->step = expression();
  expect_in_head(Keyword::Do, "before the statements of the loop", Keyword::Do);
  node->body = statements();
  if (expect_end(Keyword::EndFor, open)) end_of_block();
  return node;
}

StatementPtr Parser::while_statement() {
  auto node = make_statement(StatementKind::While);
  const Token& open = advance();
  node->value = condition();
  expect_in_head(Keyword::Do, "behind the condition", Keyword::Do);
  node->body = statements();
  if (expect_end(Keyword::EndWhile, open)) end_of_block();
  return node;
}

StatementPtr Parser::repeat_statement() {
  auto node = make_statement(StatementKind::Repeat);
  const Token& open = advance();
  node->body = statements();
  if (!expect_end(Keyword::Until, open)) return node;
  node->value = condition();
  accept(TokenKind::Semicolon);
  if (expect_end(Keyword::EndRepeat, open)) end_of_block();
  return node;
}

StatementPtr Parser::keyword_statement(StatementKind kind) {
  auto node = make_statement(kind);
  advance();
  end_of_statement();
  return node;
}

StatementPtr Parser::jump_statement() {
  const bool jumps = at(Keyword::Jmp) && peek(1).is(TokenKind::Identifier);
  const bool labels = at(TokenKind::Identifier) && peek(1).is(TokenKind::Colon);
  if (!jumps && !labels) return nullptr;
  auto node = make_statement(jumps ? StatementKind::Jump : StatementKind::Label);
  if (jumps) advance();
  const Token& token = advance();
  node->label = {token.name, token.text, token.where};
  if (jumps) {
    end_of_statement();
  } else {
    advance();
  }
  return node;
}

}  // namespace stepwright::syntax::internal
