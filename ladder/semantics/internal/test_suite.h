#pragma once

// The TESTs of a unit as programs of its model, and mocks in the place of POUs.

#include <vector>

#include "ladder/semantics/analyze.h"
#include "ladder/semantics/declarations/declarer.h"

namespace stepwright::semantics::internal {

// The POU that replaces `original` in these tests: its mock, or itself.
const syntax::PouDeclaration& mock_of(const syntax::PouDeclaration& original, const TestGroup& group);

// A mock looks from outside as what it stands for: name, kind, parameters and result are those of a POU of
// the unit.
void check_mocks(Analysis& analysis, TypeResolver& types, const syntax::Unit& unit, const TestGroup& group);

// Behind all other POUs of the model.
void register_tests(Analysis& analysis, const TestGroup& group);

// Whether the unit says what runs while a test waits: a configuration, or a single program.
bool has_main(const syntax::Unit& unit, std::size_t user_pous);

// The bodies, and behind the program's own tasks the one that holds them. Requires that the unit was
// configured.
void analyze_tests(Analysis& analysis);

}  // namespace stepwright::semantics::internal
