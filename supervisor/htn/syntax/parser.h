#pragma once

// From a text in HDDL to its syntax tree. Totally ordered networks are put in the order in which they are
// done; a network whose order leaves two subtasks open is refused where it stands (P0602).
//
// Thread rule: pure functions. Every error is reported; what could be read is returned all the same.
//
//   lisp::Reporter reporter({"domain.hddl"});
//   const ParsedDomain domain = parse_domain(lisp::tokens_of(text, 0, reporter), reporter);

#include "supervisor/htn/syntax/syntax_tree.h"
#include "supervisor/lisp/lexer.h"

namespace stepwright::htn {

ParsedDomain parse_domain(std::vector<lisp::Token> tokens, lisp::Reporter& reporter);
ParsedProblem parse_problem(std::vector<lisp::Token> tokens, lisp::Reporter& reporter);

}  // namespace stepwright::htn
