#pragma once

// Adds to each letter of a run the propositions that timers make (syntax_tree.h), as the function block of
// the formula does: timers are those of the standard (TON), looked at once a scan.
//
// Thread rule: one thread at a time. Example:
//   TimedLetters timers(formula->tree);
//   letter = timers.with_timed(letter, time_ns);   // scan by scan

#include <cstdint>
#include <vector>

#include "supervisor/ltl/automaton/verdict.h"
#include "supervisor/ltl/syntax/syntax_tree.h"

namespace stepwright::ltl {

class TimedLetters {
 public:
  // The tree outlives this.
  explicit TimedLetters(const SyntaxTree& tree) : tree_(tree), timers_(tree.timed.size()) {}

  // Times do not run backwards.
  Letter with_timed(Letter letter, std::int64_t time_ns);

 private:
  struct Timer {
    bool waiting = false;  // of Overdue
    bool on = false;
    std::int64_t since_ns = 0;
  };

  const SyntaxTree& tree_;
  std::vector<Timer> timers_;
};

// Whether a letter satisfies a formula that speaks of one letter.
bool satisfies(const SyntaxTree& tree, SyntaxId node, Letter letter);

}  // namespace stepwright::ltl
