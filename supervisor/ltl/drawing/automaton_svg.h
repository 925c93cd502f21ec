#pragma once

// A picture of an automaton: states in columns (automaton_layout.h), two rings around what is TRUE, a cross
// through what is FALSE; the letters of each edge beside it, in full as its title. It has a size of its own,
// and colours for light and dark pages.
//
// Thread rule: pure function. Example:
//   write(*automaton_svg(*task_automaton(*formula)));

#include <string>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/automaton/automaton.h"

namespace stepwright::ltl {

// L0032: more than `most_states` states, which nobody can read.
[[nodiscard]] result::Result<std::string> automaton_svg(const Automaton& automaton,
                                                        std::size_t most_states = 100);

}  // namespace stepwright::ltl
