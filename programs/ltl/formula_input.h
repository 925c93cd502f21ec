#pragma once

// Formula of a command line: its text, or the name of a file with it (.ltl), or an automaton (.hoa).

#include <optional>
#include <string>

#include "runtime/ground/result/exit_code.h"
#include "runtime/ground/result/result.h"
#include "supervisor/ltl/automaton/build.h"
#include "supervisor/ltl/hoa/hoa.h"

namespace stepwright::ltl_program {

struct Watched {
  std::string about;                    // the formula, or the file's name
  std::optional<ltl::Formula> formula;  // nothing of an automaton
  ltl::Automaton automaton;             // the monitor
  ltl::HoaPart part = ltl::HoaPart::Good;
  ltl::StutterReport stutter;
};

// Whether the argument is an automaton and no formula.
bool is_automaton(const std::string& argument);

// Of what is a formula. Builds nothing.
[[nodiscard]] result::Result<ltl::Formula> read_formula(const std::string& argument);

[[nodiscard]] result::Result<Watched> read_watched(const std::string& argument);

// Whether any word gets this verdict.
bool decides(const ltl::Automaton& automaton, ltl::Verdict verdict);

// The file that a place in the formula is of; empty for a text.
std::string file_of(const std::string& argument);

// Prints the diagnostics. BudgetExhausted if a bound was met, BadInput otherwise.
result::ExitCode fail(const result::Diagnostics& diagnostics);

// Says on stderr that X was read as the next change of a letter, where that makes a difference.
void print_note(const ltl::StutterReport& stutter);

// Writes to a file, or to standard output where none is named.
result::ExitCode write(const std::string& file, const std::string& text);

}  // namespace stepwright::ltl_program
