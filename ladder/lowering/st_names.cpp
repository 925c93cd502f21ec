#include "ladder/lowering/st_names.h"

#include <algorithm>
#include <vector>

#include "runtime/ground/naming/ascii_names.h"

namespace stepwright::lowering {
namespace {

using syntax::Token;
using syntax::TokenKind;

// 'X' for "X" and "x"; 0 for what is no flag of a step or an action.
char flag_letter(const Token& token) {
  if (!token.is(TokenKind::Identifier) || token.text.size() != 1) return 0;
  const char letter = naming::to_upper(token.text[0]);
  return letter == 'X' || letter == 'T' || letter == 'Q' || letter == 'A' ? letter : '\0';
}

// The letter of the flag `<name>.X` that begins at `i`; 0 if none does.
char flag_at(const std::vector<Token>& tokens, std::size_t i) {
  if (i + 2 >= tokens.size() || !tokens[i].is(TokenKind::Identifier)) return 0;
  if (i > 0 && tokens[i - 1].is(TokenKind::Dot)) return 0;
  return tokens[i + 1].is(TokenKind::Dot) ? flag_letter(tokens[i + 2]) : '\0';
}

}  // namespace

void for_each_identifier(syntax::PieceReader& reader, std::string_view text,
                         const std::function<void(std::string_view)>& visit) {
  if (text.empty()) return;
  for (const Token& token : reader.tokens(text))
    if (token.is(TokenKind::Identifier)) visit(token.text);
}

void for_each_first_name(syntax::PieceReader& reader, std::string_view list,
                         const std::function<void(std::string_view)>& visit) {
  if (list.empty()) return;
  int depth = 0;
  bool begins = true;
  for (const Token& token : reader.tokens(list)) {
    if (token.is(TokenKind::LeftBracket)) ++depth;
    if (token.is(TokenKind::RightBracket)) --depth;
    if (begins && token.is(TokenKind::Identifier)) visit(token.text);
    begins = depth == 0 && token.is(TokenKind::Comma);
  }
}

std::string replace_flags(syntax::PieceReader& reader, std::string_view text,
                          const std::function<std::string(std::string_view, char)>& flag) {
  if (text.find('.') == std::string_view::npos) return std::string(text);
  const std::vector<Token> tokens = reader.tokens(text);
  std::string result;
  std::size_t copied = 0;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const char letter = flag_at(tokens, i);
    const std::string replacement = letter == 0 ? std::string() : flag(tokens[i].text, letter);
    if (replacement.empty()) continue;
    result += text.substr(copied, syntax::begin_of(tokens[i], text) - copied);
    result += replacement;
    i += 2;
    copied = syntax::end_of(tokens[i], text);
  }
  return result += text.substr(copied);
}

void for_each_written_flag(syntax::PieceReader& reader, std::string_view text,
                           const std::function<void(std::string_view, char)>& visit) {
  if (text.find('.') == std::string_view::npos) return;
  const std::vector<Token> tokens = reader.tokens(text);
  for (std::size_t i = 0; i + 3 < tokens.size(); ++i) {
    const char letter = flag_at(tokens, i);
    const bool assigned = tokens[i + 3].is(TokenKind::Assign) || tokens[i + 3].is(TokenKind::AttemptAssign);
    const bool output = i > 0 && tokens[i - 1].is(TokenKind::Output);
    if (letter != 0 && (assigned || output)) visit(tokens[i].text, letter);
  }
}

bool holds_return(syntax::PieceReader& reader, std::string_view text) {
  const std::vector<Token> tokens = reader.tokens(text);
  return std::any_of(tokens.begin(), tokens.end(),
                     [](const Token& token) { return token.is(syntax::Keyword::Return); });
}

}  // namespace stepwright::lowering
