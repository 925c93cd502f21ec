#pragma once

// A deterministic, complete automaton over letters (sets of propositions) that tells by the first letters of
// a word what is known of it. States that are True or False are never left.
//
// Thread rule: const functions from any thread. Example:
//   auto automaton = task_automaton(*formula);
//   std::uint32_t state = automaton->initial;
//   state = automaton->next(state, letter);
//   if (automaton->accepting(state)) ...

#include <optional>
#include <string>
#include <vector>

#include "supervisor/ltl/automaton/guards.h"
#include "supervisor/ltl/automaton/verdict.h"

namespace stepwright::ltl {

struct Automaton {
  static constexpr std::uint32_t kNever = 0xFFFFFFFF;

  std::vector<std::string> propositions;  // bit k of a letter is propositions[k]
  std::uint32_t initial = 0;
  Guards guards;
  std::vector<Guard> edges;             // of each state
  std::vector<Verdict> verdicts;        // of each state
  std::vector<std::uint32_t> distance;  // transitions to the nearest True state; kNever where there is none

  std::size_t size() const { return edges.size(); }
  std::uint32_t next(std::uint32_t state, Letter letter) const { return guards.next(edges[state], letter); }
  bool accepting(std::uint32_t state) const { return verdicts[state] == Verdict::True; }
  bool rejecting(std::uint32_t state) const { return verdicts[state] == Verdict::False; }

  // The states that one transition leads to and that are not rejecting: delta(z) of the paper.
  std::vector<std::uint32_t> successors(std::uint32_t state) const;

  // The bit of a name.
  std::optional<std::uint32_t> proposition(const std::string& name) const;

  // Minimal automata with the same propositions are equal exactly if they tell the same of every word.
  bool operator==(const Automaton&) const = default;
};

// The same verdicts with as few states as can be, numbered from the initial one in the order in which they
// are met; distances are filled in.
Automaton minimised(const Automaton& automaton);

// Whether repeating a letter can change what an automaton tells. Exact for minimal automata of co-safe and of
// safe formulas; a letter that shows this is in `example`, after the state.
struct StutterAnswer {
  bool invariant = true;
  std::uint32_t state = 0;
  Letter example = 0;
};
StutterAnswer stutter(const Automaton& automaton);

}  // namespace stepwright::ltl
