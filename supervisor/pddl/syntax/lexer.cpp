#include "supervisor/pddl/syntax/lexer.h"

#include "supervisor/pddl/definition/numeric.h"

namespace stepwright::pddl {
namespace {

// What the grid of numbers loses would make conditions hold that do not.
void check_grid(const Token& token, Reporter& reporter) {
  const Rounding rounding = rounding_of(token.number);
  if (rounding == Rounding::Lost) {
    reporter.error("P0009", token.at, "'" + token.text + "' is too small to be told from its neighbours",
                   "numbers are multiples of 1e-9: measure this in a smaller unit");
  } else if (rounding == Rounding::Digits) {
    reporter.warning("P0009", token.at, "'" + token.text + "' has digits that do not count",
                     "numbers are multiples of 1e-9");
  }
}

}  // namespace

std::vector<Token> tokenize(std::string_view text, std::uint32_t file, Reporter& reporter,
                            std::uint32_t first_line) {
  std::vector<Token> tokens = lisp::tokens_of(text, file, reporter, first_line);
  for (const Token& token : tokens)
    if (token.kind == TokenKind::Number) check_grid(token, reporter);
  return tokens;
}

}  // namespace stepwright::pddl
