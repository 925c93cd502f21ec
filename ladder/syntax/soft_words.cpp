#include "ladder/syntax/soft_words.h"

namespace stepwright::syntax {

namespace {

bool is_infix(const Token& token) {
  return token.is(Keyword::At) || token.is(Keyword::By) || token.is(Keyword::From) || token.is(Keyword::On) ||
         token.is(Keyword::To) || token.is(Keyword::With);
}

bool is_prefix(const Token& token) {
  return token.is(Keyword::Action) || token.is(Keyword::Jmp) || token.is(Keyword::Resource) ||
         token.is(Keyword::Step) || token.is(Keyword::Task);
}

// "clock : BOOL R_EDGE"
bool is_suffix(const Token& token) {
  return token.is(Keyword::RisingEdge) || token.is(Keyword::FallingEdge);
}

// The last token of an operand or a name.
bool ends_operand(const Token& token) {
  switch (token.kind) {
    case TokenKind::Identifier:
    case TokenKind::Integer:
    case TokenKind::Real:
    case TokenKind::Time:
    case TokenKind::Date:
    case TokenKind::TimeOfDay:
    case TokenKind::DateAndTime:
    case TokenKind::String:
    case TokenKind::WideString:
    case TokenKind::Direct:
    case TokenKind::Bad:
    case TokenKind::RightParen:
    case TokenKind::RightBracket:
    case TokenKind::Caret:
      return true;
    default:
      return token.is(Keyword::True) || token.is(Keyword::False) || token.is(Keyword::Null) ||
             token.is(Keyword::Transition);
  }
}

}  // namespace

void soften(std::vector<Token>& tokens) {
  const Token end;
  const auto at = [&](std::size_t i) -> const Token& { return i < tokens.size() ? tokens[i] : end; };
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    Token& token = tokens[i];
    if (!token.is(TokenKind::Keyword)) continue;
    bool reserved = true;
    if (is_suffix(token)) {
      reserved = i > 0 && ends_operand(tokens[i - 1]);
    } else if (is_infix(token)) {
      // "VAR AT %MW0 : INT;" is a variable without a name.
      reserved = (i > 0 && ends_operand(tokens[i - 1])) ||
                 (token.is(Keyword::At) && at(i + 1).is(TokenKind::Direct));
    } else if (is_prefix(token)) {
      const Token& next = at(i + 1);
      const bool names = next.is(TokenKind::Identifier) ||
                         ((is_infix(next) || is_prefix(next)) && at(i + 2).is(TokenKind::Colon));
      reserved = names && !(i > 0 && tokens[i - 1].is(TokenKind::Dot));
    }
    if (reserved) continue;
    token.kind = TokenKind::Identifier;
    token.keyword = Keyword::None;
  }
}

}  // namespace stepwright::syntax
