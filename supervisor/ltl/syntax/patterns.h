#pragma once

// Specification patterns: what is asked for, and in which part of a run.
// Source: M. Dwyer, G. Avrunin, J. Corbett, Patterns in Property Specifications for Finite-State
// Verification, ICSE 1999, and the catalogue's mappings for LTL.

#include "supervisor/ltl/syntax/syntax_tree.h"

namespace stepwright::ltl {

enum class ScopeKind : std::uint8_t { Globally, Before, After, Between, AfterUntil };

struct Scope {
  ScopeKind kind = ScopeKind::Globally;
  SyntaxId begin = 0;  // q: After, Between, AfterUntil
  SyntaxId end = 0;    // r: Before, Between, AfterUntil
};

enum class Pattern : std::uint8_t { Absence, Existence, Universality, Precedence, Response };

// Adds the pattern's formula to the tree. `subject` is p, what the pattern is about; `other` is s, which
// precedes p or responds to it.
SyntaxId add_pattern(SyntaxTree& tree, Pattern pattern, const Scope& scope, SyntaxId subject, SyntaxId other,
                     Place at);

}  // namespace stepwright::ltl
