#pragma once

// From tokens to a tree. Grammar and binding: supervisor/doc/ltl.md. Private to this library.

#include <array>
#include <optional>
#include <string>
#include <unordered_set>
#include <vector>

#include "supervisor/ltl/syntax/formula.h"
#include "supervisor/ltl/syntax/lexer.h"
#include "supervisor/ltl/syntax/patterns.h"

namespace stepwright::ltl {

class Parser {
 public:
  Parser(std::vector<Token> tokens, std::string file, std::vector<std::string> propositions,
         const TextLimits& limits);

  [[nodiscard]] result::Result<SyntaxTree> run();

 private:
  class Level;
  enum class Side : std::uint8_t;
  enum class Meaning : std::uint8_t;
  struct Binary;
  static const std::array<Binary, 18> kBinary;

  // After an error every look at the text sees its end, so that all loops come to theirs.
  const Token& peek() const { return error_ ? tokens_.back() : tokens_[at_]; }
  bool sees(std::string_view text) const;
  bool accept(std::string_view text);
  void expect(const char* text, const char* hint);
  void fail(const char* code, Place at, std::string message, std::string hint);
  void fail_here(const char* wanted, const char* hint);
  void too_deep();

  SyntaxId add(Operator op, std::vector<SyntaxId> children, Place at);
  SyntaxId name(const Token& token);
  bool count_operators(std::size_t more, Place at);  // false, with an error, beyond the bound

  SyntaxId sentences();
  SyntaxId sentence();
  Scope scope();
  SyntaxId pattern(const Scope& scope, bool scoped);  // scoped: a formula alone is not enough
  SyntaxId patterned(Pattern pattern, const Scope& scope, SyntaxId subject, SyntaxId other, Place at);
  const Binary* binary_operator() const;
  SyntaxId formula(int least = 0);
  SyntaxId list(SyntaxId first, const Binary& found, Place at);
  SyntaxId right_side(int binding);
  SyntaxId joined(const Binary& found, SyntaxId left, SyntaxId right, Place at);
  SyntaxId unary();
  SyntaxId primary();
  SyntaxId before(SyntaxId first, SyntaxId later, Place at);
  SyntaxId then(SyntaxId first, SyntaxId later, Place at);
  // Whether this word and a duration stand here.
  bool times(std::string_view word) const;
  // Reads them and adds the proposition of a timer. After an error: 0.
  SyntaxId timed(TimedKind kind, SyntaxId of, SyntaxId answer, Place at);
  SyntaxId within(SyntaxId first, Place at);
  SyntaxId visited(SyntaxId node) const;
  SyntaxId point(SyntaxId node) const;
  bool speaks_of_later(SyntaxId node) const;

  std::vector<Token> tokens_;
  std::string file_;
  TextLimits limits_;
  std::size_t at_ = 0, depth_ = 0, operators_ = 0;
  std::optional<result::Diagnostics> error_;
  SyntaxTree tree_;
  std::vector<bool> temporal_;           // of each node: whether it speaks of later letters
  std::unordered_set<SyntaxId> visits_;  // nodes that the word `visit` made
};

}  // namespace stepwright::ltl
