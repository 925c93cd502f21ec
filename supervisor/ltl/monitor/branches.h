#pragma once

// The step of an automaton as IF statements. Private to this library. Thread rule: pure functions.

#include <optional>
#include <string>
#include <vector>

#include "supervisor/ltl/automaton/automaton.h"

namespace stepwright::ltl {

// Statements that give State its next value. Nothing if there would be more than `most` branches.
std::optional<std::string> branches(const Automaton& automaton, const std::vector<std::string>& inputs,
                                    std::size_t most, std::size_t indent);

}  // namespace stepwright::ltl
