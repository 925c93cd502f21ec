#pragma once

// Automata in the Hanoi Omega-Automata format, version 1: how other tools (Spot, Owl) write and read them.
// Source: T. Babiak et al., The Hanoi Omega-Automata Format, CAV 2015, and the format's text.
//
// Thread rule: pure functions. Example:
//   auto read = read_hoa(text, "task.hoa");
//   if (read) run(read->automaton);

#include <string>
#include <string_view>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/automaton/automaton.h"

namespace stepwright::ltl {

// An automaton of infinite words says one of two things by its finite ones.
enum class HoaPart : std::uint8_t {
  Good,  // accepting states are never left: a word is accepted once it has a good prefix (co-safe)
  Bad,   // states that do not accept are never left: a word is accepted unless it has a bad prefix (safe)
};

struct HoaAutomaton {
  Automaton automaton;  // minimal
  HoaPart part = HoaPart::Good;
};

struct HoaLimits {
  std::size_t states = 50'000;
  std::size_t nodes = 4'000'000;  // of labels
  std::size_t propositions = 64;
  std::size_t nesting = 1'000;  // parentheses of a label
};

// One automaton: deterministic, complete, acceptance by states with one set or none. Errors: L0021 syntax,
// L0022 not deterministic, L0023 not complete, L0024 acceptance that is neither good nor bad prefixes, L0025
// something of the format that is not supported, L0026 a bound.
[[nodiscard]] result::Result<HoaAutomaton> read_hoa(std::string_view text, const std::string& file = {},
                                                    const HoaLimits& limits = {});

// Undecided states accept in the Bad part and do not in the Good one. L0026: the labels would have more than
// `most_terms` conjunctions.
[[nodiscard]] result::Result<std::string> write_hoa(const Automaton& automaton, HoaPart part,
                                                    const std::string& name,
                                                    std::size_t most_terms = 1'000'000);

}  // namespace stepwright::ltl
