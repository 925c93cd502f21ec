#include "ladder/print/text_uses.h"

#include "ladder/syntax/lexer.h"

namespace stepwright::print {

namespace {

using syntax::Token;
using syntax::TokenKind;

// Behind "a.b[i].c^" that begins at `i`.
std::size_t end_of_path(const std::vector<Token>& tokens, std::size_t i) {
  for (++i; !tokens[i].is(TokenKind::End); ++i) {
    if (tokens[i].is(TokenKind::Caret)) continue;
    if (tokens[i].is(TokenKind::Dot)) {
      ++i;
      if (tokens[i].is(TokenKind::End)) break;
      continue;
    }
    if (!tokens[i].is(TokenKind::LeftBracket)) break;
    for (int depth = 0; !tokens[i].is(TokenKind::End); ++i) {
      if (tokens[i].is(TokenKind::LeftBracket)) ++depth;
      if (tokens[i].is(TokenKind::RightBracket) && --depth == 0) break;
    }
    if (tokens[i].is(TokenKind::End)) break;
  }
  return i;
}

}  // namespace

TextUses::TextUses() {
  syntax::intern_keywords(names_);
}

std::vector<TextUse> TextUses::of(std::string_view text) {
  source::SourceSet sources;
  source::DiagnosticSink sink(sources);
  const source::FileId file = sources.add("", std::string(text));
  const std::vector<Token> tokens = syntax::lex(sources, file, syntax::TextKind::Written, names_, sink);
  std::vector<TextUse> uses;
  int depth = 0;
  for (std::size_t i = 0; !tokens[i].is(TokenKind::End); ++i) {
    if (tokens[i].is(TokenKind::LeftParen)) ++depth;
    if (tokens[i].is(TokenKind::RightParen)) --depth;
    if (!tokens[i].is(TokenKind::Identifier) && !tokens[i].is(TokenKind::Direct)) continue;
    if (i > 0 && tokens[i - 1].is(TokenKind::Dot)) continue;
    const Token& next = tokens[i + 1];
    const bool formal = depth > 0 && (next.is(TokenKind::Assign) || next.is(TokenKind::Output));
    if (formal) continue;
    const Token& behind = tokens[end_of_path(tokens, i)];
    const bool assigned = depth == 0 && (behind.is(TokenKind::Assign) || behind.is(TokenKind::AttemptAssign));
    const bool output = i > 0 && tokens[i - 1].is(TokenKind::Output);
    uses.push_back({std::string(tokens[i].text), sources.line(tokens[i].where),
                    assigned || output || behind.is(TokenKind::LeftParen)});
  }
  return uses;
}

}  // namespace stepwright::print
