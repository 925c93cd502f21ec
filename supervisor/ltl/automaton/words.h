#pragma once

// Words that lead from one state of an automaton to another: a run that goes on knows its state, a planner
// wants letters. Pure functions; any thread.
//
//   const auto word = shortest_word(automaton, automaton.initial, state);

#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/ltl/automaton/automaton.h"

namespace stepwright::ltl {

// Letters in their order, as few as can be, without those that have a proposition of `never`; nothing where
// no word leads there.
std::optional<std::vector<Letter>> shortest_word(const Automaton& automaton, std::uint32_t from,
                                                 std::uint32_t to, Letter never = 0);

}  // namespace stepwright::ltl
