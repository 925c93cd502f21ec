#pragma once

// The step of an automaton as one table that is looked at once for every four propositions: the row of the
// state, with four of them, leads to a row for the next four, and the last one to the row of the next state.
// Rows are shared where the same is left to be asked, so there is no entry for each letter. Private to this
// library. Thread rule: pure functions.

#include <cstdint>
#include <optional>
#include <vector>

#include "supervisor/ltl/automaton/automaton.h"

namespace stepwright::ltl {

struct StepTable {
  std::uint32_t width = 0;  // propositions that a look asks for; a row has 2^width entries
  std::uint32_t looks = 1;
  std::vector<std::uint32_t> entries;  // rows; those of states come first, in their order
};

// Nothing if there would be more than `most` entries.
std::optional<StepTable> step_table(const Automaton& automaton, std::size_t most);

}  // namespace stepwright::ltl
