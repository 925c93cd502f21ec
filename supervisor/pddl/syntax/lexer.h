#pragma once

// PDDL text as tokens with their places (lisp::tokens_of), whose numbers are those of plans.
//
// Thread rule: pure function.

#include <string_view>
#include <vector>

#include "supervisor/pddl/syntax/notation.h"

namespace stepwright::pddl {

// As lisp::tokens_of; a number that the grid of numbers loses is reported as well (P0009).
std::vector<Token> tokenize(std::string_view text, std::uint32_t file, Reporter& reporter,
                            std::uint32_t first_line = 1);

}  // namespace stepwright::pddl
