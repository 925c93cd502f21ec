#pragma once

// A recorded trace as the word of its label changes.
//
// The table is that of `stepwright exec --csv` and `stepwright trace`: names in the first line, then a row
// for each scan. A proposition is the BOOL column of its name, unless a binding says something else. Names of
// columns have no case; a unit such as " [s]" behind them may be left out.
//
// Thread rule: pure functions. Example:
//   auto trace = read_trace(text, "run.csv", formula->tree.propositions, {*read_binding("full=MAIN.level >
//   20")});

#include <iosfwd>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/ground/result/result.h"
#include "supervisor/ltl/automaton/verdict.h"
#include "supervisor/ltl/syntax/syntax_tree.h"
#include "supervisor/ltl/trace/binding.h"

namespace stepwright::ltl {

// A row in which the letter is another one than before, and the first one.
struct TraceChange {
  std::uint64_t row = 0;   // from 1, the header not counted
  std::uint32_t line = 0;  // of the file
  std::string scan;        // as the columns `scan` and `time_s` have them; empty without these
  std::string time_s;
  Letter letter = 0;
};

struct Trace {
  std::vector<TraceChange> changes;
  std::uint64_t rows = 0;
};

// With the propositions of the formula but for those of its timers, which have no columns. L0041: no table,
// or a row of more than a mebibyte; L0042: a proposition has no column, or there are timers and no column
// `time_s`; L0044: a field is neither 0 nor 1, or no number; L0045: a binding for no proposition; L0046: a
// proposition with two bindings, or two columns of a name that is asked for.
//
// Of the table no more than a row is in memory, so that traces may be of any length.
[[nodiscard]] result::Result<Trace> read_trace(std::istream& in, const std::string& file,
                                               const SyntaxTree& formula,
                                               const std::vector<Binding>& bindings);
[[nodiscard]] result::Result<Trace> read_trace(std::string_view text, const std::string& file,
                                               const SyntaxTree& formula,
                                               const std::vector<Binding>& bindings);

// The same of propositions without timers.
[[nodiscard]] result::Result<Trace> read_trace(std::istream& in, const std::string& file,
                                               const std::vector<std::string>& propositions,
                                               const std::vector<Binding>& bindings);
[[nodiscard]] result::Result<Trace> read_trace(std::string_view text, const std::string& file,
                                               const std::vector<std::string>& propositions,
                                               const std::vector<Binding>& bindings);

}  // namespace stepwright::ltl
