#pragma once

// Beginning of every process, and its command line: outlive those who read what it says, parse the arguments,
// report what is wrong, choose the exit code.
//
// Threads: the main one, before it starts others.
//
//   CLI::App app{"Carry the service of a runtime over Fast DDS", "stepwright link"};
//   ...
//   if (const auto exit = process::parse(app, argc, argv)) return *exit;

#include <optional>
#include <string>

#include "runtime/ground/result/diagnostic.h"
#include "runtime/ground/result/exit_code.h"

namespace CLI {
class App;
}

namespace stepwright::process {

// A pipe or socket whose reader is gone is an error of the write (EPIPE) from now on and not the end of the
// process: a log that cannot be written costs the line. Programs that this one starts are not concerned.
void outlive_broken_pipes();

// From now on a thread or memory that the system refuses, where nothing can be done about it, ends the
// process with what was refused on stderr and ExitCode::RuntimeFault, and no longer by an abort.
void end_with_a_word();

// Parses the arguments, after the two above and tell_lost_output(): every process begins with it. The name of
// the command, which `stepwright` leaves in front of its arguments, is skipped: it is the last word of the
// app's name. Returns the exit code with which the process is to end now: Done after --help, Usage after a
// wrong command line, also one with an output that would overwrite an input (its message went to stderr);
// nothing if it goes on.
[[nodiscard]] std::optional<int> parse(CLI::App& app, int argc, char** argv);

// Checks an option's text as a number of seconds above 0: the error, empty if there is none. For
// CLI::Validator, whose ranges take "nan" for a number within them.
std::string refuse_seconds(const std::string& text);

// The same of a seed: up to 18 digits. The library takes "-1" for a large number, and its ranges name their
// ends with three hundred digits.
std::string refuse_seed(const std::string& text);

// Writes the diagnostics to stderr, one per line, and returns `code` for the process to end with.
[[nodiscard]] int fail(const result::Diagnostics& diagnostics, result::ExitCode code);

}  // namespace stepwright::process
