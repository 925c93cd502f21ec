// TEST and MOCK (ladder/doc/testing.md). Their words are reserved nowhere: TEST begins a test where a name in
// quotes follows, MOCK a mock before FUNCTION and FUNCTION_BLOCK, and END_TEST and END_MOCK end what they
// close.

#include <algorithm>

#include "ladder/syntax/internal/parser.h"

namespace stepwright::syntax::internal {

namespace {

// A quoted name without its quotes; $' and $$ stand for the character behind the $.
std::string unquoted(std::string_view text) {
  std::string name;
  const std::string_view inner = text.size() < 2 ? std::string_view() : text.substr(1, text.size() - 2);
  for (std::size_t i = 0; i < inner.size(); ++i) {
    const bool escapes =
        inner[i] == '$' && i + 1 < inner.size() && (inner[i + 1] == '\'' || inner[i + 1] == '$');
    if (escapes) ++i;
    name += inner[i];
  }
  return name;
}

}  // namespace

bool Parser::at_word(const char* word) const {
  return at(TokenKind::Identifier) && context_.names.folded(peek().name) == word;
}

bool Parser::at_test() const {
  const Token& next = peek(1);
  return at(TokenKind::Identifier) && (next.is(TokenKind::String) || next.is(TokenKind::WideString)) &&
         at_word("TEST");
}

bool Parser::at_mock() const {
  const Token& next = peek(1);
  return at(TokenKind::Identifier) && (next.is(Keyword::Function) || next.is(Keyword::FunctionBlock)) &&
         at_word("MOCK");
}

// Words that are reserved nowhere and end what is being read all the same; those of namespaces, too.
bool Parser::at_test_declaration() const {
  const bool leaves = scope_ != nullptr && scope_->space && at_word("END_NAMESPACE");
  return at_test() || at_mock() || at_namespace() || leaves || (closing_ != nullptr && at_word(closing_));
}

void Parser::test(std::vector<TestDeclaration>& out) {
  const Token& open = advance();
  const Token& name = advance();
  if (name.is(TokenKind::WideString) || name.text.size() <= 2)
    context_.sink.error(source::code::kUnexpectedToken, name.where,
                        "expected the name of the test in single quotes", "write TEST 'what it shows'");
  TestDeclaration test;
  test.name = unquoted(name.text);
  PouDeclaration& body = test.body;
  // No source can write this name, and no other test has it.
  const std::string unique =
      "TEST#" + std::to_string(open.where.file.value) + "#" + std::to_string(open.where.offset);
  body.name = {context_.names.intern(unique), name.text, name.where};
  accept(TokenKind::Semicolon);
  closing_ = "END_TEST";
  pou_body(body);
  close_test(open);
  out.push_back(std::move(test));
}

void Parser::mock(Unit& out) {
  const Token& open = advance();
  PouDeclaration mock;
  pou_head(mock, true);
  enter_scope(out, mock);
  closing_ = "END_MOCK";
  pou_body(mock);
  close_test(open);
  out.mocks.push_back(std::move(mock));
}

void Parser::close_test(const Token& open) {
  const char* const word = std::exchange(closing_, nullptr);
  if (at_word(word)) {
    advance();
    accept(TokenKind::Semicolon);
  } else if (reported_at_ != at_) {
    reported_at_ = at_;
    context_.sink.error(source::code::kMissingEnd, open.where,
                        "'" + std::string(open.text) + "' is not closed: '" + word + "' is missing");
  }
}

}  // namespace stepwright::syntax::internal
