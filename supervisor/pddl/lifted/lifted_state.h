#pragma once

// States over atoms instead of names, and the way between both.
//
// Thread rule: plain values, pure functions.

#include <map>
#include <set>

#include "runtime/ground/result/result.h"
#include "supervisor/pddl/definition/ast.h"
#include "supervisor/pddl/definition/state.h"

namespace stepwright::pddl {

// Invariant: the derived facts in it are those that follow from the others.
struct LiftedState {
  std::set<Atom> facts;
  std::map<Atom, double> fluents;
};

LiftedState initial_state(const Definition& definition);

// Fails (P0201 to P0203) on every name that the definition does not know and on values that are not finite.
// Derived facts are not taken over but derived anew.
[[nodiscard]] result::Result<LiftedState> lift(const Definition& definition, const State& state);

State name_state(const Definition& definition, const LiftedState& state);

// "(is-at v1 f1)".
std::string fact_name(const Definition& definition, const Atom& atom);
std::string fluent_name(const Definition& definition, const Atom& atom);

}  // namespace stepwright::pddl
