#pragma once

// Conditions and expressions back as PDDL text, with variables or with the objects bound to them.
//
// Thread rule: pure functions.

#include <string>
#include <vector>

#include "supervisor/pddl/definition/ast.h"

namespace stepwright::pddl {

// The object of every slot; -1 = not bound, printed as the variable.
using Binding = std::vector<int>;

std::string print(const Definition& definition, const Expression& expression, const Binding& binding = {});
std::string print(const Definition& definition, const Formula& formula, const Binding& binding = {});
const char* symbol_of(Relation relation);
const char* symbol_of(NumericKind kind);  // Negate: "-"

}  // namespace stepwright::pddl
