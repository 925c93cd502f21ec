#pragma once

// From formulas to automata.
//
// Thread rule: pure functions. Example:
//   auto task = task_automaton(*formula);           // for planning: co-safe formulas
//   auto watch = monitor_automaton(*formula);       // for watching: LTL3 verdicts

#include <string>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/automaton/automaton.h"
#include "supervisor/ltl/syntax/formula.h"

namespace stepwright::ltl {

enum class Letters : std::uint8_t {
  All,        // any set of propositions
  AtMostOne,  // regions that do not overlap: a letter with two propositions is rejected
};

// When a task is known to be done.
enum class Acceptance : std::uint8_t {
  Early,   // no continuation can fail: every good prefix
  Strong,  // the letters that were read satisfy it by themselves; X and U ask for letters that are there
};

struct BuildOptions {
  std::size_t most_states = 20'000;    // before states are merged
  std::size_t most_nodes = 4'000'000;  // of decision diagrams
  Letters letters = Letters::All;
  Acceptance acceptance = Acceptance::Early;
};

// The minimal automaton of a co-safe formula: True is done, False cannot be done any more. L0011: not
// co-safe, with the part to blame; L0012, L0013: a bound was met, and Progression is the way to go.
[[nodiscard]] result::Result<Automaton> task_automaton(const Formula& formula,
                                                       const BuildOptions& options = {},
                                                       const std::string& file = {});

// The minimal monitor of any formula: True after good prefixes (every continuation satisfies it), False after
// bad ones (none does), and exact in that. Source: A. Bauer, M. Leucker, C. Schallhart, Runtime Verification
// for LTL and TLTL, ACM TOSEM 20(4), 2011.
inline constexpr const char* kNotMonitorable = "L0014";
struct Monitor {
  Automaton automaton;
  Class kind = Class::CoSafe;
  bool may_never_tell = false;  // some words stay undecided, whatever follows
};
// L0014: no finite word decides the formula, it cannot be monitored; L0012, L0013, L0015: a bound was met.
[[nodiscard]] result::Result<Monitor> monitor_automaton(const Formula& formula,
                                                        const BuildOptions& options = {},
                                                        const std::string& file = {});

// Whether the formula speaks of the number of equal letters that follow each other, which a word of label
// changes does not have: a formula without X does not, others may not (X is then superfluous).
enum class StutterKind : std::uint8_t { Invariant, Sensitive, Unknown };
struct StutterReport {
  StutterKind kind = StutterKind::Invariant;
  std::string reason;  // empty if invariant
};
StutterReport stutter_report(const Formula& formula, const BuildOptions& options = {});

}  // namespace stepwright::ltl
