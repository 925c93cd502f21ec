#pragma once

// The text of a formula as tokens with their places. Thread rule: pure functions.

#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/syntax/syntax_tree.h"

namespace stepwright::ltl {

enum class TokenKind : std::uint8_t { Word, Quoted, Sign, Duration, End };

struct Token {
  TokenKind kind = TokenKind::End;
  std::string text;  // signs in one spelling: && is &, || is |, => is ->, <=> is <->, ^ is xor, ~ is !
  Place at;
};

// The last token is End. Bytes that have no meaning and quotes that do not end are errors (L0001, L0003).
[[nodiscard]] result::Result<std::vector<Token>> tokenize(std::string_view text, const std::string& file);

// Whether a proposition can be written without quotes.
bool is_plain_name(std::string_view name);

// Whether a word belongs to the language.
bool is_reserved(std::string_view word);

}  // namespace stepwright::ltl
