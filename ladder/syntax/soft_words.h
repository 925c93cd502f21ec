#pragma once

// Words that are reserved in some places only. Programs in use name variables ON, BY, STEP or TO; the grammar
// can tell: the ones stand behind a name or an operand, the others before a name.

#include <vector>

#include "ladder/syntax/token.h"

namespace stepwright::syntax {

// Makes identifiers of the reserved words in `tokens` that can only be names where they stand: AT, BY, FROM,
// ON, TO and WITH that follow no operand; ACTION, JMP, RESOURCE, STEP and TASK that no name follows.
void soften(std::vector<Token>& tokens);

}  // namespace stepwright::syntax
