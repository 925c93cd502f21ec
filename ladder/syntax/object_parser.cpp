// The object-oriented part of edition 3 (IEC 61131-3, 6.6.5 to 6.6.7) is not supported: its words are known,
// so that each is refused where it stands and what belongs to it is no further mistake.

#include <algorithm>

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

namespace {

template <std::size_t N>
bool is_word(const Token& token, const source::NameTable& names, const std::string_view (&words)[N]) {
  return token.is(TokenKind::Identifier) &&
         std::find(std::begin(words), std::end(words), names.folded(token.name)) != std::end(words);
}

}  // namespace

// METHOD name, METHOD PUBLIC name: two names in a row begin nothing else.
bool Parser::at_object() const {
  static constexpr std::string_view kWords[] = {"METHOD", "PROPERTY", "CLASS", "INTERFACE"};
  return kind_ == TextKind::Written && peek(1).is(TokenKind::Identifier) &&
         is_word(peek(), context_.names, kWords);
}

void Parser::object_word() {
  if (reported_at_ == at_) return;
  reported_at_ = at_;
  context_.sink.error(source::code::kNotSupported, peek().where,
                      "'" + std::string(peek().text) +
                          "' belongs to classes, methods and inheritance, which are not supported",
                      "write a function, or a function block with inputs and outputs for what it does");
}

// To behind END_METHOD and its like; a POU that begins or ends sooner ends it, too.
void Parser::skip_object() {
  const std::string end = "END_" + source::upper(peek().text);
  object_word();
  advance();
  while (!at(TokenKind::End) && !begins_or_ends_pou(peek()))
    if (source::upper(advance().text) == end) break;
  accept(TokenKind::Semicolon);
}

// PUBLIC, FINAL, ABSTRACT and the like before a name; true if one was passed.
bool Parser::accept_modifier() {
  static constexpr std::string_view kWords[] = {"ABSTRACT",  "FINAL",   "INTERNAL", "OVERRIDE",
                                                "PROTECTED", "PRIVATE", "PUBLIC"};
  if (kind_ != TextKind::Written || !peek(1).is(TokenKind::Identifier) ||
      !is_word(peek(), context_.names, kWords))
    return false;
  object_word();
  advance();
  return true;
}

// "EXTENDS base", "IMPLEMENTS one, other" behind the name of a POU: the rest of its line.
void Parser::skip_inheritance() {
  static constexpr std::string_view kWords[] = {"EXTENDS", "IMPLEMENTS"};
  if (kind_ != TextKind::Written || !is_word(peek(), context_.names, kWords)) return;
  object_word();
  skip_header_line();
}

}  // namespace stepwright::syntax::internal
