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

// "[3][1]" of `[3, -1]` that begins at `i`, which is moved behind it; nothing if the text does not fix it.
std::string fixed_index(const std::vector<Token>& tokens, std::size_t& i) {
  std::string text;
  std::size_t at = i;
  do {
    ++at;
    const bool minus = tokens[at].is(TokenKind::Minus);
    if (minus) ++at;
    if (!tokens[at].is(TokenKind::Integer)) return {};
    text += (minus ? "[-" : "[") + std::to_string(tokens[at].integer) + "]";
    ++at;
  } while (tokens[at].is(TokenKind::Comma));
  if (!tokens[at].is(TokenKind::RightBracket)) return {};
  i = at + 1;
  return text;
}

// The part of a path that the text fixes; the use gets it and how long it is.
void set_path(const std::vector<Token>& tokens, std::size_t i, TextUse& use) {
  const std::size_t begin = tokens[i].where.offset;
  use.path = std::string(tokens[i].text);
  for (std::size_t next = i + 1; !tokens[next].is(TokenKind::End);) {
    if (tokens[next].is(TokenKind::Dot) && tokens[next + 1].is(TokenKind::Identifier)) {
      use.path += "." + std::string(tokens[next + 1].text);
      next += 2;
    } else if (tokens[next].is(TokenKind::LeftBracket)) {
      const std::string index = fixed_index(tokens, next);
      if (index.empty()) break;
      use.path += index;
    } else {
      break;
    }
    i = next - 1;
  }
  use.length = static_cast<std::uint32_t>(tokens[i].where.offset + tokens[i].text.size() - begin);
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
    TextUse& use = uses.emplace_back();
    use.name = std::string(tokens[i].text);
    use.call = behind.is(TokenKind::LeftParen);
    use.write = assigned || output || use.call;
    const source::LineColumn where = sources.line_column(tokens[i].where);
    use.line = where.line;
    use.column = where.column;
    set_path(tokens, i, use);
  }
  return uses;
}

}  // namespace stepwright::print
