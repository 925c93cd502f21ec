#pragma once

// Text in the notation of PDDL and HDDL as tokens with their places. Names, variables and keywords are lower
// case, as these languages ignore case.
//
// Thread rule: pure function.

#include <string>
#include <string_view>
#include <vector>

#include "supervisor/lisp/place.h"
#include "supervisor/lisp/reporter.h"

namespace stepwright::lisp {

enum class TokenKind : std::uint8_t { Open, Close, Name, Variable, Keyword, Number, Operator, End };

struct Token {
  TokenKind kind = TokenKind::End;
  std::string text;  // variables with '?', keywords with ':'
  Place at;
  double number = 0.0;
};

// The last token is End, placed after the text. A character that the notation does not know is reported
// (P0002) and left out; a control character ends the reading, for then this is no text. `first_line` is the
// number of the text's first line in its file.
std::vector<Token> tokens_of(std::string_view text, std::uint32_t file, Reporter& reporter,
                             std::uint32_t first_line = 1);

// "'move'", "'('" or "the end of the file": how messages name a token.
std::string quoted(const Token& token);

}  // namespace stepwright::lisp
