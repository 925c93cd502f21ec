#pragma once

// The letters of an edge in words: "a & !b | c". Thread rule: pure functions.

#include <map>
#include <string>

#include "supervisor/ltl/automaton/automaton.h"

namespace stepwright::ltl {

// Of each state that an edge of `from` leads to, its letters; "always" if all lead there. What is longer than
// `most` characters ends in "...".
std::map<std::uint32_t, std::string> guard_texts(const Automaton& automaton, std::uint32_t from,
                                                 std::size_t most);

}  // namespace stepwright::ltl
