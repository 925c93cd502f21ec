#pragma once

// The order of a task network: total, or refused.
//
// Thread rule: pure function.

#include "supervisor/htn/syntax/syntax_tree.h"
#include "supervisor/lisp/reporter.h"

namespace stepwright::htn {

// Puts the subtasks in the order that `orders` give. Reports P0602 where two subtasks may be done in either
// order, P0603 for an order in a circle and for labels that stand twice, P0604 for unknown labels; false
// then.
bool put_in_order(ParsedNetwork& network, lisp::Reporter& reporter);

}  // namespace stepwright::htn
