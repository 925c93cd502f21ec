#pragma once

// The parser's view of the tokens: looking ahead, expecting, and finding the way back after an error.
//
// Thread rule: one parse, one stream. The parser fails by returning false after reporting; whoever opened a
// section closes it with `recover`, so that one file can show several errors.

#include <string_view>
#include <vector>

#include "supervisor/lisp/lexer.h"

namespace stepwright::lisp {

class TokenStream {
 public:
  TokenStream(std::vector<Token> tokens, Reporter& reporter);

  const Token& peek(std::size_t ahead = 0) const;
  const Token& take();
  bool at(TokenKind kind) const { return peek().kind == kind; }
  bool at(TokenKind kind, std::string_view text) const { return at(kind) && peek().text == text; }

  // Takes the token if it is of that kind.
  bool accept(TokenKind kind);

  // Takes a token of that kind or reports P0003: "expected `what`, found ...".
  bool expect(TokenKind kind, std::string_view what);
  bool expect_name(std::string_view what, std::string& name, Place& place);

  // Reports P0003 (P0004 at the end of the file) at the next token. Always false.
  bool unexpected(std::string_view expected, std::string hint = {});

  // The number of parentheses open now.
  std::size_t depth() const { return depth_; }

  // Reports P0006 where more parentheses are open than recursion may follow.
  bool too_deep();

  // Skips to just behind the parenthesis that closes depth `depth` + 1.
  void recover(std::size_t depth);

  Reporter& reporter() { return reporter_; }

 private:
  std::vector<Token> tokens_;
  std::vector<Place> open_;
  std::size_t position_ = 0;
  std::size_t depth_ = 0;
  Reporter& reporter_;
};

}  // namespace stepwright::lisp
