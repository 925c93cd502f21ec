#pragma once

// One input as a formula, or as an automaton if it begins as one: whatever is read is written and read back
// as the same, and the automaton of a formula says what its progression says.

#include <string>
#include <string_view>

namespace stepwright::fuzz::ltl {

struct Run {
  bool read = false;       // a formula, or an automaton
  bool automaton = false;  // and it became an automaton
  std::string finding;     // what is wrong with us; empty = nothing
};

Run run(std::string_view input);

}  // namespace stepwright::fuzz::ltl
