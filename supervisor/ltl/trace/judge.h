#pragma once

// Judgement on a trace by a formula: the verdict, from which row on it holds, and which parts of the formula
// say so.
//
// Thread rule: pure functions. Example:
//   const auto judgement = judge(*formula, trace);
//   if (judgement->verdict == Verdict::False) show(judgement->decided_at);

#include <optional>
#include <string>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/trace/read_trace.h"

namespace stepwright::ltl {

struct Judged {
  Verdict verdict = Verdict::Undecided;
  std::optional<std::size_t>
      decided_at;           // of trace.changes; nothing if undecided, or decided without a letter
  std::uint32_t state = 0;  // of the automaton at the end
  bool stepwise = false;    // without an automaton, which would be too large: told when it follows without
                            // looking ahead, which may be later
};

// The automaton reads a letter for each label change.
Judged judge(const Automaton& automaton, const Trace& trace);

// One of the sentences, or operands of &, of which the formula is made.
struct JudgedPart {
  std::string text;
  Place at;
  Class kind = Class::CoSafe;
  Judged judged;
  bool told = true;  // false: no finite run decides it (L0014), or a bound was met
};

struct Judgement {
  Judged whole;
  std::vector<JudgedPart> parts;  // more than one, or none
  StutterReport stutter;          // X was read as the next label change
};

// By automata where they are within the bounds, else step by step (Progression). L0014: no finite run decides
// the formula; L0012, L0013, L0015: a bound was met, and not even steps are possible.
[[nodiscard]] result::Result<Judgement> judge(const Formula& formula, const Trace& trace,
                                              const BuildOptions& options = {}, const std::string& file = {});

}  // namespace stepwright::ltl
