// The token cursor of the parser and its recovery.

#include <algorithm>

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

namespace {

namespace code = source::code;

constexpr int kMaxNesting = 150;

std::string quoted(const Token& token) {
  if (token.is(TokenKind::End)) return describe(TokenKind::End);
  return "'" + std::string(token.text.substr(0, 40)) + "'";
}

template <std::size_t N>
bool is_one_of(const Token& token, const Keyword (&keywords)[N]) {
  return token.is(TokenKind::Keyword) &&
         std::find(std::begin(keywords), std::end(keywords), token.keyword) != std::end(keywords);
}

}  // namespace

const Token& Parser::peek(std::size_t ahead) const {
  return tokens_[std::min(at_ + ahead, tokens_.size() - 1)];
}

const Token& Parser::advance() {
  const Token& token = peek();
  if (at_ + 1 < tokens_.size()) ++at_;
  return token;
}

bool Parser::accept(TokenKind kind) {
  if (!at(kind)) return false;
  advance();
  return true;
}

bool Parser::accept(Keyword keyword) {
  if (!at(keyword)) return false;
  advance();
  return true;
}

source::Position Parser::after_previous() const {
  if (at_ == 0) return peek().where;
  const Token& previous = tokens_[at_ - 1];
  return {previous.where.file, static_cast<std::uint32_t>(previous.where.offset + previous.text.size())};
}

void Parser::unexpected(const std::string& wanted, const std::string& hint) {
  if (reported_at_ == at_) return;
  reported_at_ = at_;
  // The lexer has complained about a bad token already.
  if (at(TokenKind::Bad)) return;
  context_.sink.error(code::kUnexpectedToken, peek().where,
                      "expected " + wanted + ", found " + quoted(peek()), hint);
}

bool Parser::expect(TokenKind kind, const char* after, const std::string& otherwise) {
  if (accept(kind)) return true;
  if (reported_at_ == at_) return false;
  reported_at_ = at_;
  if (at(TokenKind::Bad)) return false;
  std::string message = std::string("expected ") + describe(kind) + " " + after + ", found " + quoted(peek());
  if (peek().foreign) return false;
  const bool twice =
      kind == TokenKind::Assign && (at(TokenKind::Plus) || at(TokenKind::Minus)) && peek(1).is(peek().kind);
  const char* const sign = at(TokenKind::Plus) ? "+" : "-";
  const std::string hint = at(TokenKind::Equal) && kind == TokenKind::Assign ? "an assignment is written ':='"
                           : twice ? std::string("write x := x ") + sign + " 1"
                                   : otherwise;
  // What is missing belongs behind the token before, which may be on another line.
  const bool missing = kind == TokenKind::Semicolon;
  context_.sink.error(code::kUnexpectedToken, missing ? after_previous() : peek().where, std::move(message),
                      hint);
  return false;
}

bool Parser::expect(Keyword keyword, const char* after) {
  if (accept(keyword)) return true;
  unexpected(std::string("'") + to_string(keyword) + "' " + after);
  return false;
}

bool Parser::expect_end(Keyword keyword, const Token& open, const std::string& hint) {
  if (accept(keyword)) return true;
  // A comment without an end has swallowed the END.
  const bool swallowed = at(TokenKind::End) && at_ > 0 && tokens_[at_ - 1].is(TokenKind::Bad);
  // A block that is not closed is one mistake, whatever follows.
  if (reported_at_ != at_ && !swallowed) {
    reported_at_ = at_;
    context_.sink.error(code::kMissingEnd, open.where,
                        "'" + std::string(open.text) + "' is not closed: '" + to_string(keyword) +
                            "' is missing before " + quoted(peek()),
                        hint);
  }
  return false;
}

std::optional<Name> Parser::expect_name(const char* what) {
  if (at(TokenKind::Identifier)) {
    const Token& token = advance();
    return Name{token.name, token.text, token.where};
  }
  unexpected(what, at(TokenKind::Keyword) ? quoted(peek()) + " is a reserved word and cannot be a name" : "");
  return std::nullopt;
}

bool Parser::begins_or_ends_pou(const Token& token) {
  static constexpr Keyword kStarts[] = {
      Keyword::Program, Keyword::FunctionBlock,   Keyword::Function,    Keyword::Configuration,
      Keyword::Type,    Keyword::EndProgram,      Keyword::EndFunction, Keyword::EndFunctionBlock,
      Keyword::EndType, Keyword::EndConfiguration};
  return is_one_of(token, kStarts);
}

bool Parser::at_block_end() const {
  static constexpr Keyword kEnds[] = {
      Keyword::EndIf,    Keyword::Else,  Keyword::Elsif,       Keyword::EndCase,    Keyword::EndFor,
      Keyword::EndWhile, Keyword::Until, Keyword::EndRepeat,   Keyword::EndAction,  Keyword::EndTransition,
      Keyword::EndStep,  Keyword::Step,  Keyword::InitialStep, Keyword::Transition, Keyword::Action};
  return at(TokenKind::End) || at_pou_start() || at_variable_section() || is_one_of(peek(), kEnds) ||
         at_object() || at_misspelt_elsif();
}

bool Parser::at_statement_keyword() const {
  static constexpr Keyword kStarts[] = {Keyword::If,     Keyword::Case, Keyword::For,      Keyword::While,
                                        Keyword::Repeat, Keyword::Exit, Keyword::Continue, Keyword::Return};
  return is_one_of(peek(), kStarts);
}

void Parser::skip_statement() {
  while (!at_block_end() && !at_statement_keyword()) {
    if (advance().is(TokenKind::Semicolon)) return;
  }
}

void Parser::skip_declaration() {
  static constexpr Keyword kEnds[] = {Keyword::EndVar, Keyword::EndStruct, Keyword::EndType,
                                      Keyword::Resource, Keyword::Task};
  while (!at(TokenKind::End) && !at_pou_start() && !is_one_of(peek(), kEnds) && !at_variable_section() &&
         !at_statement_keyword() && !at_declaration()) {
    if (advance().is(TokenKind::Semicolon)) return;
  }
}

bool Parser::is_too_deep() const {
  static_assert(kMaxNesting > kMaxName / 2, "namespaces are limited by the length of names");
  return nesting_ > kMaxNesting;
}

bool Parser::too_deep() {
  if (!is_too_deep()) return false;
  if (reported_at_ != at_) {
    context_.sink.error(code::kTooDeep, peek().where, "nested too deeply",
                        "split the expression or the statement into several");
  }
  // Nothing of this POU behind this place can be read in a sensible way.
  while (!at(TokenKind::End) && !at_pou_start()) advance();
  reported_at_ = at_;
  return true;
}

}  // namespace stepwright::syntax::internal
