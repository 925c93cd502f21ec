#pragma once

// A task of planning on a floor: a co-safe formula whose propositions are the floor's places, and its
// automaton, whose letters are the labels of regions.
//
// Pure functions. Example:
//   auto task = read_task("visit press then visit rack, never wash", floor_places);
//   const std::uint32_t state = task->automaton.next(task->automaton.initial, map.region(here).label);

#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/automaton/automaton.h"
#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/syntax/formula.h"

namespace stepwright::ltl {

struct Task {
  Formula formula;
  Automaton automaton;         // bit k of a letter is the k-th place
  std::vector<Letter> read{};  // what was read before: the automaton begins behind it
};

// L0001 to L0007: the text; L0011 to L0013: its automaton; L0311: a name that is no place, with its place in
// the text and the nearest one; L0312: a deadline or another duration.
[[nodiscard]] result::Result<Task> read_task(const std::string& text, const std::vector<std::string>& places,
                                             const std::string& file = {}, const BuildOptions& options = {});

// The automaton goes on behind these letters.
void begin_behind(const std::vector<Letter>& read, Automaton& automaton);

}  // namespace stepwright::ltl
