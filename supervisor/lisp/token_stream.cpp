#include "supervisor/lisp/token_stream.h"

#include <algorithm>

namespace stepwright::lisp {

TokenStream::TokenStream(std::vector<Token> tokens, Reporter& reporter)
    : tokens_(std::move(tokens)), reporter_(reporter) {}

const Token& TokenStream::peek(std::size_t ahead) const {
  return tokens_[std::min(position_ + ahead, tokens_.size() - 1)];
}

const Token& TokenStream::take() {
  const Token& token = peek();
  if (token.kind == TokenKind::Open) {
    ++depth_;
    open_.push_back(token.at);
  } else if (token.kind == TokenKind::Close && depth_ > 0) {
    --depth_;
    open_.pop_back();
  }
  if (position_ + 1 < tokens_.size()) ++position_;
  return token;
}

bool TokenStream::accept(TokenKind kind) {
  if (!at(kind)) return false;
  take();
  return true;
}

bool TokenStream::expect(TokenKind kind, std::string_view what) {
  return accept(kind) || unexpected(what);
}

bool TokenStream::expect_name(std::string_view what, std::string& name, Place& place) {
  if (!at(TokenKind::Name)) return unexpected(what);
  place = peek().at;
  name = take().text;
  return true;
}

bool TokenStream::unexpected(std::string_view expected, std::string hint) {
  const Token& token = peek();
  if (token.kind == TokenKind::End) {
    if (hint.empty() && tokens_.size() == 1) hint = "nothing but blanks and comments is in it";
    if (hint.empty() && !open_.empty()) {
      hint = "the parenthesis opened in line " + std::to_string(open_.back().line) + ", column " +
             std::to_string(open_.back().column) + " is not closed";
    }
    reporter_.error("P0004", token.at, "the file ends where " + std::string(expected) + " is expected",
                    std::move(hint));
  } else {
    reporter_.error("P0003", token.at, "expected " + std::string(expected) + ", found " + quoted(token),
                    std::move(hint));
  }
  return false;
}

bool TokenStream::too_deep() {
  // Deeper than any real file, shallow enough for a stack of 2 MB.
  constexpr std::size_t kMaxDepth = 1200;
  if (depth_ < kMaxDepth) return false;
  reporter_.error("P0006", peek().at, "nested too deeply",
                  "at most " + std::to_string(kMaxDepth) + " parentheses may be open");
  return true;
}

void TokenStream::recover(std::size_t depth) {
  while (depth_ > depth && !at(TokenKind::End)) take();
}

}  // namespace stepwright::lisp
