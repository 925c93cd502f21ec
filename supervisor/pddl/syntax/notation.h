#pragma once

// Tokens, places and messages of PDDL texts: those of supervisor/lisp under their names here.

#include "supervisor/lisp/reporter.h"
#include "supervisor/lisp/section_parser.h"
#include "supervisor/lisp/token_stream.h"

namespace stepwright::pddl {

using lisp::Place;
using lisp::Reporter;
using lisp::RequirementFlag;
using lisp::Token;
using lisp::TokenKind;
using lisp::TokenStream;

}  // namespace stepwright::pddl
