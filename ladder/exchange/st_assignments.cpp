#include "ladder/exchange/st_assignments.h"

#include <algorithm>

#include "ladder/syntax/piece.h"

namespace stepwright::exchange {
namespace {

using syntax::Token;
using syntax::TokenKind;

// One statement, without its ';', or nothing if it is no assignment.
std::optional<Assignment> assignment_of(const std::string& st, const std::vector<Token>& tokens,
                                        std::size_t first, std::size_t last) {
  std::size_t assign = first;
  while (assign < last && !tokens[assign].is(TokenKind::Assign) && !tokens[assign].is(TokenKind::LeftParen))
    ++assign;
  if (tokens[first].is(TokenKind::Keyword) || assign == last || !tokens[assign].is(TokenKind::Assign))
    return std::nullopt;
  const auto text = [&](std::size_t from, std::size_t to) {
    const std::size_t begin = syntax::begin_of(tokens[from], st);
    return st.substr(begin, syntax::end_of(tokens[to - 1], st) - begin);
  };
  return Assignment{text(first, assign), text(assign + 1, last)};
}

// A drawing has no place for comments, and what is not on it would be lost.
bool has_comment(syntax::PieceReader& reader, const std::string& st) {
  std::string line = st;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return reader.bare_line(st) != line;
}

}  // namespace

std::optional<std::vector<Assignment>> assignments_of(const std::string& st) {
  syntax::PieceReader reader;
  if (!reader.read(st, syntax::PieceKind::StatementList).is_whole || has_comment(reader, st))
    return std::nullopt;
  const std::vector<Token> tokens = reader.tokens(st);
  std::vector<Assignment> list;
  for (std::size_t first = 0; !tokens[first].is(TokenKind::End);) {
    std::size_t last = first;
    while (!tokens[last].is(TokenKind::Semicolon) && !tokens[last].is(TokenKind::End)) {
      // The formats that ask have no words for texts.
      if (tokens[last].is(TokenKind::String) || tokens[last].is(TokenKind::WideString)) return std::nullopt;
      ++last;
    }
    if (last > first) {
      auto assignment = assignment_of(st, tokens, first, last);
      if (!assignment) return std::nullopt;
      list.push_back(std::move(*assignment));
    }
    first = last + (tokens[last].is(TokenKind::Semicolon) ? 1 : 0);
  }
  return list;
}

}  // namespace stepwright::exchange
